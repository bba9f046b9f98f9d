// Limit cycles predicted by the describing function: 1 + N(A) G(jω) = 0.
#pragma once

#include <complex>
#include <limits>
#include <vector>

#include "analysis/describing/describing_function.hpp"
#include "model/normalized_servo.hpp"
#include "numeric/transfer_function.hpp"

namespace gearlash {

/// A solution of 1 + N(A) G(jω) = 0.
struct PredictedCycle {
  double amplitude = std::numeric_limits<double>::quiet_NaN();  ///< A, of the nonlinearity's input
  double frequency = std::numeric_limits<double>::quiet_NaN();  ///< ω, rad per unit of time
  double period = std::numeric_limits<double>::quiet_NaN();     ///< 2π/ω
  std::complex<double> gain;  ///< N(A), of the amplitude before it is rounded (A → h)
  /// By Loeb's criterion: a greater amplitude decays, Im[(dN/dA)/N · conj((dG/dω)/G)] < 0.
  bool stable = false;
  double residual = std::numeric_limits<double>::quiet_NaN();  ///< |1 + N(A) G(jω)|
};

struct HarmonicBalance {
  std::vector<PredictedCycle> cycles;  ///< by increasing amplitude
  /// Frequencies with possible further solutions: two that merge, or a phase that touches −180° or
  /// stays there, within rounding. Empty if `cycles` has every solution.
  std::vector<Bounds> unresolved;
};

/// All solutions with low ≤ ω ≤ high of the loop of a nonlinearity and G in unity negative
/// feedback, the nonlinearity's input being the error.
///
/// There is no grid, so no solution is skipped between grid points. A nonlinearity without lag
/// requires the phase −π, and N = 1/|G| gives the amplitude. One with lag has exactly one amplitude
/// for every lag in (0, π/2). With the amplitude for lag(ω) = arg(−G) one equation in ω is left,
///   g(ω) = ln|N(lag(ω))| + ln|G(jω)| = 0,
/// and g′ < 0 is Loeb's criterion, because lags fall with the amplitude. Bounds of g and of its
/// slope over a range of ω (response_bounds(); ln|N| and its slope are monotone in the lag) show
/// that the range has no solution, or at most one, which is then bracketed. Otherwise the range is
/// halved, down to 1e-14 of ω. The result is certified within rounding and, for the gaps, if the
/// monotony holds that has_lag() states.
///
/// Excluded: lags within 1e-13 of 0 and π/2 (A beyond about 1e13 h, or 1e10 h for an
/// inertia-controlled gap; A nearer to h than 1e-26 h) and frequencies within 1e-8 of an undamped
/// mode of G (damping below 1e-9). Solutions that fill a range of amplitudes, such as
/// G(jω) = −1/slope with a saturation, are not listed. Where the phase turns fast (a mode of
/// damping below about 1e-5), an epsilon of ω is a large part of the lag; the residual shows it.
///
/// Throws InvalidInput.
/// Sources: Gelb and Vander Velde (1968), chapter 3; Loeb, Annales des Télécommunications (1951),
/// for the criterion; Moore, Interval Analysis (1966), for the search.
HarmonicBalance harmonic_balance(const Nonlinearity& nonlinearity, const TransferFunction& loop,
                                 const Bounds& frequencies);
/// Over natural_frequency_range(loop).
HarmonicBalance harmonic_balance(const Nonlinearity& nonlinearity, const TransferFunction& loop);

/// From 1e-6 of the least to 1e6 times the greatest modulus of a pole or zero not at the origin;
/// with a delay, to at most 100 turns of its phase (ω delay = 200π), and from at most 1e-6/delay.
/// If G has neither such a root nor a delay, 1e±6 around the frequency at which |G| = 1.
Bounds natural_frequency_range(const TransferFunction& loop);

/// The assumed motion of the load while the gap is crossed.
enum class LoadInGap {
  held_by_friction,  ///< it stays (FrictionControlledBacklash)
  coasting           ///< it keeps its speed (InertiaControlledBacklash)
};

/// Half the peak-to-peak of the load on a cycle predicted for it, whose amplitude is the motor's.
/// It is A − h for a load held by friction. For a coasting load it is A + h, or A sin c + h if the
/// faces meet past the motor's turning point. It stays accurate as A → h. Precondition: a cycle of
/// harmonic_balance() with the kind of gap that belongs to `load`.
double load_amplitude(LoadInGap load, const PredictedCycle& cycle, double gap);

/// Times in units of 1/ω_n, angles in rad at the load shaft.
struct DescribedCycle {
  LoadInGap load = LoadInGap::held_by_friction;
  double amplitude = std::numeric_limits<double>::quiet_NaN();  ///< half peak-to-peak of the load
  double motor_amplitude = std::numeric_limits<double>::quiet_NaN();  ///< the motor's amplitude
  double period = std::numeric_limits<double>::quiet_NaN();
  bool stable = false;
  double residual = std::numeric_limits<double>::quiet_NaN();
};

/// The prediction of the classical harmonic balance for the servo, for comparison with the exact
/// answer of analyse_limit_cycles(): first the cycles of a load held by friction, then of a
/// coasting one, each by increasing amplitude.
///
/// Assumed, as in textbooks: the motor drives all the inertia and all the friction at all times, so
/// that θ_M = −G θ_L with G = 1/(s² + 2ζs), and the load is a function of the motor's angle alone,
/// θ_L = N(A) θ_M. Neglected: the lower inertia and damping of the motor while the faces are apart;
/// the torque and the loss of the impact; all harmonics; the true motion of the load in the gap, of
/// which the two cases are the limits for much and no load friction. So the prediction depends on
/// damping and backlash alone. inertia_ratio, friction_ratio and restitution only show which case
/// is the likelier.
///
/// Result: with the load held by friction two cycles for ζ < 0.270504 (the smaller unstable), none
/// above; with a coasting load one stable cycle for every ζ > 0, and none for ζ = 0, where its
/// amplitude is infinite. (K/(s(Ts+1)) with K = T = 1/2ζ: KT = 1/4ζ² ≥ 3.4165809.) The smaller
/// cycle is omitted for ζ < 2e-7, where A is next to h. Throws InvalidInput.
std::vector<DescribedCycle> describing_function_estimate(const NormalizedServo& servo);

}  // namespace gearlash
