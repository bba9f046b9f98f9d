// Describing functions: gain and lag of a nonlinearity for a sine.
#pragma once

#include <complex>
#include <optional>
#include <variant>

namespace gearlash {

// For the input A sin(ωt), A > 0, a nonlinearity has an output y(t) of the same period, and
//   N(A) = (2j/A) · mean of y(t) e^{−jωt} over a period
// is the complex gain of its first harmonic; a lag has Im N < 0. None of those below depends on
// the frequency. In each, h = gap/2 is half the gap.
// Source: Gelb and Vander Velde, Multiple-Input Describing Functions and Nonlinear System Design
// (1968); the inertia-controlled gap is derived in docs/explanation/describing-functions.md.

/// Free play whose output stays constant while the gap is crossed: a load held by friction
/// (Prandtl's play). With cos φ = 2h/A − 1, 0 < φ < π,
///   N = (φ − sin φ e^{jφ})/π,   A > h;   N = 0,   A ≤ h.
struct FrictionControlledBacklash {
  double gap = 0.0;  ///< face to face, not the half; at least 0, in the unit of the input

  bool operator==(const FrictionControlledBacklash&) const = default;
};

/// Free play whose output keeps its speed while the gap is crossed: a load without friction, and
/// plastic contact. It parts where the input is fastest and meets the other face after the angle c:
///   c − sin c = 2h/A,   N = 1 − (c − 2 sin c + sin c cos c)/π − j (1 − cos c)²/π.
/// This holds if the input still slows down at the contact: c ≤ π, A ≥ 2h/π = gap/π. The load then
/// stays on the face until the input is fastest again. (Other motions with a contact converge to
/// this one: 3,999 random starts did.) For smaller A the faces part as they meet, the response may
/// repeat only after several periods, and the gain here is NaN. For A < h the load can also rest in
/// the gap, where N would be 0; the gain here is that of the moving load.
struct InertiaControlledBacklash {
  double gap = 0.0;  ///< face to face, not the half; at least 0, in the unit of the input

  bool operator==(const InertiaControlledBacklash&) const = default;
};

/// y = ±level; switches up as the input rises through half_width, down as it falls through
/// −half_width. With sin ψ = half_width/A, N = 4 level/(πA) e^{−jψ} for A ≥ half_width. For smaller
/// A it does not switch, and N = 0.
struct RelayWithHysteresis {
  double level = 1.0;       ///< positive, in the unit of the output
  double half_width = 0.0;  ///< at least 0, in the unit of the input

  bool operator==(const RelayWithHysteresis&) const = default;
};

/// y = slope · input, held within ±limit. With sin ψ = min(1, limit/(slope · A)),
///   N = slope (2ψ + sin 2ψ)/π.
struct Saturation {
  double limit = 1.0;  ///< positive, in the unit of the output
  double slope = 1.0;  ///< positive

  bool operator==(const Saturation&) const = default;
};

/// Coulomb friction as a function of the speed: y = ±torque with the sign of the input, a speed of
/// amplitude A. N = 4 torque/(πA).
struct CoulombFriction {
  double torque = 1.0;  ///< positive

  bool operator==(const CoulombFriction&) const = default;
};

/// y = 0 within ±half_width; outside, slope times the input's excess over ±half_width. With
/// cos ψ = min(1, half_width/A), N = slope (2ψ − sin 2ψ)/π. (An elastic shaft with free play, not a
/// backlash.)
struct DeadZone {
  double half_width = 1.0;  ///< positive, in the unit of the input
  double slope = 1.0;       ///< positive

  bool operator==(const DeadZone&) const = default;
};

using Nonlinearity = std::variant<FrictionControlledBacklash, InertiaControlledBacklash,
                                  RelayWithHysteresis, Saturation, CoulombFriction, DeadZone>;

/// N(A), to a few epsilons of each part, at the ends too (A → h, A → ∞). NaN only for an
/// inertia-controlled gap with A < gap/π. Precondition: A is positive and finite, and every number
/// within the range stated with it.
std::complex<double> describing_gain(const Nonlinearity& nonlinearity, double amplitude);

/// dN/dA, likewise. For both gaps |dN/dA| = 4h/(πA²), whatever the lag. At A = half_width the
/// relay with hysteresis has an infinite slope.
std::complex<double> describing_gain_slope(const Nonlinearity& nonlinearity, double amplitude);

/// Whether N is complex. Its lag then takes each value in (0, π/2) at exactly one amplitude, and
/// ln|N| is a monotone function of the lag: decreasing for the friction-controlled gap, increasing
/// for the inertia-controlled one and the relay with hysteresis. (For the relay this follows by
/// formula. For the gaps the slope is tan(φ + lag) and cot(c − lag). Their arguments stay in one
/// quadrant and grow with φ and c: checked on 20,000 points, not proved.)
bool has_lag(const Nonlinearity& nonlinearity);

/// A point of the curve N(A).
struct GainPoint {
  double amplitude;
  std::complex<double> gain;
  double log_slope;  ///< d ln|N| / d lag along the curve; monotone along it
};

/// Where the curve N(A) of a nonlinearity with lag meets the ray of a direction in the open fourth
/// quadrant (real part > 0, imaginary part < 0). It stays accurate as A → h, because the gain is
/// not computed from the rounded amplitude. Precondition: has_lag().
GainPoint gain_in_direction(const Nonlinearity& nonlinearity, std::complex<double> direction);

/// The amplitude at which a nonlinearity without lag has this gain, if there is exactly one. Empty
/// for a gain that is not reached, or is constant over a range of amplitudes. Precondition:
/// !has_lag().
std::optional<double> amplitude_of_gain(const Nonlinearity& nonlinearity, double gain);

}  // namespace gearlash
