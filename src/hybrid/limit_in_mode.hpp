// Where a motion ends that never leaves its mode again.
#pragma once

#include <optional>

#include "hybrid/hybrid_system.hpp"

namespace gearlash::hybrid {

/// Where x′ = A x + b goes.
struct LimitInMode {
  Vector numbers;  ///< the limit; of a number that drifts, without its drift
  Vector drift;    ///< the velocity in the end: 0 where a number converges
  /// Whether a guard that does not drift tends to 0: the limit is on the border of the mode.
  bool is_on_border = false;
};

/// The limit of x′ = A x + b from a state on, if no guard of the mode changes its sign on the way,
/// for ever:
///   x(t) = x∞ + d t + Σ (cₖ/λₖ) e^{λₖt} rₖ,   with the velocity d + Σ cₖ rₖ now, A d = 0, and
/// eigenvectors rₖ. A guard is then g∞ + (normal · d) t + Σ gₖ e^{λₖt}. It keeps its sign, say +,
/// if g∞ > 0 exceeds all terms that may lower it, and it does not drift or drifts away; or if
/// g∞ = 0 and the slowest term, a real one, exceeds all others, which decay faster. Empty if that
/// cannot be seen yet, and for modes with clocks. Computed in floating point.
std::optional<LimitInMode> limit_in_mode(const AffineMode& mode, const Vector& numbers);

}  // namespace gearlash::hybrid
