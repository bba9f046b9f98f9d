// How fast a drive is.
#pragma once

#include "model/drive.hpp"

namespace gearlash::drive {

/// Scales for times, no more: of the linear loop with the faces together, without dry friction and
/// limits.
struct TimeScales {
  /// s: 2π/|λ|, λ the slowest eigenvalue that swings, else the slowest; at least the period of a
  /// reference or load torque that is a sine, and ten sampling periods. 1 where nothing moves.
  double swing = 1.0;
  double settling = 0.0;  ///< s: in which the slowest decay falls to 1/e; 0 where there is none
};

/// Precondition: sound.
TimeScales time_scales(const ReducedDrive& drive);

}  // namespace gearlash::drive
