// The step response of a drive.
#pragma once

#include "gearlash/answer.hpp"
#include "gearlash/progress.hpp"
#include "general/assemble/drive_system.hpp"

namespace gearlash::drive {

/// A step that shows a drive, and a time in which it should settle.
struct Step {
  double size;   ///< rad: usual_step_size()
  double until;  ///< s: twenty swings of the linear loop
};
double usual_step_size(double backlash);  ///< rad: ten backlashes, or 1° without one
Step usual_step(const ReducedDrive& drive);

/// Times and extremes are found to rounding between 4096 samples and all events; a swing that
/// begins and ends between two of them is missed. Stopped by Progress, it is that of the motion by
/// then, which has not settled. Throws InvalidInput.
StepResponse step_response(const ReducedDrive& drive, double step, double until,
                           Progress& progress = no_progress());

}  // namespace gearlash::drive
