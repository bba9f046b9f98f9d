// φ-functions of decaying exponentials and their two-rate forms, without loss of digits where
// rates coincide or vanish.
//
// Every closed form of the gap is a sum of these. They are divided differences of exp at the
// points 0, −x and −y, where x and y are rate times time:
//   decay_integral(x)                 exp[0, −x]         = ∫₀¹ e^{−xs} ds         (φ₁(−x))
//   decay_double_integral(x)          exp[0, 0, −x]      = ∫₀¹ (1−s) e^{−xs} ds   (φ₂(−x))
//   decay_convolution(x, y)           exp[−x, −y]        = ∫₀¹ e^{−xs} e^{−y(1−s)} ds
//   convolution_integral(x, y)        exp[0, −x, −y]
//   convolution_double_integral(x, y) exp[0, 0, −x, −y]
// Permitted: x, y ≥ 0 and finite. All are positive and decreasing. Relative error: at most 16
// epsilons over the whole quadrant (tests/motion, against 50 digits).
// Source: divided differences of the exponential, McCurdy, Ng & Parlett, Math. Comp. 43 (1984).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

namespace gearlash {

/// One exponential decay, from a single call of the library's exponential.
struct Decay {
  double exponent;  ///< x ≥ 0
  double factor;    ///< e^{−x}
  double loss;      ///< 1 − e^{−x}

  double integral() const { return exponent == 0.0 ? 1.0 : loss / exponent; }  ///< exp[0, −x]
};

inline Decay decay(double exponent) {
  if (exponent < 0.5) {
    const double loss = -std::expm1(-exponent);
    return {exponent, 1.0 - loss, loss};
  }
  const double factor = std::exp(-exponent);
  return {exponent, factor, 1.0 - factor};
}

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

/// Where the larger argument is below its limit, the power series loses fewer digits than the
/// difference quotient does, and its terms reach a double's last bit.
inline constexpr double double_integral_limit = 1.5;
inline constexpr std::size_t double_integral_terms = 21;
inline constexpr double convolution_limit = 0.75;
inline constexpr std::size_t convolution_terms = 15;

/// Σ_k (−x)^k / (k + order)!
template <std::size_t order, std::size_t terms>
double single_rate_series(double x) {
  double sum = 0.0;
  for (std::size_t k = terms; k-- > 0;) sum = inverse_factorials[k + order] - x * sum;
  return sum;
}

/// Σ_k (−1)^k h_k(x, y) / (k + order)!, h_k the complete symmetric polynomial.
template <std::size_t order, std::size_t terms>
double two_rate_series(double x, double y) {
  double sum = 0.0;
  double power = 1.0;      // (−x)^k
  double symmetric = 1.0;  // (−1)^k h_k(x, y)
  for (std::size_t k = 0; k < terms; ++k) {
    sum += symmetric * inverse_factorials[k + order];
    power *= -x;
    symmetric = power - y * symmetric;
  }
  return sum;
}

}  // namespace detail

inline double decay_integral(double x) { return decay(x).integral(); }

inline double decay_double_integral(double x) {
  if (x < detail::double_integral_limit) {
    return detail::single_rate_series<2, detail::double_integral_terms>(x);
  }
  return (1.0 - decay_integral(x)) / x;
}

inline double decay_convolution(const Decay& x, const Decay& y) {
  const double difference = y.exponent - x.exponent;
  if (std::abs(difference) > 0.5) return (x.factor - y.factor) / difference;
  return std::max(x.factor, y.factor) * decay_integral(std::abs(difference));
}

inline double convolution_integral(const Decay& x, const Decay& y) {
  const Decay& slow = x.exponent <= y.exponent ? x : y;
  const Decay& fast = x.exponent <= y.exponent ? y : x;
  if (fast.exponent < detail::convolution_limit) {
    return detail::two_rate_series<2, detail::convolution_terms>(slow.exponent, fast.exponent);
  }
  return (slow.integral() - decay_convolution(slow, fast)) / fast.exponent;
}

inline double decay_convolution(double x, double y) {
  return decay_convolution(decay(x), decay(y));
}

inline double convolution_integral(double x, double y) {
  return convolution_integral(decay(x), decay(y));
}

inline double convolution_double_integral(double x, double y) {
  const double slow = std::min(x, y);
  const double fast = std::max(x, y);
  if (fast < detail::double_integral_limit) {
    return detail::two_rate_series<3, detail::double_integral_terms>(slow, fast);
  }
  return (decay_double_integral(slow) - convolution_integral(slow, fast)) / fast;
}

}  // namespace gearlash
