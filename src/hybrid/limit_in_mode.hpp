// Where a motion ends that never leaves its mode again.
#pragma once

#include <optional>

#include "hybrid/hybrid_system.hpp"

namespace gearlash::hybrid {

/// The limit of x′ = A x + b from a state on, if it has one and no guard of the mode changes its
/// sign on the way, for ever:
///   x(t) = x∞ + Σ (cₖ/λₖ) e^{λₖt} rₖ,   with the velocity Σ cₖ rₖ now and eigenvectors rₖ.
/// A guard is then g∞ + Σ gₖ e^{λₖt}. It keeps its sign, say +, if g∞ > 0 exceeds all terms that
/// may lower it; or if g∞ = 0 and the slowest term, a real one, exceeds all others, which decay
/// faster. Empty if that cannot be seen yet, and for modes with clocks. Computed in floating point.
std::optional<Vector> limit_in_mode(const AffineMode& mode, const Vector& numbers);

}  // namespace gearlash::hybrid
