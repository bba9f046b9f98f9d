// A scan of the line on which engaged faces part: where the next half cycle leads from there.
#pragma once

#include <vector>

#include "closed_form/return_orbits.hpp"

namespace gearlash {

/// An amplitude (rad, along the torque-free line) that engaged faces never part beyond once a
/// motion lasts, whatever happens in the gap:
///   (b/2) √(Y² + P²),   Y = J_M + |κ′| ‖h′‖ + J_M ‖h‖,   P = |κ′| + |J_M − 2ζκ′| ‖h′‖ + |κ′| ‖h‖,
/// with κ′ = F_L J_M − F_M J_L and the impulse response h of 1/(s² + 2ζs + 1), whose norms ∫|h|,
/// ∫|h′| are taken in closed form (for ζ ≥ 1 a bound). Infinite for ζ = 0. Derivation:
/// docs/explanation/servo.md, Bounces. Precondition: two masses.
double largest_lasting_parting(const ServoDynamics& dynamics);

/// A start on the line and what follows.
struct PartingSample {
  double amplitude = 0.0;
  Arrival arrival = Arrival::Zero();  ///< the first one
  double once = 0.0;            ///< |second arrival − first|/|first|; infinite if there is none
  double twice = 0.0;           ///< the same of the third
  bool settles = false;         ///< the faces engage before they cross the gap again
  double next_amplitude = 0.0;  ///< where they part then, on the same line
  std::size_t impacts = 0;      ///< of the next half cycle; 0 if it settles
  bool by_grazing = false;      ///< next to an amplitude at which a face is grazed

  /// Positive where the half cycle grows. Precondition: settles.
  double growth() const { return next_amplitude - amplitude; }
};

struct PartingScan {
  std::vector<PartingSample> samples;  ///< by falling amplitude
  bool reaches_rest = false;  ///< below the last, motion changes by the growth at rest alone
};

/// Fifteen amplitudes a decade, from the largest at which a lasting motion can part (at most 1e4 b)
/// down to that below which motion creeps, or to 1e-4 b. Where half of the events of `budget` are
/// used up, fewer. Between two that nearly come back, but with different numbers of impacts, the
/// amplitude at which a face is grazed is bracketed: the map has an infinite slope there, and
/// cycles crowd.
PartingScan scan_partings(TraversalBudget& budget, double growth_at_rest);

/// Whether two successive arrivals differ by the factor μ₀ alone: the load rests, and the motor
/// creeps at the speed at which the loop balances its friction. No cycle is that small. False if μ₀
/// is 1 to nine digits, because growth at rest then decides nothing.
bool grows_as_at_rest(const ServoDynamics& dynamics, double growth, const Arrival& arrival,
                      const Arrival& next);

}  // namespace gearlash
