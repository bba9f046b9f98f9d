// Servos that no contact can keep swinging, whatever its restitution: a proof by energy.
#pragma once

#include "closed_form/cycle_bounds.hpp"
#include "model/normalized_servo.hpp"

namespace gearlash {

/// Whether the rest of the servo only ever takes energy from the gap,
///   1/c + 1/D ≤ 2ζ,  that is  f + (1 − f) r ≤ 4ζ² f (1 − f)(1 + r),  r = J_L/J_M, f = F_L/(F_M +
///   F_L).
/// Then it cannot hunt: with rigid faces and any restitution from 0 to 1 every motion tends to the
/// reference. Sufficient, not necessary. Seen from the gap the rest of the servo is linear, N =
/// H(s) u for the mesh torque N, and Im H(jω) < 0 for all ω > 0 just when this holds; a contact
/// absorbs ∫N u̇ dt ≥ 0 (theorem and proof: docs/mathematics.md, Absence by energy). The polynomial
/// is decided exactly, in rational numbers, of the doubles themselves or of the decimals that they
/// stand for. Precondition: validate(servo) is empty, and the
/// reading is exact or decimal: converted numbers make a box.
bool is_dissipative(const NormalizedServo& servo, Reading reading = Reading::exact);

/// Whether that holds of every servo of the box; not where rounding leaves it open.
bool is_dissipative(const ServoBox& box);

}  // namespace gearlash
