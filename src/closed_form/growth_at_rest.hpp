// How much a disturbance that is small against the backlash grows over one half cycle.
#pragma once

#include "closed_form/servo_dynamics.hpp"

namespace gearlash {

/// μ₀, the slope at zero of the return map: ≥ 0, infinite when one shaft has no friction.
///
/// When the motion is small against the gap, the load comes to rest in it, at y∞ say, and the
/// motor creeps up at −y∞/F_M; after the contact (and its bounces) the faces part again and the
/// load comes to rest at y∞′. The dynamics being linear in the state, μ₀ = |y∞′/y∞| depends on the
/// servo alone. Plastic contact, in closed form:
///   ζ < 1:  μ₀² = (c²−2ζc+1)(D²−2ζD+1)/(cD)² · e^{−2ζt₁},
///           w t₁ = atan2(w (J_M D + J_L c), w² − (c−ζ)(D−ζ)),  w = √(1−ζ²);
///   ζ ≥ 1:  μ₀ = −p₁ (p₁/p₂)^{λ₁/(λ₂−λ₁)},  pᵢ = (1 − λᵢ/c)(1 − λᵢ/D),
///           λ₁,₂ = ζ ∓ √(ζ²−1) the rates of the engaged motion's two decays;
/// which is unchanged when c and D change places, that is under (friction_ratio, inertia_ratio) →
/// (1 − friction_ratio, 1/inertia_ratio). μ₀ is 0 when the faces never part again: for ζ ≥ 1 unless
/// λ₁ lies between c and D. With 0 < e ≤ 1 the bounces are followed by the simulator
/// (bounces do not reach the far face: the motion is small against the gap).
/// NaN when e is so close to 1 that more than 200,000 bounces would have to be followed, and for
/// zero damping with plastic contact infinity. Source: DESIGN 3.4; proofs in docs/mathematics.md.
double growth_at_rest(const ServoDynamics& dynamics);

}  // namespace gearlash
