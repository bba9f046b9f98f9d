// Extreme positions over a part of a trajectory, at exact turning points instead of samples.
#pragma once

#include "closed_form/trajectory.hpp"

namespace gearlash {

struct Extremes {
  double load_lowest;
  double load_highest;
  double motor_lowest;
  double motor_highest;

  double load_amplitude() const {
    return 0.5 * (load_highest - load_lowest);
  }  ///< half peak-to-peak
  double motor_amplitude() const {
    return 0.5 * (motor_highest - motor_lowest);
  }  ///< half peak-to-peak
};

/// Extremes over [from, to], clamped to the trajectory, from ≤ to; positions as in at(). Turning
/// points are: engaged, zeros of a damped oscillation, of which the first two after `from` are the
/// largest; in the gap, none of the load and at most two of the motor, because e^{ct} v_M has the
/// slope −y e^{ct}/J_M, where y changes sign at most once. Within a settling phase a shaft may
/// turn. There each bounce counts as a flight while its height is above a double's resolution of
/// the positions, and the common motion counts from there on.
Extremes extremes(const Trajectory& trajectory, double from, double to);

}  // namespace gearlash
