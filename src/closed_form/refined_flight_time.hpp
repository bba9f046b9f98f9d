// The flight time of a balanced half cycle to a double's last bits, even near the boundary of
// hunting.
#pragma once

#include "model/normalized_servo.hpp"

namespace gearlash {

/// The root of ln ρ(t) = 0 next to `approximate`, by Newton's method in thirty-four digits from the
/// servo's own numbers. In doubles ln ρ, a difference of terms of order one, is known to some
/// epsilons. (ln ρ)′ is of the order of ln μ₀, so the root is known to as many over ln μ₀.
/// Precondition: two masses, e = 0, ln μ₀ of order one or less (so that the exponents of the flight
/// are not all tiny); `approximate` is that of balanced_half_cycle().
double refined_flight_time(const NormalizedServo& servo, double approximate);

}  // namespace gearlash
