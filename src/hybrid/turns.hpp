// Where a form turns between the events of a motion: its extremes.
#pragma once

#include <functional>

#include "hybrid/hybrid_trajectory.hpp"

namespace gearlash::hybrid {

enum class OtherEvents { kept, left_out };

/// The system with events where a form, one for each mode, changes its sign.
HybridSystem with_turns(
    const HybridSystem& system,
    const std::function<AffineForm(std::size_t index, const AffineMode& mode)>& form_in,
    OtherEvents others);

/// With one form for all modes.
HybridSystem with_turns(const HybridSystem& system, const AffineForm& form, OtherEvents others);

/// How fast a form changes along a flow.
AffineForm rate_of(const AffineForm& form, const AffineFlow& flow);

/// Calls visit(time, mode, numbers) at start, end, events and every turn between them, in order,
/// where is_watched(mode). `turns`: the motion's system with_turns(), other events left out.
template <class IsWatched, class Visit>
void for_each_turn(const Trajectory& motion, const PreparedSystem& turns,
                   const IsWatched& is_watched, const Visit& visit) {
  for_each_stretch(motion, [&](const State& start, double from, double to, const Vector& end) {
    if (!is_watched(start.mode)) return;
    visit(from, start.mode, start.numbers);
    if (to > from) {
      const Trajectory stretch = simulate(turns, start, {.until = to - from});
      for (const Event& event : stretch.events()) {
        visit(from + event.time, start.mode, event.before);
      }
    }
    visit(to, start.mode, end);
  });
}

}  // namespace gearlash::hybrid
