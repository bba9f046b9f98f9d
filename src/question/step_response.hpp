// The step response of a drive.
#pragma once

#include "gearlash/answer.hpp"
#include "gearlash/progress.hpp"
#include "general/assemble/drive_system.hpp"

namespace gearlash::drive {

/// rad: Specification::step; 1° if it is not given, and 1 rad of a normal form, which has no units.
double step_of(const Drive& drive);
/// rad: Specification::band, as it is chosen there for want of one. `reduced`: the same drive.
double band_of(const Drive& drive, const ReducedDrive& reduced);
/// s, in which a step should settle: twenty swings of the linear loop.
double usual_step_time(const ReducedDrive& drive);

/// Times and extremes are found to rounding between 4096 samples and all events; a swing that
/// begins and ends between two of them is missed. Stopped by Progress, it is that of the motion by
/// then, which has not settled. Throws InvalidInput.
StepResponse step_response(const ReducedDrive& drive, double step, double band, double until,
                           Progress& progress = no_progress());

/// The same, followed for usual_step_time(), and up to 64 times as long while the load is still on
/// its way: a slow integral, say, has yet to take away what is left.
StepResponse step_response_to_end(const ReducedDrive& drive, double step, double band,
                                  Progress& progress);

}  // namespace gearlash::drive
