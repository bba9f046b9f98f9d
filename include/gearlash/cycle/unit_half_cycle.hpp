// Half a cycle with plastic contact, and the scalar equation that makes it a limit cycle.
#pragma once

#include <optional>

#include "gearlash/motion/gap_flight.hpp"
#include "gearlash/motion/servo_dynamics.hpp"

namespace gearlash {

/// Half a cycle that starts with the faces parting forward at unit amplitude on the torque-free
/// line, as a function of the flight time t: everything scales with the amplitude (design 3.1).
struct UnitHalfCycle {
  double flight_time;       ///< t₂
  double engaged_time;      ///< t₁, infinite when the faces do not part again
  double load_moved;        ///< y at impact less y at parting
  double load_position;     ///< y at impact
  double load_speed;        ///< v_L just before impact
  double gap_displacement;  ///< u − u₀ at impact, < 0
  double gap_speed;         ///< u̇ just before impact, ≤ 0
  double gap_acceleration;  ///< ü just before impact
  double common_speed;      ///< P = J_M v_M + J_L v_L, the speed just after impact
  double square_change;     ///< (y² + P²) just after impact less (y² + v²) at parting
  double form;              ///< Q(y, P) = y² + 2ζyP + P² just after impact
  double log_growth;  ///< ln ρ, ρ the amplitude at the next parting; −∞ when there is none
  double log_growth_slope;  ///< d ln ρ/dt₂ = |u̇| (J_M y + F_M P)/(y² + 2ζyP + P²), > 0
};

/// The flight of a unit half cycle, whose gap is measured from the face it leaves.
GapFlight unit_flight(const ServoDynamics& dynamics);

/// ln ρ = ½ ln(Q(y, P)/Q(line)) − ζ t₁ with Q(y, v) = y² + 2ζyv + v², which decays as e^{−2ζt}
/// along the engaged flow for every ζ. Proof that it increases with t₂: docs/mathematics.md.
/// Precondition: plastic contact, flight_time > 0.
UnitHalfCycle unit_half_cycle(const ServoDynamics& dynamics, double flight_time);

/// The half cycle that ends as it began, mirrored: the root t₂ of ln ρ(t₂) = 0, which exists
/// exactly when growth at rest > 1 and is unique. Nothing only where ln ρ cannot be told from zero
/// (growth at rest 1 + rounding). Precondition: plastic contact, ζ > 0, growth_at_rest =
/// growth_at_rest(dynamics) > 1.
std::optional<UnitHalfCycle> balanced_half_cycle(const ServoDynamics& dynamics,
                                                 double growth_at_rest);

}  // namespace gearlash
