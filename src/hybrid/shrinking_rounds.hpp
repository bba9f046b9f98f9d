// Where a motion ends that goes the same round of events again and again, ever smaller.
#pragma once

#include <optional>

#include "hybrid/hybrid_trajectory.hpp"

namespace gearlash::hybrid {

/// What rounds shrink to.
struct RoundsLimit {
  Vector numbers;  ///< the limit
  Vector off;      ///< by how much each number was off it, at most, in the last round
};

/// The limit x* of a motion whose last events are rounds, the same transitions in the same order.
///
/// Let x* be an equilibrium of every mode of the round, left alone by every reset; let the guards
/// that fire, and forms that choose between alternatives, be 0 there; and let all other guards of
/// these modes be farther from 0 than the motion can bring them. Beside x* the system is then
/// homogeneous: from x* + λd it moves as from x* + d, λ times as far from x*, in the same times. So
/// if rounds lead from x* + d to x* + λd, 0 < λ < 1, the next ones lead to x* + λ²d, and all that
/// follow to x*.
///
/// All of this is tested, with x* extrapolated from three states, n rounds apart, over which each
/// number shrinks by the one ratio λ ≤ `ratio`: to the share `tolerance` of what is left of the
/// motion, and rounding. Between events the motion is sampled. Empty where something fails, for
/// fewer than eight rounds, and for rounds with ticks, readings of instruments or infinitely many
/// firings. Precondition: a motion of `system`.
std::optional<RoundsLimit> shrinking_rounds(const HybridSystem& system, const Trajectory& motion,
                                            double ratio, double tolerance);

}  // namespace gearlash::hybrid
