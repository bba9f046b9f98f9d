// Growth, over half a cycle, of a motion that is small against the backlash.
#pragma once

#include "closed_form/servo_dynamics.hpp"

namespace gearlash {

/// μ₀, the slope at zero of the return map: ≥ 0, infinite when one shaft has no friction.
///
/// If the motion is small against the gap, the load comes to rest in it, at y∞ say, and the motor
/// creeps at −y∞/F_M. After the contact (and its bounces) the faces part again and the load comes
/// to rest at y∞′. The dynamics are linear in the state, so μ₀ = |y∞′/y∞| depends on the servo
/// alone. Plastic contact, in closed form:
///   ζ < 1:  μ₀² = (c²−2ζc+1)(D²−2ζD+1)/(cD)² · e^{−2ζt₁},
///           w t₁ = atan2(w (J_M D + J_L c), w² − (c−ζ)(D−ζ)),  w = √(1−ζ²);
///   ζ ≥ 1:  μ₀ = −p₁ (p₁/p₂)^{λ₁/(λ₂−λ₁)},  pᵢ = (1 − λᵢ/c)(1 − λᵢ/D),
///           λ₁,₂ = ζ ∓ √(ζ²−1) the rates of the engaged motion's two decays;
/// It is unchanged when c and D change places, that is under (friction_ratio, inertia_ratio) → (1 −
/// friction_ratio, 1/inertia_ratio). μ₀ is 0 if the faces never part again: for ζ ≥ 1 unless λ₁
/// lies between c and D. With 0 < e ≤ 1 the simulator follows the bounces (which do not reach the
/// far face, because the motion is small against the gap). NaN if e is so close to 1 that more than
/// 200,000 bounces would have to be followed. Infinity for zero damping with plastic contact.
/// Proofs: docs/explanation/servo.md.
double growth_at_rest(const ServoDynamics& dynamics);

}  // namespace gearlash
