// Extreme positions over a part of a trajectory, at exact turning points instead of samples.
#pragma once

#include "base/extent.hpp"
#include "closed_form/trajectory.hpp"

namespace gearlash {

struct Extremes {
  Extent load;
  Extent motor;

  double load_amplitude() const { return 0.5 * load.width(); }
  double motor_amplitude() const { return 0.5 * motor.width(); }
};

/// Extremes over [from, to], clamped to the trajectory, from ≤ to; positions as in at(). Turning
/// points are: engaged, zeros of a damped oscillation, of which the first two after `from` are the
/// largest; in the gap, none of the load and at most two of the motor, because e^{ct} v_M has the
/// slope −y e^{ct}/J_M, where y changes sign at most once. Within a settling phase a shaft may
/// turn. There each bounce counts as a flight while its height is above a double's resolution of
/// the positions, and the common motion counts from there on.
Extremes extremes(const Trajectory& trajectory, double from, double to);

}  // namespace gearlash
