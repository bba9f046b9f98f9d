// A stretch of motion with its derivatives: the flow's, and those of events (saltation).
#pragma once

#include <optional>

#include "hybrid/hybrid_trajectory.hpp"

namespace gearlash::hybrid {

/// Where a passage ends, between two events: on a plane across the motion, or at a time.
struct Finish {
  std::optional<AffineForm> plane;
  double time = 0.0;  ///< without a plane; else about when
};

struct Passage {
  State end;
  double duration = 0.0;
  Matrix slope;           ///< ∂end/∂start, the finish being met whenever it comes
  Vector duration_slope;  ///< ∂duration/∂start
  Matrix slope_at_time;   ///< ∂x/∂start at the fixed time of the end
  std::vector<Event> events;
};

/// From a state at time `from` over so many events to the finish. With f the flow before an event
/// and f⁺ after it, g = c·x its guard and R its reset, a disturbance δ goes over to
///   R δ + (f⁺ − R f)(c·δ)/(c·f)
/// (saltation), and at a tick of a clock to R δ. An event that another one brings about at its own
/// instant is as late as that one: R δ − (f⁺ − R f)τ, τ = −(c·δ)/(c·f) of the first, 0 of a tick.
/// Nothing where the events do not come, another one
/// comes before the finish, or a guard is met at no speed (c·f = 0).
/// Source: Aizerman & Gantmakher 1958; Leine & Nijmeijer, Dynamics and Bifurcations of Non-Smooth
/// Mechanical Systems (2004), ch. 7.
std::optional<Passage> pass(const PreparedSystem& system, const State& start, double from,
                            std::size_t events, const Finish& finish);

}  // namespace gearlash::hybrid
