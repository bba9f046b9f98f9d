// Converts between the servo of the closed form and drives.
#pragma once

#include <optional>

#include "model/drive.hpp"
#include "model/drivetrain.hpp"

namespace gearlash::drive {

/// τ = K (r − θ), with θ from the sensor's shaft. Precondition: sound, both inertias and the
/// backlash positive.
ReducedDrive drive_of(const Drivetrain& drivetrain);

/// The servo of the closed form that is equivalent to a drive: proportional control of the load's
/// position, continuous, read exactly and without limit, rigid faces, no dry friction, a constant
/// reference, no load torque. The speed may be fed back from the motor alone, which counts as
/// friction on it. Empty for any other drive. Precondition: validate(drive) is empty.
std::optional<Drivetrain> proportional_servo(const ReducedDrive& drive);

/// The same without the check that its numbers are within the ranges of the closed form.
/// Precondition: the controller is sound.
std::optional<Drivetrain> proportional_drivetrain(const ReducedDrive& drive);

}  // namespace gearlash::drive
