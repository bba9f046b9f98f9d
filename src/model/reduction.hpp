// A drive referred to the load's shaft, for any numbers: doubles, or intervals around its data.
#pragma once

#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "base/number.hpp"
#include "base/overloaded.hpp"
#include "gearlash/drive.hpp"
#include "model/controller_forms.hpp"
#include "model/drive.hpp"
#include "model/drivetrain.hpp"
#include "model/firmware.hpp"
#include "model/proportional_servo.hpp"
#include "model/reduced_drive.hpp"

namespace gearlash {

/// The final course of a drive's signals; 0 where there is none.
template <class Number>
struct CourseOf {
  Number reference = 0.0;       ///< rad, of a ramp its value at time 0
  Number reference_rate = 0.0;  ///< rad/s
  Number load_torque = 0.0;     ///< N m, of a sine its mean; with the weight's at the reference
  Number load_torque_amplitude = 0.0;  ///< N m

  static constexpr auto members() {
    return std::make_tuple(&CourseOf::reference, &CourseOf::reference_rate, &CourseOf::load_torque,
                           &CourseOf::load_torque_amplitude);
  }
};

/// A share of the weight that rounding of the angle has left: 0.
inline double without_rounding(double share) {
  constexpr double rounding = 4.0 * std::numeric_limits<double>::epsilon();
  return std::abs(share) <= rounding ? 0.0 : share;
}
template <class Number>
Number without_rounding(const Number& share) {
  return share;
}

/// `Datum` makes a Number of each double of the drive: AsRead or AsWritten. What the reduced drive
/// consists of is decided by the doubles.
template <class Datum>
class Reduction {
 public:
  using Number = decltype(std::declval<const Datum&>()(0.0));

  /// Precondition: `drive` outlives it, and its controller has no registers, or they have been
  /// converted, `is_converted`.
  explicit Reduction(const Drive& drive, Datum datum = {}, bool is_converted = false)
      : drive_(drive), datum_(std::move(datum)), is_converted_(is_converted) {}

  drive::ReducedDriveOf<Number> drive() const {
    drive::ReducedDriveOf<Number> reduced = plant();
    reduced.contact = contact();
    reduced.sensing = sensing();
    count_thresholds(reduced);
    reduced.sampling = drive_.sampling;
    reduced.reference = drive_.reference.value_or(0.0);
    // A reference that does not move has nothing to be compensated.
    if (std::holds_alternative<double>(reduced.reference)) reduced.feedforward = {};
    reduced.gravity = gravity();
    reduced.has_rounded_lists = drive_.is_rounded && !drive_.servo;
    reduced.load_torque = drive_.load_torque.value_or(0.0);
    return reduced;
  }

  /// Precondition: sound signals.
  CourseOf<Number> course() const {
    CourseOf<Number> course;
    const Signal reference = drive::settled(drive_.reference.value_or(0.0));
    course.reference = datum_(drive::middle_of(reference));
    if (const auto* ramp = std::get_if<RampSignal>(&reference)) {
      course.reference_rate = datum_(ramp->rate);
    }
    const Signal load_torque = drive::settled(drive_.load_torque.value_or(0.0));
    course.load_torque = datum_(drive::middle_of(load_torque)) + gravity().torque;
    if (const auto* sine = std::get_if<SineSignal>(&load_torque)) {
      course.load_torque_amplitude = datum_(sine->amplitude);
    }
    return course;
  }

  /// The servo of a normal form: J_M + J_L = 1 kg m².
  DrivetrainOf<Number> drivetrain_of_form() const {
    const NormalForm& form = *drive_.servo;
    const Number frequency = form.natural_frequency ? datum_(*form.natural_frequency) : Number(1.0);
    const Number friction = 2.0 * datum_(form.damping) * frequency;
    const Number friction_ratio = datum_(form.friction_ratio);
    const Number ratio = datum_(form.inertia_ratio);
    const bool is_massless = std::isinf(form.inertia_ratio);  // the motor
    DrivetrainOf<Number> drivetrain;
    drivetrain.stiffness = frequency * frequency;
    drivetrain.motor_inertia = is_massless ? Number(0.0) : Number(1.0 / (1.0 + ratio));
    drivetrain.load_inertia = is_massless ? Number(1.0) : Number(ratio / (1.0 + ratio));
    drivetrain.motor_friction = friction * not_negative(Number(1.0 - friction_ratio));
    drivetrain.load_friction = friction * friction_ratio;
    drivetrain.backlash = datum_(form.backlash);
    drivetrain.restitution = restitution();
    return drivetrain;
  }

  /// Below: see reduced_drive.hpp.
  Number motor_inertia() const {
    return (datum_(drive_.motor.inertia) + datum_(drive_.gearbox.inertia)) * (ratio() * ratio());
  }
  static Number coulomb_torque(const Motor& motor, const Datum& datum = {}) {
    if (!motor.no_load_current || !takes_no_load_current(motor)) {
      return datum(motor.friction.coulomb);
    }
    return datum(*torque_constant_of(motor)) * datum(*motor.no_load_current);
  }
  static std::optional<Number> output_limit(const Motor& motor, const Datum& datum = {}) {
    if (motor.current_limit && limits_torque_by_current(motor)) {
      return datum(*torque_constant_of(motor)) * datum(*motor.current_limit);
    }
    return motor.limit ? std::optional<Number>(datum(*motor.limit)) : std::nullopt;
  }
  Number output_scale() const {
    const bool has_torque = std::holds_alternative<TorqueControl>(drive_.motor.kind);
    if (has_torque && drive_.controller.shaft == GainShaft::load) return 1.0;
    return output().torque;
  }
  Number gain_scale() const {
    const bool is_of_motor = drive_.controller.shaft == GainShaft::motor;
    return output_scale() * (is_of_motor ? ratio() : Number(1.0));
  }
  ReferredOutputOf<Number> output() const {
    ReferredOutputOf<Number> output = output_of_motor();
    const double feedback = drive_.controller.motor_speed_feedback;
    if (feedback != 0.0) {
      output.friction = output.friction + output.torque * ratio() * datum_(feedback);
    }
    return output;
  }
  Number restitution() const {
    const auto* rigid = std::get_if<RigidContact>(&drive_.contact);
    return rigid == nullptr ? Number(0.0) : datum_(rigid->restitution);
  }
  /// `scale`: torque at the load per unit of a gain.
  drive::LinearControllerOf<Number> controller(const Number& scale) const {
    const auto gain = [this](double value) {
      return is_converted_ ? datum_.converted(value) : datum_(value);
    };
    return std::visit([&](const auto& law) { return drive::forms::linear(law, gain, scale); },
                      drive_.controller.law);
  }

 private:
  Number ratio() const { return datum_(drive_.gearbox.ratio); }

  ReferredOutputOf<Number> output_of_motor() const {
    const Number square = ratio() * ratio();
    return std::visit(
        Overloaded{[&](const TorqueControl&) {
                     return ReferredOutputOf<Number>{ratio(), 0.0};
                   },
                   [&](const ArmatureControl& motor) {
                     const Number per_volt =
                         datum_(motor.torque_constant) / datum_(motor.resistance);
                     return ReferredOutputOf<Number>{
                         per_volt * ratio(), per_volt * datum_(motor.back_emf_constant) * square};
                   },
                   [&](const FieldControl& motor) {
                     return ReferredOutputOf<Number>{
                         datum_(motor.torque_constant) / datum_(motor.resistance) * ratio(), 0.0};
                   },
                   [&](const TwoPhase& motor) {
                     return ReferredOutputOf<Number>{datum_(motor.torque_per_volt) * ratio(),
                                                     datum_(motor.torque_per_speed) * square};
                   }},
        drive_.motor.kind);
  }
  /// A shaft that turns `ratio` times as far as the load's.
  drive::ShaftFrictionOf<Number> referred(const Friction& friction, const Number& coulomb,
                                          const Number& ratio) const {
    return {.viscous = datum_(friction.viscous) * (ratio * ratio),
            .coulomb = coulomb * ratio,
            .breakaway = (friction.breakaway ? datum_(*friction.breakaway) : coulomb) * ratio,
            .stribeck_speed = datum_(friction.stribeck_speed) / ratio};
  }

  drive::ReducedDriveOf<Number> plant() const {
    if (drive_.servo) return drive::drive_of(drivetrain_of_form());
    const ReferredOutputOf<Number> output = this->output();
    drive::ReducedDriveOf<Number> reduced;
    reduced.motor = {motor_inertia(), referred(drive_.motor.friction,
                                               coulomb_torque(drive_.motor, datum_), ratio())};
    reduced.winding = {.time_constant = electrical_time(),
                       .back_emf = output.friction,
                       .torque_limit = current_torque()};
    if (is_exactly(reduced.winding.time_constant, 0.0)) {
      reduced.motor.friction.viscous = reduced.motor.friction.viscous + output.friction;
    }
    const Friction& of_load = drive_.load.friction;
    reduced.load = {datum_(drive_.load.inertia), referred(of_load, datum_(of_load.coulomb), 1.0)};
    reduced.backlash = datum_(drive_.gearbox.backlash);
    if (const auto limit = output_limit(drive_.motor, datum_))
      reduced.torque_limit = output.torque * *limit;
    const bool is_relay = std::holds_alternative<RelayController>(drive_.controller.law);
    reduced.controller = controller(is_relay ? output_scale() : gain_scale());
    reduced.error_shape = error_shape();
    reduced.feedforward = feedforward();
    return reduced;
  }

  /// The lag of the winding, or of the amplifier that controls its current, s.
  Number electrical_time() const {
    if (const auto* controlled = std::get_if<TorqueControl>(&drive_.motor.kind)) {
      if (!controlled->current_bandwidth) return 0.0;
      return 1.0 / datum_(*controlled->current_bandwidth);
    }
    const auto* armature = std::get_if<ArmatureControl>(&drive_.motor.kind);
    if (armature == nullptr) return 0.0;
    return datum_(armature->inductance) / datum_(armature->resistance);
  }

  /// The torque of the largest current at the load, N m.
  Number current_torque() const {
    const Motor& motor = drive_.motor;
    if (!motor.current_limit || !takes_current_limit(motor) || limits_torque_by_current(motor)) {
      return std::numeric_limits<double>::infinity();
    }
    const auto* armature = std::get_if<ArmatureControl>(&motor.kind);
    const double constant = armature != nullptr
                                ? armature->torque_constant
                                : std::get<FieldControl>(motor.kind).torque_constant;
    return datum_(constant) * datum_(*motor.current_limit) * ratio();
  }

  // ---- controllers ------------------------------------------------------------------------------

  /// Angles of the gains' shaft at the load.
  Number angle_scale() const {
    return drive_.controller.shaft == GainShaft::motor ? Number(1.0 / ratio()) : Number(1.0);
  }

  drive::ErrorShapeOf<Number> error_shape() const {
    const Controller& controller = drive_.controller;
    const Number scale = angle_scale();
    const Number width = datum_(controller.dead_band.width) * scale;
    const Number hysteresis = datum_(controller.dead_band.hysteresis) * scale;
    if (const auto* relay = std::get_if<RelayController>(&controller.law)) {
      return {.begins = width + hysteresis,
              .ends = width - hysteresis,
              .inner_gain = 0.0,
              .outer_gain = 0.0,
              .offset = 1.0,
              .is_of_speed = relay->input == RelayInput::speed,
              .jumps = true};
    }
    const bool has_dead_band = controller.dead_band.width > 0.0;
    if (has_dead_band && controller.dead_band.form == DeadBandForm::whole) {
      return {.begins = width + hysteresis,
              .ends = width - hysteresis,
              .inner_gain = 0.0,
              .jumps = true};
    }
    if (has_dead_band) {
      return {.begins = width, .ends = width, .inner_gain = 0.0, .offset = -width};
    }
    const Compensation& compensation = controller.compensation;
    const auto* cascade = std::get_if<CascadeController>(&controller.law);
    if (cascade != nullptr && cascade->speed_limit && cascade->position != 0.0) {
      using std::abs;
      const Number limit = datum_(*cascade->speed_limit) / abs(datum_(cascade->position)) * scale;
      return {.begins = limit, .ends = limit, .outer_gain = 0.0, .offset = limit};
    }
    if (compensation.backlash == 0.0 || compensation.input == CompensationInput::reference) {
      return {};
    }
    const Number angle = datum_(compensation.take_up_angle) * scale;
    const Number half = 0.5 * datum_(compensation.backlash);
    return {.begins = angle, .ends = angle, .inner_gain = 1.0 + half / angle, .offset = half};
  }

  drive::FeedforwardOf<Number> feedforward() const {
    const Compensation& compensation = drive_.controller.compensation;
    const bool is_by_reference = compensation.input == CompensationInput::reference;
    drive::FeedforwardOf<Number> result{
        .torque = output_scale() * datum_(compensation.friction),
        .speed = datum_(compensation.friction_speed) * angle_scale(),
        .half_gap = is_by_reference ? Number(0.5 * datum_(compensation.backlash)) : Number(0.0),
        .take_up_time = datum_(compensation.take_up_time)};
    if (const auto* cascade = std::get_if<CascadeController>(&drive_.controller.law)) {
      // w = position (e + lead ṙ).
      if (cascade->speed_feedforward != 0.0 && cascade->position != 0.0) {
        result.lead = datum_(cascade->speed_feedforward) / datum_(cascade->position);
      }
      result.inertia = gain_scale() * datum_(cascade->acceleration_feedforward);
    }
    return result;
  }

  // ---- sensors, contact, signals ----------------------------------------------------------------

  /// Step at the load's shaft of an encoder on a shaft that turns `ratio` times as far.
  std::optional<Number> step_of(const Encoder& encoder, const Number& ratio) const {
    const Number referred = 1.0 / ratio;
    if (encoder.resolution) return Number(referred * datum_(*encoder.resolution));
    if (!encoder.counts_per_turn) return std::nullopt;
    return Number(referred * 2.0 * Datum::pi() / datum_(*encoder.counts_per_turn));
  }

  drive::SensingOf<Number> sensing() const {
    const Sensor& sensor = drive_.sensor;
    const Number gear_ratio = drive_.servo ? Number(1.0) : ratio();
    const bool is_on_load = sensor.position != SensorPlace::motor;
    const ShaftName of_position =
        sensor.position == SensorPlace::load ? ShaftName::load : ShaftName::motor;
    const bool speed_on_load = sensor.speed.value_or(of_position) == ShaftName::load;
    drive::SensingOf<Number> sensing;
    sensing.load_share_of_position = is_on_load ? 1.0 : 0.0;
    sensing.load_share_of_speed = speed_on_load ? 1.0 : 0.0;
    sensing.resolution =
        step_of(sensor.encoder, is_on_load ? Number(1.0) : gear_ratio).value_or(0.0);
    sensing.resolution_of_speed =
        step_of(sensor.speed_encoder, speed_on_load ? Number(1.0) : gear_ratio)
            .value_or(is_on_load == speed_on_load ? sensing.resolution : Number(0.0));
    return sensing;
  }

  /// Firmware compares counts: a threshold within rounding of a whole number of an encoder's steps
  /// is that number of them, as what it reads is.
  static Number counted(const Number& threshold, const Number& step) {
    const double ratio = approximate(Number(threshold / step));
    const double steps = std::round(ratio);
    constexpr double rounding = 1e-9;
    return std::abs(ratio - steps) <= rounding * std::abs(steps) ? Number(steps * step) : threshold;
  }
  static void count_thresholds(drive::ReducedDriveOf<Number>& reduced) {
    const Number step = reduced.sensing.resolution;
    drive::ErrorShapeOf<Number>& shape = reduced.error_shape;
    if (is_exactly(step, 0.0) || shape.is_of_speed || !is_exactly(shape.inner_gain, 0.0)) return;
    shape.begins = counted(shape.begins, step);
    shape.ends = counted(shape.ends, step);
    const bool is_relay = is_exactly(shape.outer_gain, 0.0);
    if (!is_relay) shape.offset = counted(shape.offset, step);
  }

  drive::ContactOf<Number> contact() const {
    const auto* faces = std::get_if<CompliantContact>(&drive_.contact);
    if (faces == nullptr) return drive::RigidContactOf<Number>{restitution()};
    return drive::CompliantContactOf<Number>{datum_(faces->stiffness), datum_(faces->damping),
                                             faces->law};
  }

  /// Linearised about the angle where the reference ends.
  drive::GravityOf<Number> gravity() const {
    if (drive_.servo || drive_.load.gravity == 0.0) return {};
    const Signal reference = drive_.reference.value_or(0.0);
    if (!drive::faults(reference, "reference").empty()) return {};  // such as an empty table
    const Number at = datum_(drive::middle_of(drive::settled(reference)));
    const Number angle = datum_(drive_.load.gravity_angle) + at;
    const Number weight = datum_(drive_.load.gravity);
    using std::cos;
    using std::sin;
    return {.torque = -weight * without_rounding(Number(cos(angle))),
            .stiffness = -weight * without_rounding(Number(sin(angle))),
            .angle = at};
  }

  const Drive& drive_;
  Datum datum_;
  bool is_converted_;
};

/// The drive with its registers converted.
template <class Datum>
auto reduced(const Drive& drive, const Datum& datum) {
  if (!drive.controller.firmware) return Reduction<Datum>(drive, datum).drive();
  const Drive converted = without_registers(drive);
  return Reduction<Datum>(converted, datum, true).drive();
}

}  // namespace gearlash
