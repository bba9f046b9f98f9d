// The step response of a drive.
#pragma once

#include <limits>

#include "general/assemble/drive_system.hpp"

namespace gearlash::drive {

/// Measured at the load. NaN: did not occur within the simulated time. Settled means within the
/// band for the whole last fifth of that time.
struct StepResponse {
  double step = 0.0;                                            ///< rad, of the reference at time 0
  double until = 0.0;                                           ///< s, simulated
  double rise_time = std::numeric_limits<double>::quiet_NaN();  ///< s, first 10 % to first 90 %
  double overshoot = std::numeric_limits<double>::quiet_NaN();  ///< as a share of the step
  double settling_time = std::numeric_limits<double>::quiet_NaN();  ///< s, last time outside `band`
  double band = 0.0;                                                ///< rad, about the reference
  double final_error = 0.0;  ///< rad, reference less load, mean of the final extremes
  double ripple = 0.0;       ///< rad, half the distance of the final extremes
  hybrid::StopReason stop_reason = hybrid::StopReason::reached_end;
};

/// A step that shows a drive, and a time in which it should settle.
struct Step {
  double size;   ///< rad: ten backlashes, or 1° without one
  double until;  ///< s: twenty swings of the linear loop
};
Step usual_step(const ReducedDrive& drive);

/// The response from rest at 0, with the faces in contact on the side that the step pushes. The
/// drive's own reference is ignored; its other parameters hold. Final extremes are those of the
/// last fifth. `band` is 5 % of the step. Times and extremes are found to rounding between 4096
/// samples and all events; a swing that begins and ends between two of them is missed. Throws
/// InvalidInput.
StepResponse step_response(const ReducedDrive& drive, double step, double until);

}  // namespace gearlash::drive
