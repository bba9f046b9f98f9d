// Proves by energy that no contact, whatever its restitution, can sustain oscillation.
#pragma once

#include "closed_form/cycle_bounds.hpp"
#include "model/normalized_servo.hpp"

namespace gearlash {

/// Whether the rest of the servo only ever takes energy from the gap,
///   1/c + 1/D ≤ 2ζ,  that is  f + (1 − f) r ≤ 4ζ² f (1 − f)(1 + r),  r = J_L/J_M, f = F_L/(F_M +
///   F_L).
/// Then it cannot hunt: with rigid faces and any restitution from 0 to 1 every motion tends to the
/// reference. The condition is sufficient, not necessary. Seen from the gap the rest of the servo
/// is linear, N = H(s) u for the mesh torque N, and Im H(jω) < 0 for all ω > 0 exactly when the
/// condition holds. A contact absorbs ∫N u̇ dt ≥ 0 (theorem and proof:
/// docs/explanation/absence-by-energy.md). The polynomial is decided exactly, in
/// rational numbers, for the doubles themselves or for the decimals that they represent.
/// Precondition: faults(servo) is empty, and the reading is exact or decimal: converted numbers
/// make a box.
bool is_dissipative(const NormalizedServo& servo, Reading reading = Reading::exact);

/// Whether this holds for every servo of the box; false where rounding leaves it open.
bool is_dissipative(const ServoBox& box);

}  // namespace gearlash
