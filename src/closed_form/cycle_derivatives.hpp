// Exact derivatives of the limit cycle and of the growth at rest by the normalised numbers.
#pragma once

#include <limits>

#include "model/normalized_servo.hpp"

namespace gearlash {

/// Partial derivatives by the numbers of a NormalizedServo. NaN if there is none.
struct ServoGradient {
  double damping = std::numeric_limits<double>::quiet_NaN();        ///< by ζ
  double inertia_ratio = std::numeric_limits<double>::quiet_NaN();  ///< by r = J_L/J_M; 0 at r = ∞
  double load_share = std::numeric_limits<double>::quiet_NaN();     ///< by r/(1 + r), of inertia
  double friction_ratio = std::numeric_limits<double>::quiet_NaN();  ///< by F_L/(F_M+F_L)
  double backlash = std::numeric_limits<double>::quiet_NaN();        ///< by b, rad
  double restitution = std::numeric_limits<double>::quiet_NaN();     ///< by e, from above at e = 0
};

struct SensitiveValue {
  double value = std::numeric_limits<double>::quiet_NaN();
  ServoGradient slope;
};

enum class SensitivityOutcome {
  available,  ///< all is set
  no_cycle,   ///< no stable limit cycle (or no backlash); only the growth at rest is set
  undecided,  ///< on the boundary of hunting to within rounding, or too many bounces; only the
              ///< growth at rest is set
  undamped,   ///< ζ = 0: no cycle, and growth at rest is infinite; nothing is set
  bounces     ///< a cycle with bounces could not be repeated; only the growth at rest is set
};

/// Times in units of 1/ω_n, angles in rad at the load's shaft.
struct CycleSensitivity {
  SensitivityOutcome outcome = SensitivityOutcome::no_cycle;
  SensitiveValue growth_at_rest;  ///< μ₀; no derivatives (NaN) where it is infinite
  SensitiveValue amplitude;       ///< amplitude of the cycle seen in practice, largest_stable()
  SensitiveValue period;
  SensitiveValue multiplier;

  bool available() const { return outcome == SensitivityOutcome::available; }
};

/// Growth at rest and the cycle with their exact derivatives. Values are those of
/// analyse_limit_cycles(). Method: forward automatic differentiation (Griewank & Walther,
/// Evaluating Derivatives, 2008, ch. 3 and 15) with divided differences that keep their digits
/// where rates meet (decay_slopes.hpp).
///
/// e = 0. ln ρ(t₂; p) = 0 defines the flight time t₂(p) (unit_half_cycle.hpp), hence
///   dt₂/dp = −(∂ ln ρ/∂p)/(∂ ln ρ/∂t₂),
/// and everything else is a closed form of t₂ and p. Where ln μ₀ < 1, t₂ is refined in thirty-four
/// digits: it grows as ln(1/ln μ₀) towards the boundary of hunting and its derivatives as 1/ln μ₀.
/// For a given t₂ they are well-conditioned. Error, of max(|derivative|, |value/p|): 512 epsilons
/// for ζ ≥ 0.01, eight times that for μ₀ − 1 from 0.1 down to 1e-10, and for ζ down to 1e-6
/// (tests/closed_form, against many digits). A refinement takes about 30 µs.
///   The derivatives by e are 0 from above: bounces end after a time of order e, and the faces then
/// engage in the state of the engaged motion, to third order in e (docs/explanation/motions.md,
/// Settling). Over whole bounces ∫u̇ dt = 0, so only the distance of height ½e²u̇²/a over a time
/// 2e|u̇|/a acts. Amplitude, period, multiplier and growth at rest thus change as e³.
///
/// e > 0. The cycle is repeated event by event, with derivatives by p and by its starting arrival x
/// (return_map.hpp). The condition that ends a phase determines each event's time. With F(x, p) the
/// arrival that closes the period, dx/dp = (I − ∂F/∂x)⁻¹ ∂F/∂p. The same numbers carry disturbances
/// along, which gives M = ∂F/∂x with its derivatives. Those of a multiplier λ, an eigenvalue of M,
/// are l dM r/(l r) with its eigenvectors, and NaN if λ is double. All hold while no event grazes.
/// Where a bounce comes or goes, they are those of the present sequence. Error, of
/// max(|derivative|, |value/p|): about 1e-12, ten times that if the cycle hardly resists
/// disturbances (1 − |λ| below 0.01) or an event nearly grazes (tests/closed_form, against many
/// digits). This includes settling bounces: what their sum leaves out is below rounding. Where e >
/// 0.999 and too many bounces are left out, fading_rattle() gives the error. The cost is that of
/// analyse_limit_cycles().
///
/// A massless side, with which contact is plastic: the limits of the derivatives of light sides, by
/// Lagrange's polynomial through J/F = τ, 2τ, … 6τ, τ = 1e-3 min(1, ln μ₀)/(1 + 2ζ). Everything is
/// analytic in J/F except for terms like e^{−t/τ}. Error, of max(|derivative|, |value|): 1e-11; by
/// load_share, of max(|derivative|, |value|/F) with that side's F: 1e-9 (tests/closed_form, against
/// many digits), more next to the boundary of hunting.
///
/// An amplitude is half the difference of two extremes of the load. Where two of a kind tie, the
/// derivative is that of one side. Throws InvalidInput.
CycleSensitivity cycle_sensitivity(const NormalizedServo& servo);

/// Growth at rest alone, which takes no search for cycles. NaN if ζ = 0. Throws InvalidInput.
SensitiveValue growth_sensitivity(const NormalizedServo& servo);

}  // namespace gearlash
