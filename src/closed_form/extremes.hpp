// The largest and smallest positions over a stretch of a trajectory, at turning points found
// exactly, not at samples.
#pragma once

#include "closed_form/trajectory.hpp"

namespace gearlash {

struct Extremes {
  double load_lowest;
  double load_highest;
  double motor_lowest;
  double motor_highest;

  double load_size() const { return 0.5 * (load_highest - load_lowest); }     ///< half peak-to-peak
  double motor_size() const { return 0.5 * (motor_highest - motor_lowest); }  ///< half peak-to-peak
};

/// Extremes over [from, to], clamped to the trajectory, from ≤ to; positions as in at(). Turning
/// points: engaged, zeros of a damped oscillation, of which the first two after `from` are the
/// largest; in the gap the load has none and the motor at most two, e^{ct} v_M having the slope
/// −y e^{ct}/J_M, where y changes sign at most once. Within a settling phase, in which a shaft may
/// well turn, each bounce counts as a flight, for as long as its height is above a double's
/// resolution of the positions, and the common motion from there on.
Extremes extremes(const Trajectory& trajectory, double from, double to);

}  // namespace gearlash
