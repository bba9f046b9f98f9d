// Time scales of a drive.
#pragma once

#include "model/drive.hpp"

namespace gearlash::drive {

/// Rough time scales of the linear loop with the faces together, without dry friction and limits.
struct TimeScales {
  /// s: 2π/|λ|, with λ the slowest eigenvalue that oscillates, else the slowest. At least the
  /// period of a sine reference or load torque, and ten sampling periods. 1 if nothing moves.
  double swing = 1.0;
  double settling = 0.0;  ///< s: time in which the slowest decay falls to 1/e; 0 if there is none
};

/// Precondition: sound.
TimeScales time_scales(const ReducedDrive& drive);

}  // namespace gearlash::drive
