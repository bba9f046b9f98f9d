#include "model/proportional_servo.hpp"

#include <algorithm>
#include <cmath>

namespace gearlash::drive {
namespace {

/// Whether gains for reference and position are equal and no state reaches the output. An
/// integrator without gain, or a lead-lag element whose zero equals its pole, is proportional too.
bool is_proportional(const LinearController& controller) {
  const auto is_zero = [](double gain) { return gain == 0.0; };
  return std::all_of(controller.output.begin(), controller.output.end(), is_zero) &&
         controller.direct[0] == -controller.direct[1];
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
