// What a drive does when it is asked to be elsewhere.
#pragma once

#include <limits>

#include "general/assemble/drive_system.hpp"

namespace gearlash::drive {

/// Of the load. NaN: does not come about in the time that was watched; to have settled is to be in
/// the band for all of its last fifth.
struct StepResponse {
  double step = 0.0;                                                ///< rad, asked for at time 0
  double until = 0.0;                                               ///< s, watched
  double rise_time = std::numeric_limits<double>::quiet_NaN();      ///< s, first 10 % to first 90 %
  double overshoot = std::numeric_limits<double>::quiet_NaN();      ///< as a share of the step
  double settling_time = std::numeric_limits<double>::quiet_NaN();  ///< s, last time out of `band`
  double band = 0.0;                                                ///< rad, about the reference
  double final_error = 0.0;  ///< rad, reference less load; the middle of its extremes at last
  double ripple = 0.0;       ///< rad, half of their distance
  hybrid::StopReason stop_reason = hybrid::StopReason::reached_end;
};

/// From rest at 0, faces touching as the step presses them, with the drive's other numbers as they
/// are (its own reference is put aside). Extremes at last are those of the last fifth. `band` is
/// 5 % of the step. Times and extremes are found to rounding between 4096 samples and all events:
/// a swing that comes and goes between two of them is not seen. Throws InvalidInput.
StepResponse step_response(const ReducedDrive& drive, double step, double until);

}  // namespace gearlash::drive
