// Time scales of a drive.
#pragma once

#include <complex>
#include <vector>

#include "model/drive.hpp"

namespace gearlash::drive {

/// Rough time scales of the linear loop with the faces together, without dry friction and limits.
struct TimeScales {
  /// s: 2π/|λ|, with λ the slowest eigenvalue that oscillates, else the slowest. At least the
  /// period of a sine reference or load torque, and ten sampling periods. 1 if nothing moves.
  double swing = 1.0;
  double settling = 0.0;  ///< s: time in which the slowest decay falls to 1/e; 0 if there is none
};

/// Eigenvalues of the linear loop with the faces together, 1/s, without those that are 0 within
/// rounding. For a sampled loop, those of the continuous flow with the same motion from sample to
/// sample. A relay counts by its describing function. Precondition: sound.
std::vector<std::complex<double>> loop_eigenvalues(const ReducedDrive& drive);

/// Precondition: sound.
TimeScales time_scales(const ReducedDrive& drive);

}  // namespace gearlash::drive
