// The linear part of a loop: its frequency response, and bounds of it over whole ranges.
#pragma once

#include <complex>
#include <vector>

#include "gearlash/bounds.hpp"
#include "gearlash/fault.hpp"

namespace gearlash {

/// G(s) = numerator(s)/denominator(s) · e^{−s delay}. Coefficients by descending powers of s, the
/// constant last: {1, 3, 0} is s² + 3s. Leading zeros are permitted and skipped.
struct TransferFunction {
  std::vector<double> numerator;
  std::vector<double> denominator;
  double delay = 0.0;  ///< at least 0, in the unit of time that s belongs to

  bool operator==(const TransferFunction&) const = default;
};

/// Faults: coefficients that are not finite, polynomials whose coefficients are all 0, a delay that
/// is negative or not finite.
std::vector<Fault> faults(const TransferFunction& transfer);

/// G(jω) and d ln G(jω)/dω, whose parts are the slopes of ln|G| and of the phase.
struct FrequencyResponse {
  std::complex<double> value;
  std::complex<double> log_slope;
};
/// By Horner's rule. Precondition: a sound transfer function, ω > 0.
FrequencyResponse frequency_response(const TransferFunction& transfer, double frequency);

/// G(s) = gain · Π(s − zero)/Π(s − pole) · e^{−s delay}.
struct FactoredTransferFunction {
  double gain = 1.0;
  std::vector<std::complex<double>> zeros;
  std::vector<std::complex<double>> poles;
  double delay = 0.0;
};
/// The roots are eigenvalues of balanced companion matrices. A real part below 1e-9 of a root
/// counts as 0, an undamped mode, because rounding of the coefficients may have put it there.
/// Throws InvalidInput.
FactoredTransferFunction factored(const TransferFunction& transfer);

/// Ranges of ln|G|, the phase and their slopes by frequency for low ≤ ω ≤ high. The phase is the
/// sum of those of the factors. Each is continuous in ω, except for factors with roots on the
/// imaginary axis, where it jumps. For Re root < 0 it goes from −π/2 … π/2 upwards, for Re root > 0
/// from 3π/2 … π/2 downwards. So it is not reduced to one turn.
struct ResponseBounds {
  Bounds log_gain;
  Bounds phase;
  Bounds log_gain_slope;
  Bounds phase_slope;
};
/// Each factor jω − root is bounded exactly. The sums tighten in proportion to the width of the
/// range. The bounds hold except for the rounding of the sums. Precondition: 0 < low ≤ high.
ResponseBounds response_bounds(const FactoredTransferFunction& transfer, double low, double high);

}  // namespace gearlash
