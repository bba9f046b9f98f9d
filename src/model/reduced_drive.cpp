#include "model/reduced_drive.hpp"

#include <cstdint>
#include <string>

#include "base/decimal.hpp"
#include "model/reduction.hpp"

namespace gearlash {

std::optional<double> torque_constant_of(const Motor& motor) {
  if (const auto* controlled = std::get_if<TorqueControl>(&motor.kind)) {
    return controlled->torque_constant;
  }
  const auto* armature = std::get_if<ArmatureControl>(&motor.kind);
  return armature == nullptr ? std::nullopt : std::optional(armature->torque_constant);
}

bool takes_no_load_current(const Motor& motor) { return torque_constant_of(motor).has_value(); }

double coulomb_torque(const Motor& motor) { return Reduction<AsRead>::coulomb_torque(motor); }

bool limits_torque_by_current(const Motor& motor) {
  return std::holds_alternative<TorqueControl>(motor.kind) && torque_constant_of(motor);
}

bool takes_current_limit(const Motor& motor) {
  return limits_torque_by_current(motor) || std::holds_alternative<ArmatureControl>(motor.kind) ||
         std::holds_alternative<FieldControl>(motor.kind);
}

std::optional<double> output_limit(const Motor& motor) {
  return Reduction<AsRead>::output_limit(motor);
}

bool is_cascade(const Drive& drive) {
  const std::optional<Firmware>& firmware = drive.controller.firmware;
  if (drive.servo) return false;
  if (!firmware) return std::holds_alternative<CascadeController>(drive.controller.law);
  return std::holds_alternative<ODrive>(*firmware) || std::holds_alternative<SimpleFOC>(*firmware);
}

double output_scale(const Drive& drive) { return Reduction<AsRead>(drive).output_scale(); }

double gain_scale(const Drive& drive) { return Reduction<AsRead>(drive).gain_scale(); }

ReferredOutput refer_output(const Drive& drive) { return Reduction<AsRead>(drive).output(); }

drive::ReducedDrive with_settled_signals(drive::ReducedDrive reduced) {
  reduced.reference = drive::settled(reduced.reference);
  reduced.load_torque = drive::settled(reduced.load_torque);
  // A reference that does not move has nothing to be compensated.
  if (std::holds_alternative<double>(reduced.reference)) reduced.feedforward = {};
  return reduced;
}

drive::ReducedDrive reduce_settled(const Drive& drive) {
  return with_settled_signals(reduce(drive));
}

namespace {

/// 1 − φ of the decimal that a ratio above ½ stands for: a difference of doubles would have the
/// error of φ, which may be all of it, and proofs take data for right to some units in the last
/// place.
double complement(double ratio) {
  if (!(ratio > 0.5 && ratio < 1.0)) return 1.0 - ratio;
  const std::string digits = shortest_text(ratio).substr(2);  // of "0.9999"
  std::uint64_t whole = 1;
  for (std::size_t i = 0; i < digits.size(); ++i) whole *= 10;
  return *nearest_double(std::to_string(whole - std::stoull(digits)) + "e-" +
                         std::to_string(digits.size()));
}

}  // namespace

Drive physical_form(const Drive& drive) {
  if (!drive.servo) return drive;
  Drivetrain drivetrain = Reduction<AsRead>(drive).drivetrain_of_form();
  const NormalForm& form = *drive.servo;
  drivetrain.motor_friction =
      2.0 * form.damping * form.natural_frequency.value_or(1.0) * complement(form.friction_ratio);
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

namespace {

/// Output per error and per sensed speed of a proportional controller.
struct ProportionalGains {
  double error = 0.0;
  double speed = 0.0;
};

ProportionalGains gains_of(const Drive& drive) {
  const Controller& controller = drive.controller;
  if (const auto* pid = std::get_if<PID>(&controller.law)) {
    const bool has_derivative = pid->terms == PIDTerms::PD || pid->terms == PIDTerms::PID;
    return {pid->proportional, has_derivative ? pid->derivative : 0.0};
  }
  if (const auto* cascade = std::get_if<CascadeController>(&controller.law)) {
    return {cascade->position * cascade->speed, cascade->speed};
  }
  const drive::LinearController linear = Reduction<AsRead>(drive).controller(1.0);
  return {linear.direct[0], -linear.direct[2]};
}

}  // namespace

Drivetrain referred_drivetrain(const Drive& drive) {
  if (drive.servo) return Reduction<AsRead>(drive).drivetrain_of_form();
  const double ratio = drive.gearbox.ratio;
  const double square = ratio * ratio;
  const ReferredOutput output = refer_output(drive);
  const double per_output = gain_scale(drive);
  const ProportionalGains gains = gains_of(drive);
  return {.motor_inertia = Reduction<AsRead>(drive).motor_inertia(),
          .load_inertia = drive.load.inertia,
          .motor_friction =
              drive.motor.friction.viscous * square + output.friction + per_output * gains.speed,
          .load_friction = drive.load.friction.viscous,
          .stiffness = per_output * gains.error,
          .backlash = drive.gearbox.backlash,
          .restitution = Reduction<AsRead>(drive).restitution()};
}

}  // namespace gearlash
