// Converts between the servo of the closed form and drives.
#pragma once

#include <optional>

#include "model/drive.hpp"
#include "model/drivetrain.hpp"

namespace gearlash::drive {

/// τ = K (r − θ), with θ from the sensor's shaft. Precondition: sound, both inertias and the
/// backlash positive.
template <class Number>
ReducedDriveOf<Number> drive_of(const DrivetrainOf<Number>& drivetrain) {
  ReducedDriveOf<Number> drive;
  drive.motor = {drivetrain.motor_inertia, {.viscous = drivetrain.motor_friction}};
  drive.load = {drivetrain.load_inertia, {.viscous = drivetrain.load_friction}};
  drive.backlash = drivetrain.backlash;
  drive.contact = RigidContactOf<Number>{drivetrain.restitution};
  drive.sensing.load_share_of_position = drivetrain.sensor == ShaftName::load ? 1.0 : 0.0;
  drive.controller.direct = {drivetrain.stiffness, -drivetrain.stiffness, -0.0};
  return drive;
}

/// The servo of the closed form that is equivalent to a drive: proportional control of the load's
/// position, continuous, read exactly and without limit, rigid faces, no dry friction, a constant
/// reference, no load torque. The speed may be fed back from the motor alone, which counts as
/// friction on it. Empty for any other drive. Its numbers may be beyond the ranges of the closed
/// form. Precondition: the controller is sound.
std::optional<Drivetrain> proportional_drivetrain(const ReducedDrive& drive);

}  // namespace gearlash::drive
