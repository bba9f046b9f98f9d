// When, and on which face, the gap closes: the first crossing, bracketed.
#pragma once

#include <limits>

#include "closed_form/gap_flight.hpp"

namespace gearlash {

/// A turning point so near a face that rounding decides whether the flight reaches it (grazing).
struct GapTouch {
  double time = std::numeric_limits<double>::infinity();  ///< of the contact, else of turning
  double toward = 0.0;                                    ///< the face, ±1; 0 if there is none
};

struct FirstContact {
  double time;       ///< from the flight's start; infinity if the gap does not close by `horizon`
  double toward;     ///< +1: the forward face, −1: the backward face, 0: no contact
  GapTouch touch{};  ///< the last one, not after `time` and `horizon`
};

/// First time in (0, horizon] at which the flight reaches u = +b/2 or u = −b/2.
///
/// Precondition: |u₀| ≤ b/2, and a flight that starts on a face leaves it (the contact rule of
/// contact_law.hpp ensures that). `horizon` may be infinite.
///
/// Guarantee, in exact arithmetic: no crossing is stepped over, grazing included, and there is no
/// step size. Proof. ü = ü₀ e^{−ct} + G t exp[−Dt, −ct]. Divided by e^{−ct} it is ü₀ + G t
/// φ₁((c−D)t), which is monotone in t. So ü has at most one zero on t > 0, where t φ₁((c−D)t) =
/// −ü₀/G, in closed form. Before and after that zero u̇ is monotone. Each of these at most two
/// intervals holds at most one zero of u̇, present exactly when u̇ changes sign between the ends.
/// Its sign as t → ∞ is that of a closed form too. Between those at most two turning points u is
/// monotone. So each of these at most three intervals reaches a given face at most once, exactly
/// when the face lies between the values of u at the ends; on the last, for certain when u̇ does
/// not die out. A flight that rebounds from a face and is bent back to it is first treated as a
/// bounce. Until ü vanishes (u − u₀)/t is monotone, so it has one zero there, exactly when its sign
/// at the end is not that of u̇₀. u stays below its first tangent, so if |u̇₀| times that zero is
/// less than b the other face was not reached before. Every root is thus bracketed on an interval
/// of monotonicity before it is refined (bracketed_root.hpp). A root beyond the horizon does not
/// count.
///
/// In doubles rounding decides whether a turning point touches a face if the distance is within 32
/// epsilons (7e-15), as a share of b + Σ|terms of u|. `touch` reports such a point, met or not. The
/// terms are those of gap_flight.hpp, with A as c|v_M| + |y₀|/J_M. Where v ≫ u̇ they exceed the
/// height of the turning point as (c + D) v exceeds ü. In 4·10⁵ excursions, with speeds up to 10⁷
/// times u̇, all wrong answers were within 1.4 epsilons of them, at most 5e-13 of the gap
/// (tests/closed_form/grazing_band_test.cpp). Either answer is exact for a servo and a start that
/// differ by so little. As motions they differ by an impact at the speed of grazing, the root of
/// 2|ü| times the distance that rounding decides. A load may come to rest within rounding of the
/// reference. Rounding then also decides on which side, and so which face the motor reaches at
/// last.
///
/// The flight's own u̇₀ counts: a difference of two speeds would lose the digits that they share
/// (ServoState in trajectory.hpp). A flight that starts at a face is measured from that face (u −
/// u₀). So its zero at t = 0 is exact and cannot be confused with a return to the same face,
/// however early.
FirstContact first_contact(const GapFlight& flight, double backlash, double horizon);

}  // namespace gearlash
