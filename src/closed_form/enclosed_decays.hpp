// Encloses the divided differences of decay_integral.hpp at given exponents.
//
// Only the two power series are bounded by hand; everything else is interval arithmetic. With u =
// 2⁻⁵³ and arguments below 1 (series_limit):
//   exp[0,0,−x] = S₀ − x S₁, both sums positive and by Horner's rule in x⁴, in which a tail is at
//   most 1/360 of the whole: each is off by at most 3.3u of itself. S₀ ≤ 0.5432, x S₁ ≤ 0.1753 and
//   the result is at least e⁻¹, so it is off by (3.3·0.5432 + 4.3·0.1753)u/0.3678 + u < 8u.
//   exp[0,0,−x,−y] = S₀ − S₁ with S₀ ≤ 0.1929 (off by 9u of itself), S₁ ≤ 0.0891 (9.3u) and a
//   result of at least 0.1036: 9·0.1929/0.1036 + 9.3·0.0891/0.1036 + 1 < 26u.
// The remainder after 20 terms is below 10⁻⁴u. The bounds used are 10u and 32u; tests/closed_form
// measures the errors.
#pragma once

#include "base/interval.hpp"
#include "closed_form/decay_integral.hpp"

namespace gearlash::detail {

/// x > 0, known to this many units of 2⁻⁵³ of itself.
inline Interval known_to(double x, double units) {
  return {outward::below(x - units * 0x1p-53 * x), outward::above(x + units * 0x1p-53 * x)};
}

inline BasicDecay<Interval> enclosed_decay(double exponent) {
  if (exponent < series_limit) {
    const Interval double_integral = known_to(single_rate_series(exponent), 10.0);
    const Interval integral = 1.0 - exponent * double_integral;
    return {exponent, 1.0 - exponent * integral, integral, double_integral};
  }
  const Interval factor = exp(-exponent);
  const Interval integral = (1.0 - factor) / exponent;
  return {exponent, factor, integral, (1.0 - integral) / exponent};
}

inline BasicConvolution<Interval> enclosed_convolution(const BasicDecay<Interval>& x,
                                                       const BasicDecay<Interval>& y) {
  const bool is_in_order = x.exponent.low <= y.exponent.low;
  const BasicDecay<Interval>& slow = is_in_order ? x : y;
  const BasicDecay<Interval>& fast = is_in_order ? y : x;
  const double exponent = fast.exponent.low;
  if (exponent < series_limit) {
    const Interval double_integral = known_to(two_rate_series(slow.exponent.low, exponent), 32.0);
    const Interval integral = slow.double_integral - exponent * double_integral;
    return {slow.integral - exponent * integral, integral, double_integral};
  }
  const Interval difference = fast.exponent - slow.exponent;
  // The difference of close exponents is exact (Sterbenz's lemma).
  const Interval value = difference.low > 0.5
                             ? (slow.factor - fast.factor) / difference
                             : slow.factor * enclosed_decay(exponent - slow.exponent.low).integral;
  const Interval integral = (slow.integral - value) / exponent;
  return {value, integral, (slow.double_integral - integral) / exponent};
}

}  // namespace gearlash::detail
