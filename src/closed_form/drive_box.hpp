// All drives that the data of a drive may stand for.
#pragma once

#include "closed_form/cycle_bounds.hpp"
#include "model/proportional_servo.hpp"

namespace gearlash {

/// Bounds of the drivetrain's error relative to the drive's data. Precondition: `drivetrain` is
/// that of the drive's proportional_servo().
DataError data_error_of(const Drive& drive, const Drivetrain& drivetrain);
/// Whether the rounding of the motor's friction can be bounded closely: with negative feedback it
/// is a difference, of which more than a millionth must be left. Precondition as above.
bool has_resolved_friction(const Drive& drive, const Drivetrain& drivetrain);
/// All that the drive's data may stand for. Precondition: `servo` is its settled_servo().
DriveBox box_of(const Drive& drive, const ProportionalServo& servo);

/// How proofs read the numbers of its normal form.
Reading reading_of(const Drive& drive);

}  // namespace gearlash
