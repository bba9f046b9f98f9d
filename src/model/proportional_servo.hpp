// The servo of the closed form as a drive, and drives that are one.
#pragma once

#include <optional>

#include "model/drive.hpp"
#include "model/drivetrain.hpp"

namespace gearlash::drive {

/// τ = K (r − θ) by what the sensor's shaft shows. Precondition: sound, both inertias and the
/// backlash positive.
ReducedDrive drive_of(const Drivetrain& drivetrain);

/// The servo of the closed form that a drive is: proportional control of the load's position,
/// continuous, read exactly and without limit, speed fed back from the motor alone (which is
/// friction on it), faces rigid, no dry friction, a constant reference, no load torque. Nothing for
/// any other drive. Precondition: validate(drive) is empty.
std::optional<Drivetrain> proportional_servo(const ReducedDrive& drive);

/// The same without the check that its numbers are within the ranges of the closed form.
/// Precondition: the controller is sound.
std::optional<Drivetrain> proportional_drivetrain(const ReducedDrive& drive);

}  // namespace gearlash::drive
