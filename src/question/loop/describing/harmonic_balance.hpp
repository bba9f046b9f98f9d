// Limit cycles predicted by the describing function: 1 + N(A) G(jω) = 0.
#pragma once

#include <complex>
#include <limits>
#include <vector>

#include "model/normalized_servo.hpp"
#include "numeric/transfer_function.hpp"
#include "question/loop/describing/describing_function.hpp"

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
/// Precondition: 0 < low ≤ high, and a sound nonlinearity and loop.
/// Sources: Gelb and Vander Velde (1968), chapter 3; Loeb, Annales des Télécommunications (1951),
/// for the criterion; Moore, Interval Analysis (1966), for the search.
HarmonicBalance harmonic_balance(const Nonlinearity& nonlinearity, const TransferFunction& loop,
                                 const Bounds& frequencies);

/// From 1e-6 of the least to 1e6 times the greatest modulus of a pole or zero not at the origin;
/// with a delay, to at most 100 turns of its phase (ω delay = 200π), and from at most 1e-6/delay.
/// If G has neither such a root nor a delay, 1e±6 around the frequency at which |G| = 1.
Bounds natural_frequency_range(const TransferFunction& loop);

/// Half the peak-to-peak of the load on a cycle predicted for its gap, whose amplitude is the
/// motor's. It is A − h for a load held by friction. For a coasting load it is A + h, or A sin c +
/// h if the faces meet past the motor's turning point. It stays accurate as A → h. Precondition: a
/// cycle of harmonic_balance() with this nonlinearity.
double load_amplitude(const FrictionControlledBacklash& backlash, const PredictedCycle& cycle);
double load_amplitude(const InertiaControlledBacklash& backlash, const PredictedCycle& cycle);

}  // namespace gearlash
