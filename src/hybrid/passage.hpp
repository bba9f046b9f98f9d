// A segment of motion with its derivatives, across events too (saltation).
#pragma once

#include <cstddef>
#include <optional>

#include "hybrid/disturbances.hpp"
#include "hybrid/hybrid_trajectory.hpp"

namespace gearlash::hybrid {

/// A shot that takes more steps, as at a stiff drive's slow slide, has no passage.
inline constexpr std::size_t most_steps_of_a_shot = 300'000;

/// The state after a time: x + ∫₀ᵗ exp(As) ds (A x + b). The time may be negative.
Vector flown(const AffineFlow& flow, const Vector& numbers, double time);

/// The end of a passage, between two events: on a plane across the motion, or at a time.
struct Finish {
  std::optional<AffineForm> plane;
  double time = 0.0;  ///< without a plane; else approximately
};

struct Passage {
  State end;
  double duration = 0.0;
  Matrix slope;           ///< ∂end/∂start, with a free time of the end
  Vector duration_slope;  ///< ∂duration/∂start
  Matrix slope_at_time;   ///< ∂x/∂start at the fixed time of the end
  std::vector<Event> events;
};

/// The passage from a state at time `from` over a number of events to the finish, with slopes as
/// Disturbances gives them. Empty if the events do not come, if another one comes before the
/// finish, or if a guard is met at no speed.
std::optional<Passage> pass(const PreparedSystem& system, const State& start, double from,
                            std::size_t events, const Finish& finish);

}  // namespace gearlash::hybrid
