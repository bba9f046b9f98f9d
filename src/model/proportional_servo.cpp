#include "model/proportional_servo.hpp"

#include <cmath>
#include <utility>

#include "base/lists.hpp"
#include "model/parameters.hpp"
#include "model/reduced_drive.hpp"
#include "model/reduction.hpp"

namespace gearlash::drive {
namespace {

/// Whether gains for reference and position are equal and no state reaches the output. An
/// integrator without gain, or a lead-lag element whose zero equals its pole, is proportional too.
bool is_proportional(const LinearController& controller) {
  const auto is_zero = [](double gain) { return gain == 0.0; };
  return all_of(controller.output, is_zero) && controller.direct[0] == -controller.direct[1];
}

bool is_undisturbed(const ReducedDrive& drive) {
  const auto* load_torque = std::get_if<double>(&drive.load_torque);
  return std::holds_alternative<double>(drive.reference) && load_torque != nullptr &&
         *load_torque == 0.0 && drive.gravity.is_absent();
}

bool is_smooth(const ReducedDrive& drive) {
  return has_linear_control(drive) && std::isinf(drive.winding.torque_limit) && !drive.sampling &&
         drive.sensing.resolution == 0.0 && std::isinf(drive.torque_limit) &&
         drive.winding.time_constant == 0.0 && !drive::has_dry_friction(drive);
}

}  // namespace

std::optional<Drivetrain> proportional_drivetrain(const ReducedDrive& drive) {
  const auto* rigid = std::get_if<RigidContact>(&drive.contact);
  if (rigid == nullptr || !is_smooth(drive) || !is_undisturbed(drive)) return std::nullopt;
  if (drive.sensing.load_share_of_position != 1.0) return std::nullopt;
  const LinearController& controller = drive.controller;
  if (drive.has_rounded_lists || !is_proportional(controller)) return std::nullopt;
  // The torque acts on the motor, so only feedback of the motor's speed acts as friction.
  const double feedback = -controller.direct[2];
  if (feedback != 0.0 && drive.sensing.load_share_of_speed != 0.0) return std::nullopt;
  Drivetrain drivetrain;
  drivetrain.motor_inertia = drive.motor.inertia;
  drivetrain.load_inertia = drive.load.inertia;
  drivetrain.motor_friction = drive.motor.friction.viscous + feedback;
  drivetrain.load_friction = drive.load.friction.viscous;
  drivetrain.stiffness = controller.direct[0];
  drivetrain.backlash = drive.backlash;
  drivetrain.restitution = rigid->restitution;
  return drivetrain;
}

}  // namespace gearlash::drive

namespace gearlash {
namespace {

ProportionalServo servo_with(const Drive& drive, const Drivetrain& drivetrain) {
  ProportionalServo servo{.drivetrain = drivetrain};
  if (!drive.servo || is_normalized(drive)) servo.stiffness = drivetrain.stiffness;
  if (!drive.servo) {
    servo.servo = normalize_sound(drivetrain);
    servo.natural_frequency = natural_frequency(drivetrain);
    return servo;
  }
  servo.is_as_given = true;
  servo.natural_frequency = drive.servo->natural_frequency.value_or(1.0);
  servo.servo = servo_with_restitution(*drive.servo, Reduction<AsRead>(drive).restitution());
  return servo;
}

/// `reduced`: the drive at the load's shaft.
std::optional<ProportionalServo> servo_of(const Drive& drive, const drive::ReducedDrive& reduced) {
  const std::optional<Drivetrain> drivetrain = drive::proportional_drivetrain(reduced);
  if (!drivetrain || (!drive.servo && !faults(*drivetrain).empty())) return std::nullopt;
  return servo_with(drive, *drivetrain);
}

}  // namespace

NormalizedServo servo_with_restitution(const NormalForm& form, double restitution) {
  return {.damping = form.damping,
          .inertia_ratio = form.inertia_ratio,
          .friction_ratio = form.friction_ratio,
          .backlash = form.backlash,
          .restitution = restitution};
}

std::optional<ProportionalServo> proportional_servo(const Drive& drive) {
  return servo_of(drive, reduce(drive));
}

std::optional<ProportionalServo> settled_servo(const SoundDrive& drive) {
  return servo_of(drive.given(), drive.settled());
}

ProportionalServo servo_without_checks(const Drive& drive) {
  return servo_with(drive, referred_drivetrain(drive));
}

std::optional<Drive> normal_form_of(const Drive& drive) {
  const std::optional<ProportionalServo> found = proportional_servo(drive);
  if (!found) return std::nullopt;
  const NormalizedServo& servo = found->servo;
  Drive form = normal_form(servo.damping, servo.inertia_ratio, servo.friction_ratio, servo.backlash,
                           servo.restitution);
  form.servo->natural_frequency = found->natural_frequency;
  form.specification = drive.specification;
  form.is_rounded = drive.is_rounded || !found->is_as_given;
  return form;
}

Drive without_ended_signals(Drive drive) {
  if (drive.reference && std::holds_alternative<double>(drive::settled(*drive.reference))) {
    drive.reference.reset();
  }
  if (drive.load_torque && drive::settled(*drive.load_torque) == Signal{0.0}) {
    drive.load_torque.reset();
  }
  return drive;
}

bool enters_servo(const Drive& drive, std::string_view path) {
  const Parameter* parameter = find_parameter(path, drive);
  if (parameter == nullptr && drive.servo) return enters_servo(physical_form(drive), path);
  if (parameter == nullptr || !exists(*parameter, drive)) return false;
  // A factor of 0 would hide what it multiplies.
  Drive present = drive;
  if (present.servo && present.servo->damping == 0.0) present.servo->damping = 1.0;
  if (present.gearbox.ratio == 0.0) present.gearbox.ratio = 1.0;
  Drive changed = present;
  double* place = given_number(parameter->slot(changed));
  if (place == nullptr || (*place == 0.0 && parameter->path == "gearbox.inertia")) return false;
  *place = *place == 0.0 || std::isinf(*place) ? 0.5 : 0.75 * *place;
  const auto after = drive::proportional_drivetrain(reduce(changed));
  return after && *after != drive::proportional_drivetrain(reduce(present));
}

}  // namespace gearlash
