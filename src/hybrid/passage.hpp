// A stretch of motion with its derivatives: the flow's, and those of events (saltation).
#pragma once

#include <optional>

#include "gearlash/hybrid/hybrid_trajectory.hpp"

namespace gearlash::hybrid {

/// From a state to just after the last of some events.
struct Passage {
  State end;
  double duration = 0.0;
  Matrix slope;           ///< ∂end/∂start, the last event being met whenever it comes
  Vector duration_slope;  ///< ∂duration/∂start
  Matrix slope_at_time;   ///< ∂x/∂start at the fixed time just after the last event
  std::vector<Event> events;
};

/// Runs so many events from a state at time `from`, at most until `until`. With f the flow before
/// an event and f⁺ after it, g = c·x its guard and R its reset, a disturbance δ goes over to
///   R δ − R f (c·δ)/(c·f)                       where the event is met,
///   R δ + (f⁺ − R f)(c·δ)/(c·f)                 at a fixed time (saltation),
/// and at a tick of a clock to R δ. Nothing where the events do not come, or a guard is met at no
/// speed (c·f = 0).
/// Source: Aizerman & Gantmakher 1958; Leine & Nijmeijer, Dynamics and Bifurcations of Non-Smooth
/// Mechanical Systems (2004), ch. 7.
std::optional<Passage> pass(const HybridSystem& system, const State& start, double from,
                            double until, std::size_t events);

}  // namespace gearlash::hybrid
