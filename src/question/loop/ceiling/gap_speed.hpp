// How fast the motor moves past the load while rigid faces are apart.
#pragma once

#include "base/interval.hpp"

namespace gearlash {

/// What is known of ü = a + slope · u̇ while |u| ≤ b/2, with |a| ≤ acceleration + per_speed ·
/// sup|u̇|.
struct GapMotion {
  Interval backlash;      ///< b, rad
  Interval restitution;   ///< 0 … 1
  Interval acceleration;  ///< rad/s²
  Interval per_speed;     ///< 1/s, ≥ 0
  Interval slope;         ///< 1/s; negative: friction and feedback brake
};

struct GapSpeed {
  double highest = infinity;  ///< ≥ |u̇| in the end, rad/s; infinite if no bound is known
  bool is_braked = false;     ///< by the second bound
};

/// docs/explanation/ceiling.md, "The gap's speed":
///   w² (1 − e²) ≤ 2 b (acceleration + β w), β = per_speed + max(0, slope), and
///   w ≤ (acceleration + per_speed w)/(−slope).
GapSpeed highest_gap_speed(const GapMotion& motion);

/// The same bound as a line: ≤ at_rest + per_acceleration · acceleration for every acceleration.
/// `likely`, rad/s²: where it is close.
struct GapSpeedLine {
  Interval at_rest;           ///< rad/s
  Interval per_acceleration;  ///< s
  bool is_braked = false;
};
GapSpeedLine gap_speed_line(const GapMotion& motion, double likely);

}  // namespace gearlash
