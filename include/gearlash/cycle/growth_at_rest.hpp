// How much a disturbance that is small against the backlash grows over one half cycle.
#pragma once

#include "gearlash/motion/servo_dynamics.hpp"

namespace gearlash {

/// μ₀, the slope at zero of the return map: ≥ 0, infinite when one shaft has no friction.
///
/// When the motion is small against the gap, the load comes to rest in it, at y∞ say, and the
/// motor creeps up at −y∞/F_M; after the contact (and its bounces) the faces part again and the
/// load comes to rest at y∞′. The dynamics being linear in the state, μ₀ = |y∞′/y∞| depends on the
/// servo alone. Plastic contact, with λ = ζ + i√(1−ζ²) (ζ < 1), in closed form:
///   μ₀² = (c²−2ζc+1)(D²−2ζD+1)/(cD)² · e^{−2ζt₁},
///   √(1−ζ²) t₁ = arg(cλ̄−1) + arg(Dλ̄−1) + 2 arg λ − π  (mod 2π),
/// which is unchanged when c and D change places, that is under (friction_ratio, inertia_ratio) →
/// (1 − friction_ratio, 1/inertia_ratio). μ₀ is 0 when the faces never part again, as for
/// λ₁ ≤ D ≤ λ₂ in an overdamped servo. With 0 < e ≤ 1 the bounces are followed by the simulator
/// (bounces do not reach the far face: the motion is small against the gap).
/// NaN when e is so close to 1 that more than 200,000 bounces would have to be followed, and for
/// zero damping with plastic contact infinity. Source: DESIGN 3.4; proofs in docs/mathematics.md.
double growth_at_rest(const ServoDynamics& dynamics);

}  // namespace gearlash
