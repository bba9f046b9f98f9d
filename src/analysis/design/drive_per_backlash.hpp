// A drawn drive whose backlash is taken apart: sizes are in proportion to it.
#pragma once

#include <optional>
#include <span>

#include "analysis/design/toleranced_drive.hpp"

namespace gearlash::detail {

struct DrivePerBacklash {
  TimedServo drive;       ///< with a backlash of 1 rad, if it has any
  double backlash = 0.0;  ///< rad
};

/// Throws InvalidInput where the values make no drive. Precondition: as many values as there are
/// varied numbers, all of the drive.
DrivePerBacklash drive_per_backlash(const TolerancedDrive& drive, std::span<const double> values);

/// The same for values that each by itself are sound, as validate(TolerancedDrive) has made sure;
/// nothing where the servo that they make is none all the same.
std::optional<DrivePerBacklash> sound_drive_per_backlash(const TolerancedDrive& drive,
                                                         std::span<const double> values);

}  // namespace gearlash::detail
