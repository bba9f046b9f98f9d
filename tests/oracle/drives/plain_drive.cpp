#include "plain_drive.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <variant>

namespace gearlash::oracle {
namespace {

void refuse(bool condition, const char* what) {
  if (condition) throw std::invalid_argument(what);
}

PlainShaft shaft_of(double inertia, const Friction& friction, double ratio) {
  return {.inertia = inertia * ratio * ratio,
          .viscous = friction.viscous * ratio * ratio,
          .coulomb = friction.coulomb * ratio,
          .breakaway = friction.breakaway.value_or(friction.coulomb) * ratio,
          .stribeck_speed = friction.stribeck_speed / ratio};
}

void set_motor(const Motor& motor, const Gearbox& gearbox, PlainDrive& plain) {
  const auto* controlled = std::get_if<TorqueControl>(&motor.kind);
  refuse(controlled == nullptr, "the simulator knows torque-controlled motors only");
  plain.current_rate = controlled->current_bandwidth.value_or(0.0);
  const double torque_per_current = controlled->torque_constant.value_or(0.0);
  Friction friction = motor.friction;
  if (motor.no_load_current) friction.coulomb = torque_per_current * *motor.no_load_current;
  plain.motor = shaft_of(motor.inertia + gearbox.inertia, friction, gearbox.ratio);
  if (motor.limit) plain.limit = *motor.limit * gearbox.ratio;
  if (motor.current_limit) plain.limit = torque_per_current * *motor.current_limit * gearbox.ratio;
}

double step_of(const Encoder& encoder, double turns, double otherwise) {
  constexpr double turn = 6.283185307179586476925;
  if (encoder.resolution) return *encoder.resolution / turns;
  if (encoder.counts_per_turn) return turn / *encoder.counts_per_turn / turns;
  return otherwise;
}

void set_contact(const Contact& contact, PlainDrive& plain) {
  if (const auto* rigid = std::get_if<RigidContact>(&contact)) {
    plain.restitution = rigid->restitution;
    return;
  }
  const auto& faces = std::get<CompliantContact>(contact);
  plain.contact = faces.law == ContactDamping::full ? PlainContact::spring_damping_full
                                                    : PlainContact::spring_damping_limited;
  plain.stiffness = faces.stiffness;
  plain.damping = faces.damping;
}

void set_sensor(const Sensor& sensor, double ratio, PlainDrive& plain) {
  plain.reads_load = sensor.position != SensorPlace::motor;
  const ShaftName usual = sensor.position == SensorPlace::load ? ShaftName::load : ShaftName::motor;
  plain.speed_of_load = sensor.speed.value_or(usual) == ShaftName::load;
  plain.step = step_of(sensor.encoder, plain.reads_load ? 1.0 : ratio, 0.0);
  plain.speed_step = step_of(sensor.speed_encoder, plain.speed_of_load ? 1.0 : ratio,
                             plain.reads_load == plain.speed_of_load ? plain.step : 0.0);
}

void set_law(const CascadeController& cascade, double scale, PlainController& plainly) {
  plainly.law = PlainLaw::cascade;
  plainly.position = cascade.position;
  plainly.proportional = scale * cascade.speed;
  plainly.integral = scale * cascade.speed_integral;
  plainly.tracking_time = cascade.tracking_time;
  plainly.filter = cascade.filter;
  plainly.inertia = scale * cascade.acceleration_feedforward;
  plainly.speed_share = cascade.speed_feedforward;
}

void set_law(const PID& pid, double scale, PlainController& plainly) {
  plainly.proportional = scale * pid.proportional;
  if (pid.terms == PIDTerms::PI || pid.terms == PIDTerms::PID) {
    plainly.integral = scale * pid.integral;
    plainly.tracking_time = pid.tracking_time;
  }
  if (pid.terms == PIDTerms::PD || pid.terms == PIDTerms::PID) {
    plainly.derivative = scale * pid.derivative;
    plainly.filter = pid.filter;
    plainly.derivative_of_speed = pid.derivative_of_speed;
  }
}

/// Observer form of (Σ bᵢ pⁱ)/(Σ aᵢ pⁱ) e: each number is advanced by the next one, bᵢ e − aᵢ u.
PlainSystem observer_form(std::vector<double> above, std::vector<double> below, double scale) {
  const auto first = std::find_if(below.begin(), below.end(), [](double a) { return a != 0.0; });
  const double lead = *first;
  below.erase(below.begin(), first);
  const std::size_t order = below.size() - 1;
  while (above.size() > below.size()) above.erase(above.begin());  // leading zeros
  above.insert(above.begin(), below.size() - above.size(), 0.0);
  PlainSystem system;
  const double direct = above[0] / lead;
  system.D = {scale * direct, -scale * direct, 0.0};
  system.A.assign(order * order, 0.0);
  system.C.assign(order, 0.0);
  for (std::size_t i = 0; i < order; ++i) {
    const double forward = (above[i + 1] - below[i + 1] * direct) / lead;
    system.B.push_back({forward, -forward, 0.0});
    system.A[i * order] = -below[i + 1] / lead;
    if (i + 1 < order) system.A[i * order + i + 1] = 1.0;
  }
  if (order > 0) system.C[0] = scale;
  return system;
}

void set_law(const TransferFunctionController& function, double scale, PlainController& plainly) {
  plainly.law = PlainLaw::system;
  plainly.system = observer_form(function.numerator, function.denominator, scale * function.gain);
  plainly.system.is_sampled = function.is_sampled;
}

void set_law(const LeadLagController& law, double scale, PlainController& plainly) {
  plainly.law = PlainLaw::system;
  plainly.system = observer_form({1.0 / law.zero, 1.0}, {1.0 / law.pole, 1.0}, scale * law.gain);
}

void set_law(const StateSpaceController& law, double scale, PlainController& plainly) {
  const auto of_inputs = [](const std::vector<double>& row) {
    return row.size() == 1 ? std::array{row[0], -row[0], 0.0} : std::array{row[0], row[1], row[2]};
  };
  plainly.law = PlainLaw::system;
  PlainSystem& system = plainly.system;
  for (const auto& row : law.A) system.A.insert(system.A.end(), row.begin(), row.end());
  for (const auto& row : law.B) system.B.push_back(of_inputs(row));
  system.C = law.C;
  system.D = of_inputs(law.D);
  for (double& gain : system.C) gain *= scale * law.gain;
  for (double& gain : system.D) gain *= scale * law.gain;
}

/// Of the signs that its rule gives.
void set_law(const RelayController& relay, double scale, PlainController& plainly) {
  plainly.proportional = scale * relay.level;
}

void set_error_rule(const Controller& controller, double angle, PlainController& plainly) {
  const DeadBand& band = controller.dead_band;
  plainly.width = angle * band.width;
  plainly.hysteresis = angle * band.hysteresis;
  if (const auto* relay = std::get_if<RelayController>(&controller.law)) {
    plainly.rule =
        relay->input == RelayInput::speed ? PlainErrorRule::relay_of_speed : PlainErrorRule::relay;
  } else if (band.width > 0.0) {
    plainly.rule =
        band.form == DeadBandForm::whole ? PlainErrorRule::whole : PlainErrorRule::excess;
  }
}

void set_compensation(const Compensation& compensation, double torque, double angle,
                      PlainController& plainly) {
  plainly.friction = torque * compensation.friction;
  plainly.friction_speed = angle * compensation.friction_speed;
  const double half = 0.5 * compensation.backlash;
  if (compensation.input == CompensationInput::reference) {
    plainly.reference_half_gap = half;
    plainly.take_up_time = compensation.take_up_time;
  } else if (half != 0.0) {
    plainly.rule = PlainErrorRule::take_up;
    plainly.width = angle * compensation.take_up_angle;
    plainly.half_gap = half;
  }
}

void set_controller(const Controller& controller, double ratio, PlainDrive& plain) {
  refuse(controller.firmware.has_value(), "the simulator knows no firmware's registers");
  // Torque and, for gains of the motor's shaft, the angle are those of the faster shaft.
  const double torque = controller.shaft == GainShaft::load ? 1.0 : ratio;
  const double angle = controller.shaft == GainShaft::motor ? 1.0 / ratio : 1.0;
  PlainController& plainly = plain.controller;
  // A relay gives a torque of its own, not one per angle.
  const bool is_relay = std::holds_alternative<RelayController>(controller.law);
  const double scale = is_relay ? torque : torque / angle;
  std::visit([&](const auto& law) { set_law(law, scale, plainly); }, controller.law);
  const auto* cascade = std::get_if<CascadeController>(&controller.law);
  if (cascade != nullptr && cascade->speed_limit)
    plainly.speed_limit = angle * *cascade->speed_limit;
  set_error_rule(controller, angle, plainly);
  set_compensation(controller.compensation, torque, angle, plainly);
}

void set_sampling(const Sampling& sampling, PlainDrive& plain) {
  plain.period = sampling.period;
  plain.delay = sampling.delay;
  if (sampling.position_period) {
    plain.controller.position_ticks =
        static_cast<int>(std::lround(*sampling.position_period / sampling.period));
  }
  plain.has_tachometer = !sampling.speed_by_differences;
  plain.blend = sampling.method == Discretization::tustin     ? 0.5
                : sampling.method == Discretization::backward ? 1.0
                                                              : 0.0;
}

}  // namespace

double PlainDrive::small_length() const {
  constexpr double without_gap = 1e-3;
  double length = backlash > 0.0 ? backlash : without_gap;
  if (step > 0.0) length = std::min(length, step);
  if (speed_step > 0.0 && !has_tachometer) length = std::min(length, speed_step);
  return length;
}

bool PlainDrive::needs_computer() const {
  return controller.law != PlainLaw::PID || controller.integral != 0.0 || controller.filter > 0.0 ||
         controller.rule != PlainErrorRule::as_it_is || controller.friction != 0.0 ||
         controller.reference_half_gap != 0.0 || step > 0.0 || current_rate > 0.0;
}

PlainDrive plain_drive(const Drive& drive) {
  refuse(drive.servo.has_value(), "the simulator takes no normal form");
  const double ratio = drive.gearbox.ratio;
  PlainDrive plain;
  set_motor(drive.motor, drive.gearbox, plain);
  plain.load = shaft_of(drive.load.inertia, drive.load.friction, 1.0);
  plain.backlash = drive.gearbox.backlash;
  set_contact(drive.contact, plain);
  set_sensor(drive.sensor, ratio, plain);
  set_controller(drive.controller, ratio, plain);
  if (drive.sampling) set_sampling(*drive.sampling, plain);
  if (!drive.sampling) plain.has_tachometer = true;
  const PlainSignal reference = plain_signal(drive.reference.value_or(0.0));
  const PlainSignal load_torque = plain_signal(drive.load_torque.value_or(0.0));
  plain.reference = reference.constant;
  plain.reference_course = reference.course;
  plain.load_torque = load_torque.constant;
  plain.load_torque_course = load_torque.course;
  // The weight, linearised about the reference.
  const double angle = drive.load.gravity_angle + plain.reference;
  plain.load_torque -= drive.load.gravity * std::cos(angle);
  plain.gravity_stiffness = -drive.load.gravity * std::sin(angle);
  return plain;
}

PlainDrive settled(PlainDrive drive) {
  drive.reference_course = drive.reference_course.settled();
  drive.load_torque_course = drive.load_torque_course.settled();
  return drive;
}

}  // namespace gearlash::oracle
