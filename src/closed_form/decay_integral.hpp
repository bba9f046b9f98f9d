// φ-functions of decaying exponentials in one and two rates, accurate where rates coincide or
// vanish.
//
// Every closed form of the gap is a sum of these. They are divided differences of exp at the
// points 0, −x and −y, where x and y are rate times time:
//   exp[0, −x]        = ∫₀¹ e^{−xs} ds                (φ₁(−x))
//   exp[0, 0, −x]     = ∫₀¹ (1−s) e^{−xs} ds          (φ₂(−x))
//   exp[−x, −y]       = ∫₀¹ e^{−xs} e^{−y(1−s)} ds
//   exp[0, −x, −y], exp[0, 0, −x, −y]                 its integral and double integral
// For small arguments the last of each row is a power series and the others follow downwards,
//   exp[−x] = 1 − x exp[0, −x],  exp[0, −x] = 1 − x exp[0, 0, −x], and so on,
// without loss of digits. For large ones the same equations are solved upwards. Permitted: x, y ≥ 0
// and finite. All are positive and decreasing. Relative error: at most 16 epsilons over the whole
// quadrant (tests/closed_form, against many digits). Source: divided differences of the
// exponential, McCurdy, Ng & Parlett, Math. Comp. 43 (1984).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

namespace gearlash {

namespace detail {

inline constexpr auto inverse_factorials = [] {
  std::array<double, 32> table{};
  long double value = 1.0L;
  for (std::size_t k = 0; k < table.size(); ++k) {
    if (k > 0) value /= static_cast<long double>(k);
    table[k] = static_cast<double>(value);
  }
  return table;
}();

/// Below this argument the power series loses fewer digits than the difference quotient. This many
/// terms reach a double's last bit there.
inline constexpr double series_limit = 1.0;
inline constexpr std::size_t series_terms = 20;
/// Up to here the same terms of the series of two rates lose 10 epsilons; the quotient would lose
/// 31 next to (1, 1), where it divides differences of differences.
inline constexpr double two_rate_series_limit = 1.7;
/// Short bounces have small arguments, and their series fewer terms. What these leave out is below
/// 4e-18 of the sum: x¹²/14! and 13 x¹²/15! at 1/4, x⁸/10! and 9 x⁸/11! at 1/32.
inline constexpr double small_argument = 0.25;
inline constexpr std::size_t small_argument_terms = 12;
inline constexpr double tiny_argument = 1.0 / 32.0;
inline constexpr std::size_t tiny_argument_terms = 8;

/// Two neighbouring terms of a series, computed side by side (an extension of gcc and clang, which
/// do not find this by themselves).
using Pair [[gnu::vector_size(2 * sizeof(double))]] = double;

inline Pair inverse_factorial_pair(std::size_t k) {
  return Pair{inverse_factorials[k], inverse_factorials[k + 1]};
}

/// exp[0, 0, −x] = Σ_k (−x)^k / (k + 2)!: four interleaved sums in x⁴.
template <std::size_t terms = series_terms>
double single_rate_series(double x) {
  const double square = x * x;
  const double fourth = square * square;
  Pair low{};
  Pair high{};
  for (std::size_t k = terms; k > 0; k -= 4) {
    low = inverse_factorial_pair(k - 2) + fourth * low;
    high = inverse_factorial_pair(k) + fourth * high;
  }
  const Pair sum = low + square * high;
  return sum[0] - x * sum[1];
}

/// exp[0, 0, −x, −y] = Σ_k (−1)^k h_k(x, y) / (k + 3)!, h_k the complete symmetric polynomial: four
/// interleaved sums with h_{k+4} = y⁴ h_k + x^{k+1} h_3.
template <std::size_t terms = series_terms>
double two_rate_series(double x, double y) {
  const double x2 = x * x;
  const double y2 = y * y;
  const double x4 = x2 * x2;
  const double y4 = y2 * y2;
  const double h3 = (x + y) * (x2 + y2);
  Pair low = {1.0, x + y};  // h_k
  Pair high = {x2 + y * (x + y), h3};
  Pair low_step = {h3 * x, h3 * x2};  // x^{k+1} h_3
  Pair high_step = low_step * x2;
  Pair sum{};
  for (std::size_t k = 0; k < terms; k += 4) {
    sum += low * inverse_factorial_pair(k + 3) + high * inverse_factorial_pair(k + 5);
    low = low_step + y4 * low;
    high = high_step + y4 * high;
    low_step *= x4;
    high_step *= x4;
  }
  return sum[0] - sum[1];
}

/// The series with as many terms as its argument, x < 1, needs.
inline double short_single_rate_series(double x) {
  if (x < tiny_argument) return single_rate_series<tiny_argument_terms>(x);
  if (x < small_argument) return single_rate_series<small_argument_terms>(x);
  return single_rate_series(x);
}

/// Likewise; y is the larger argument.
inline double short_two_rate_series(double x, double y) {
  if (y < tiny_argument) return two_rate_series<tiny_argument_terms>(x, y);
  if (y < small_argument) return two_rate_series<small_argument_terms>(x, y);
  return two_rate_series(x, y);
}

}  // namespace detail

/// One exponential decay with its integrals, from at most one call of the library's exponential.
template <class Real>
struct BasicDecay {
  Real exponent;         ///< x ≥ 0
  Real factor;           ///< e^{−x}
  Real integral;         ///< exp[0, −x]
  Real double_integral;  ///< exp[0, 0, −x]
};
using Decay = BasicDecay<double>;

inline Decay decay(double exponent) {
  if (exponent < detail::series_limit) {
    const double double_integral = detail::short_single_rate_series(exponent);
    const double integral = 1.0 - exponent * double_integral;
    return {exponent, 1.0 - exponent * integral, integral, double_integral};
  }
  // The quotients are ready before the exponential is.
  const double inverse = 1.0 / exponent;
  const double factor = std::exp(-exponent);
  const double integral = (1.0 - factor) * inverse;
  return {exponent, factor, integral, (1.0 - integral) * inverse};
}

/// Two decays, one feeding the other, with its integrals.
template <class Real>
struct BasicConvolution {
  Real value;            ///< exp[−x, −y]
  Real integral;         ///< exp[0, −x, −y]
  Real double_integral;  ///< exp[0, 0, −x, −y]
};
using Convolution = BasicConvolution<double>;

inline Convolution convolution(const Decay& x, const Decay& y) {
  const Decay& slow = x.exponent <= y.exponent ? x : y;
  const Decay& fast = x.exponent <= y.exponent ? y : x;
  if (fast.exponent < detail::series_limit) {
    const double double_integral = detail::short_two_rate_series(slow.exponent, fast.exponent);
    const double integral = slow.double_integral - fast.exponent * double_integral;
    return {slow.integral - fast.exponent * integral, integral, double_integral};
  }
  const double difference = fast.exponent - slow.exponent;
  const double inverse = 1.0 / fast.exponent;
  const double value = difference > 0.5 ? (slow.factor - fast.factor) * (1.0 / difference)
                                        : slow.factor * decay(difference).integral;
  const double integral = (slow.integral - value) * inverse;
  const double double_integral = fast.exponent < detail::two_rate_series_limit
                                     ? detail::two_rate_series(slow.exponent, fast.exponent)
                                     : (slow.double_integral - integral) * inverse;
  return {value, integral, double_integral};
}

}  // namespace gearlash
