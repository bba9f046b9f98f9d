// Half a cycle with plastic contact, and the scalar equation that closes it.
#pragma once

#include <optional>

#include "closed_form/gap_flight.hpp"
#include "closed_form/half_cycle_algebra.hpp"
#include "closed_form/servo_dynamics.hpp"

namespace gearlash {

/// The flight of a unit half cycle, whose gap is measured from the face it leaves.
GapFlight unit_flight(const ServoDynamics& dynamics);

/// ln ρ = ½ ln(Q(y, P)/Q(line)) − ζ t₁ with Q(y, v) = y² + 2ζyv + v², which decays as e^{−2ζt}
/// along the engaged flow for every ζ. Proof that it increases with t₂:
/// docs/explanation/servo.md. Precondition: plastic contact, flight_time > 0.
UnitHalfCycle unit_half_cycle(const ServoDynamics& dynamics, double flight_time);

/// The half cycle that ends as it began, mirrored: the root t₂ of ln ρ(t₂) = 0. It exists exactly
/// when growth at rest > 1 and is unique. Empty only if ln ρ cannot be distinguished from zero
/// (growth at rest 1 + rounding). Precondition: plastic contact, ζ > 0, growth_at_rest =
/// growth_at_rest(dynamics) > 1.
std::optional<UnitHalfCycle> balanced_half_cycle(const ServoDynamics& dynamics,
                                                 double growth_at_rest);

}  // namespace gearlash
