#include "model/reduced_drive.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include "base/overloaded.hpp"
#include "model/firmware.hpp"
#include "model/proportional_servo.hpp"

namespace gearlash {
namespace {

/// J_M + J_L = 1 kg m².
Drivetrain drivetrain_of(const NormalForm& form, double restitution) {
  const double frequency = form.natural_frequency.value_or(1.0);
  const double friction = 2.0 * form.damping * frequency;
  const double ratio = form.inertia_ratio;
  Drivetrain drivetrain;
  drivetrain.stiffness = frequency * frequency;
  drivetrain.motor_inertia = 1.0 / (1.0 + ratio);
  drivetrain.load_inertia = std::isinf(ratio) ? 1.0 : ratio / (1.0 + ratio);
  drivetrain.motor_friction = friction * (1.0 - form.friction_ratio);
  drivetrain.load_friction = friction * form.friction_ratio;
  drivetrain.backlash = form.backlash;
  drivetrain.restitution = restitution;
  return drivetrain;
}

/// A shaft that turns `ratio` times as far as the load's.
drive::ShaftFriction referred(const Friction& friction, double coulomb, double ratio) {
  return {.viscous = friction.viscous * (ratio * ratio),
          .coulomb = coulomb * ratio,
          .breakaway = friction.breakaway.value_or(coulomb) * ratio,
          .stribeck_speed = friction.stribeck_speed / ratio};
}

/// Of the motor's shaft, at the load.
double motor_inertia_of(const Drive& drive) {
  const double ratio = drive.gearbox.ratio;
  return (drive.motor.inertia + drive.gearbox.inertia) * (ratio * ratio);
}

/// The lag of the winding, s.
double electrical_time_of(const Motor& motor) {
  const auto* armature = std::get_if<ArmatureControl>(&motor.kind);
  return armature == nullptr ? 0.0 : armature->inductance / armature->resistance;
}

// ---- controllers --------------------------------------------------------------------------------

/// Columns for r, y and v, from a single column for the error.
std::vector<double> of_three_inputs(const std::vector<double>& row) {
  if (row.size() == 1) return {row[0], -row[0], 0.0};
  return row;
}

std::vector<double> scaled(std::vector<double> numbers, double factor) {
  for (double& number : numbers) number *= factor;
  return numbers;
}

/// `scale`: torque at the load per unit of a gain.
drive::Controller reduce(const PID& pid, double scale) {
  if (pid.terms == PIDTerms::P) {
    return drive::ProportionalDerivative{.proportional = scale * pid.proportional};
  }
  const bool has_integral = pid.terms != PIDTerms::PD;
  const bool has_derivative = pid.terms != PIDTerms::PI;
  drive::ProportionalIntegralDerivative reduced;
  reduced.proportional = scale * pid.proportional;
  if (has_integral) {
    reduced.integral = scale * pid.integral;
    reduced.tracking_time = pid.tracking_time;
  }
  if (has_derivative) {
    reduced.derivative = scale * pid.derivative;
    reduced.filter = pid.filter;
    reduced.derivative_of_speed = pid.derivative_of_speed;
  }
  return reduced;
}

drive::Controller reduce(const CascadeController& cascade, double scale) {
  return drive::Cascade{.position = cascade.position,
                        .speed = scale * cascade.speed,
                        .speed_integral = scale * cascade.speed_integral,
                        .tracking_time = cascade.tracking_time,
                        .filter = cascade.filter};
}

drive::Controller reduce(const LeadLagController& lead_lag, double scale) {
  return drive::LeadLag{
      .gain = scale * lead_lag.gain, .zero = lead_lag.zero, .pole = lead_lag.pole};
}

drive::Controller reduce(const TransferFunctionController& function, double scale) {
  std::vector<double> numerator = scaled(function.numerator, scale * function.gain);
  if (function.is_sampled) return drive::SampledTransfer{numerator, function.denominator};
  return drive::ErrorTransfer{{numerator, function.denominator, 0.0}};
}

drive::Controller reduce(const StateSpaceController& system, double scale) {
  const double gain = scale * system.gain;
  drive::LinearController reduced;
  reduced.state_matrix = system.A;
  for (const std::vector<double>& row : system.B) {
    reduced.input_matrix.push_back(of_three_inputs(row));
  }
  reduced.output = scaled(system.C, gain);
  reduced.direct = scaled(of_three_inputs(system.D), gain);
  return reduced;
}

/// On the signs that its ErrorShape gives.
drive::Controller reduce(const RelayController& relay, double scale) {
  return drive::ProportionalDerivative{.proportional = scale * relay.level};
}

/// Angles of the gains' shaft at the load.
double angle_scale(const Drive& drive) {
  return drive.controller.shaft == GainShaft::motor ? 1.0 / drive.gearbox.ratio : 1.0;
}

drive::ErrorShape error_shape_of(const Drive& drive) {
  const Controller& controller = drive.controller;
  const double scale = angle_scale(drive);
  const double width = controller.dead_band.width * scale;
  const double hysteresis = controller.dead_band.hysteresis * scale;
  if (const auto* relay = std::get_if<RelayController>(&controller.law)) {
    return {.begins = width + hysteresis,
            .ends = width - hysteresis,
            .inner_gain = 0.0,
            .outer_gain = 0.0,
            .offset = 1.0,
            .is_of_speed = relay->input == RelayInput::speed,
            .jumps = true};
  }
  if (width > 0.0 && controller.dead_band.form == DeadBandForm::whole) {
    return {
        .begins = width + hysteresis, .ends = width - hysteresis, .inner_gain = 0.0, .jumps = true};
  }
  if (width > 0.0) {
    return {.begins = width, .ends = width, .inner_gain = 0.0, .offset = -width};
  }
  const Compensation& compensation = controller.compensation;
  if (compensation.backlash == 0.0 || compensation.input == CompensationInput::reference) return {};
  const double angle = compensation.take_up_angle * scale;
  const double half = 0.5 * compensation.backlash;
  return {.begins = angle, .ends = angle, .inner_gain = 1.0 + half / angle, .offset = half};
}

drive::Feedforward feedforward_of(const Drive& drive) {
  const Compensation& compensation = drive.controller.compensation;
  const bool is_by_reference = compensation.input == CompensationInput::reference;
  return {.torque = output_scale(drive) * compensation.friction,
          .speed = compensation.friction_speed * angle_scale(drive),
          .half_gap = is_by_reference ? 0.5 * compensation.backlash : 0.0,
          .take_up_time = compensation.take_up_time};
}

/// The torque of the largest current at the load, N m.
double current_torque_of(const Drive& drive) {
  const Motor& motor = drive.motor;
  if (!motor.current_limit || !takes_current_limit(motor) || limits_torque_by_current(motor)) {
    return std::numeric_limits<double>::infinity();
  }
  const auto* armature = std::get_if<ArmatureControl>(&motor.kind);
  const double constant = armature != nullptr ? armature->torque_constant
                                              : std::get<FieldControl>(motor.kind).torque_constant;
  return constant * *motor.current_limit * drive.gearbox.ratio;
}

// ---- sensors ------------------------------------------------------------------------------------

/// Step at the load's shaft of an encoder on a shaft that turns `ratio` times as far.
std::optional<double> step_of(const Encoder& encoder, double ratio) {
  const double referred = 1.0 / ratio;
  if (encoder.resolution) return referred * *encoder.resolution;
  if (encoder.counts_per_turn) return referred * 2.0 * std::numbers::pi / *encoder.counts_per_turn;
  return std::nullopt;
}

drive::Sensing reduce(const Sensor& sensor, double gear_ratio) {
  const bool is_on_load = sensor.position != SensorPlace::motor;
  const ShaftName of_position =
      sensor.position == SensorPlace::load ? ShaftName::load : ShaftName::motor;
  const bool speed_on_load = sensor.speed.value_or(of_position) == ShaftName::load;
  drive::Sensing sensing;
  sensing.load_share_of_position = is_on_load ? 1.0 : 0.0;
  sensing.load_share_of_speed = speed_on_load ? 1.0 : 0.0;
  sensing.resolution = step_of(sensor.encoder, is_on_load ? 1.0 : gear_ratio).value_or(0.0);
  sensing.resolution_of_speed =
      step_of(sensor.speed_encoder, speed_on_load ? 1.0 : gear_ratio)
          .value_or(is_on_load == speed_on_load ? sensing.resolution : 0.0);
  return sensing;
}

drive::Contact reduce(const Contact& contact) {
  return std::visit(Overloaded{[](const RigidContact& rigid) -> drive::Contact {
                                 return drive::RigidContact{rigid.restitution};
                               },
                               [](const CompliantContact& faces) -> drive::Contact {
                                 return drive::CompliantContact{
                                     faces.stiffness, faces.damping,
                                     faces.law == ContactDamping::full
                                         ? drive::ContactDamping::full
                                         : drive::ContactDamping::limited};
                               }},
                    contact);
}

double restitution_of(const Drive& drive) {
  const auto* rigid = std::get_if<RigidContact>(&drive.contact);
  return rigid == nullptr ? 0.0 : rigid->restitution;
}

drive::ReducedDrive reduced_plant(const Drive& drive) {
  if (drive.servo) return drive::drive_of(drivetrain_of(*drive.servo, restitution_of(drive)));
  const double ratio = drive.gearbox.ratio;
  const ReferredOutput output = refer_output(drive);
  drive::ReducedDrive reduced;
  reduced.motor = {motor_inertia_of(drive),
                   referred(drive.motor.friction, coulomb_torque(drive.motor), ratio)};
  reduced.winding = {.time_constant = electrical_time_of(drive.motor),
                     .back_emf = output.friction,
                     .torque_limit = current_torque_of(drive)};
  if (reduced.winding.time_constant == 0.0) reduced.motor.friction.viscous += output.friction;
  reduced.load = {drive.load.inertia,
                  referred(drive.load.friction, drive.load.friction.coulomb, 1.0)};
  reduced.backlash = drive.gearbox.backlash;
  if (const auto limit = output_limit(drive.motor)) reduced.torque_limit = output.torque * *limit;
  const bool is_relay = std::holds_alternative<RelayController>(drive.controller.law);
  const double scale = is_relay ? output_scale(drive) : gain_scale(drive);
  reduced.controller =
      std::visit([&](const auto& law) { return reduce(law, scale); }, drive.controller.law);
  reduced.error_shape = error_shape_of(drive);
  reduced.feedforward = feedforward_of(drive);
  return reduced;
}

/// Linearised about the angle where the reference ends.
drive::Gravity gravity_of(const Drive& drive, const Signal& reference) {
  if (drive.servo || drive.load.gravity == 0.0) return {};
  if (!drive::validate(reference, "reference").empty()) return {};  // such as an empty table
  const double at = drive::middle_of(drive::settled(reference));
  const double angle = drive.load.gravity_angle + at;
  constexpr double rounding = 4.0 * std::numeric_limits<double>::epsilon();
  const auto rounded = [&](double share) { return std::abs(share) <= rounding ? 0.0 : share; };
  return {.torque = -drive.load.gravity * rounded(std::cos(angle)),
          .stiffness = -drive.load.gravity * rounded(std::sin(angle)),
          .angle = at};
}

drive::Sampling reduce(const Sampling& sampling) {
  return {.period = sampling.period,
          .delay = sampling.delay,
          .method = static_cast<drive::Discretization>(sampling.method),
          .speed_by_differences = sampling.speed_by_differences};
}

}  // namespace

std::optional<double> torque_constant_of(const Motor& motor) {
  if (const auto* controlled = std::get_if<TorqueControl>(&motor.kind)) {
    return controlled->torque_constant;
  }
  const auto* armature = std::get_if<ArmatureControl>(&motor.kind);
  return armature == nullptr ? std::nullopt : std::optional(armature->torque_constant);
}

bool takes_no_load_current(const Motor& motor) { return torque_constant_of(motor).has_value(); }

double coulomb_torque(const Motor& motor) {
  if (!motor.no_load_current || !takes_no_load_current(motor)) return motor.friction.coulomb;
  return *torque_constant_of(motor) * *motor.no_load_current;
}

bool limits_torque_by_current(const Motor& motor) {
  return std::holds_alternative<TorqueControl>(motor.kind) && torque_constant_of(motor);
}

bool takes_current_limit(const Motor& motor) {
  return limits_torque_by_current(motor) || std::holds_alternative<ArmatureControl>(motor.kind) ||
         std::holds_alternative<FieldControl>(motor.kind);
}

std::optional<double> output_limit(const Motor& motor) {
  if (!motor.current_limit || !limits_torque_by_current(motor)) return motor.limit;
  return *torque_constant_of(motor) * *motor.current_limit;
}

double output_scale(const Drive& drive) {
  const bool has_torque = std::holds_alternative<TorqueControl>(drive.motor.kind);
  if (has_torque && drive.controller.shaft == GainShaft::load) return 1.0;
  return refer_output(drive).torque;
}

double gain_scale(const Drive& drive) {
  const double angle = drive.controller.shaft == GainShaft::motor ? drive.gearbox.ratio : 1.0;
  return output_scale(drive) * angle;
}

ReferredOutput refer_output(const Drive& drive) {
  const double ratio = drive.gearbox.ratio;
  const double square = ratio * ratio;
  return std::visit(
      Overloaded{
          [&](const TorqueControl&) {
            return ReferredOutput{ratio, 0.0};
          },
          [&](const ArmatureControl& motor) {
            const double per_volt = motor.torque_constant / motor.resistance;
            return ReferredOutput{per_volt * ratio, per_volt * motor.back_emf_constant * square};
          },
          [&](const FieldControl& motor) {
            return ReferredOutput{motor.torque_constant / motor.resistance * ratio, 0.0};
          },
          [&](const TwoPhase& motor) {
            return ReferredOutput{motor.torque_per_volt * ratio, motor.torque_per_speed * square};
          }},
      drive.motor.kind);
}

namespace {

/// Firmware compares counts: a threshold within rounding of a whole number of an encoder's steps is
/// that number of them, as what it reads is.
double counted(double threshold, double step) {
  const double steps = std::round(threshold / step);
  constexpr double rounding = 1e-9;
  return std::abs(threshold / step - steps) <= rounding * std::abs(steps) ? steps * step
                                                                          : threshold;
}

void count_thresholds(drive::ReducedDrive& reduced) {
  const double step = reduced.sensing.resolution;
  drive::ErrorShape& shape = reduced.error_shape;
  if (step == 0.0 || shape.is_of_speed || shape.inner_gain != 0.0) return;
  shape.begins = counted(shape.begins, step);
  shape.ends = counted(shape.ends, step);
  if (!shape.is_relay()) shape.offset = counted(shape.offset, step);
}

/// A reference that does not move has nothing to be compensated.
void drop_idle_feedforward(drive::ReducedDrive& reduced) {
  if (std::holds_alternative<double>(reduced.reference)) reduced.feedforward = {};
}

}  // namespace

drive::ReducedDrive reduce(const Drive& drive) {
  if (drive.controller.firmware) return reduce(without_registers(drive));
  drive::ReducedDrive reduced = reduced_plant(drive);
  reduced.contact = reduce(drive.contact);
  reduced.sensing = reduce(drive.sensor, drive.servo ? 1.0 : drive.gearbox.ratio);
  count_thresholds(reduced);
  if (drive.sampling) reduced.sampling = reduce(*drive.sampling);
  reduced.reference = drive.reference.value_or(0.0);
  drop_idle_feedforward(reduced);
  reduced.gravity = gravity_of(drive, reduced.reference);
  reduced.load_torque = drive.load_torque.value_or(0.0);
  if (reduced.gravity.torque != 0.0) {
    reduced.load_torque = drive::shifted(reduced.load_torque, reduced.gravity.torque);
  }
  return reduced;
}

drive::ReducedDrive reduce_settled(const Drive& drive) {
  drive::ReducedDrive reduced = reduce(drive);
  reduced.reference = drive::settled(reduced.reference);
  reduced.load_torque = drive::settled(reduced.load_torque);
  drop_idle_feedforward(reduced);
  return reduced;
}

Drive physical_form(const Drive& drive) {
  if (!drive.servo) return drive;
  const Drivetrain drivetrain = drivetrain_of(*drive.servo, restitution_of(drive));
  Drive physical = drive;
  physical.servo.reset();
  physical.motor = {.kind = TorqueControl{},
                    .inertia = drivetrain.motor_inertia,
                    .friction = {.viscous = drivetrain.motor_friction}};
  physical.gearbox = {.ratio = 1.0, .backlash = drivetrain.backlash};
  physical.load = {drivetrain.load_inertia, {.viscous = drivetrain.load_friction}};
  // As in the thesis a larger ratio raises the stiffness: the motor's torque follows the error.
  physical.controller.law = PID{.proportional = drivetrain.stiffness};
  return physical;
}

bool is_normalized(const Drive& drive) { return drive.servo && !drive.servo->natural_frequency; }

std::optional<Drivetrain> proportional_drivetrain(const Drive& drive) {
  return drive::proportional_servo(reduce(drive));
}

namespace {

/// Output per error and per sensed speed of a proportional controller.
struct ProportionalGains {
  double error = 0.0;
  double speed = 0.0;
};

ProportionalGains gains_of(const Controller& controller) {
  if (const auto* pid = std::get_if<PID>(&controller.law)) {
    const bool has_derivative = pid->terms == PIDTerms::PD || pid->terms == PIDTerms::PID;
    return {pid->proportional, has_derivative ? pid->derivative : 0.0};
  }
  if (const auto* cascade = std::get_if<CascadeController>(&controller.law)) {
    return {cascade->position * cascade->speed, cascade->speed};
  }
  const drive::LinearController linear = drive::linear_controller(
      std::visit([](const auto& law) { return reduce(law, 1.0); }, controller.law));
  return {linear.direct[0], -linear.direct[2]};
}

}  // namespace

Drivetrain referred_drivetrain(const Drive& drive) {
  if (drive.servo) return drivetrain_of(*drive.servo, restitution_of(drive));
  const double ratio = drive.gearbox.ratio;
  const double square = ratio * ratio;
  const ReferredOutput output = refer_output(drive);
  const double per_output = gain_scale(drive);
  const ProportionalGains gains = gains_of(drive.controller);
  return {.motor_inertia = motor_inertia_of(drive),
          .load_inertia = drive.load.inertia,
          .motor_friction =
              drive.motor.friction.viscous * square + output.friction + per_output * gains.speed,
          .load_friction = drive.load.friction.viscous,
          .stiffness = per_output * gains.error,
          .backlash = drive.gearbox.backlash,
          .restitution = restitution_of(drive)};
}

ClosedFormServo normal_form_servo(const Drive& drive) {
  const NormalForm& form = *drive.servo;
  return {{.damping = form.damping,
           .inertia_ratio = form.inertia_ratio,
           .friction_ratio = form.friction_ratio,
           .backlash = form.backlash,
           .restitution = restitution_of(drive)},
          form.natural_frequency.value_or(1.0),
          true};
}

std::optional<ClosedFormServo> closed_form_servo(const Drive& drive) {
  const std::optional<Drivetrain> drivetrain = drive::proportional_drivetrain(reduce(drive));
  if (!drivetrain) return std::nullopt;
  if (!drive.servo) {
    if (!validate(*drivetrain).empty()) return std::nullopt;
    return ClosedFormServo{normalize_sound(*drivetrain), natural_frequency(*drivetrain), false};
  }
  return normal_form_servo(drive);
}

std::optional<Drive> normal_form_of(const Drive& drive) {
  const std::optional<ClosedFormServo> closed = closed_form_servo(drive);
  if (!closed) return std::nullopt;
  const NormalizedServo& servo = closed->servo;
  Drive form = normal_form(servo.damping, servo.inertia_ratio, servo.friction_ratio, servo.backlash,
                           servo.restitution);
  form.servo->natural_frequency = closed->natural_frequency;
  return form;
}

}  // namespace gearlash
