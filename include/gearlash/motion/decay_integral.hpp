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
// epsilons over the whole quadrant (tests/motion/decay_integral_test.cpp, against 50 digits).
// Source: divided differences of the exponential, McCurdy, Ng & Parlett, Math. Comp. 43 (1984).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

namespace gearlash {
namespace detail {

/// Below this argument the power series loses fewer digits than the difference quotient does, and
/// `series_terms` terms reach a double's last bit.
inline constexpr double series_limit = 1.5;
inline constexpr int series_terms = 21;

inline constexpr auto inverse_factorials = [] {
  std::array<double, series_terms + 4> table{};
  long double value = 1.0L;
  for (std::size_t k = 0; k < table.size(); ++k) {
    if (k > 0) value /= static_cast<long double>(k);
    table[k] = static_cast<double>(value);
  }
  return table;
}();

/// Σ_k (−x)^k / (k + order)!, x ≤ series_limit.
template <int order>
double single_rate_series(double x) {
  double sum = inverse_factorials[series_terms - 1 + order];
  for (int k = series_terms - 2; k >= 0; --k) {
    sum = inverse_factorials[static_cast<std::size_t>(k + order)] - x * sum;
  }
  return sum;
}

/// Σ_k (−1)^k h_k(x, y) / (k + order)!, h_k the complete symmetric polynomial; x, y ≤ series_limit.
template <int order>
double two_rate_series(double x, double y) {
  double sum = 0.0;
  double power = 1.0;      // (−x)^k
  double symmetric = 1.0;  // (−1)^k h_k(x, y)
  for (int k = 0; k < series_terms; ++k) {
    sum += symmetric * inverse_factorials[static_cast<std::size_t>(k + order)];
    power *= -x;
    symmetric = power - y * symmetric;
  }
  return sum;
}

}  // namespace detail

inline double decay_integral(double x) {
  if (x < 0.5) return x == 0.0 ? 1.0 : -std::expm1(-x) / x;
  return (1.0 - std::exp(-x)) / x;
}

inline double decay_double_integral(double x) {
  if (x < detail::series_limit) return detail::single_rate_series<2>(x);
  return (1.0 - decay_integral(x)) / x;
}

inline double decay_convolution(double x, double y) {
  return std::exp(-std::min(x, y)) * decay_integral(std::abs(y - x));
}

inline double convolution_integral(double x, double y) {
  const double slow = std::min(x, y);
  const double fast = std::max(x, y);
  if (fast < detail::series_limit) return detail::two_rate_series<2>(slow, fast);
  return (decay_integral(slow) - decay_convolution(slow, fast)) / fast;
}

inline double convolution_double_integral(double x, double y) {
  const double slow = std::min(x, y);
  const double fast = std::max(x, y);
  if (fast < detail::series_limit) return detail::two_rate_series<3>(slow, fast);
  return (decay_double_integral(slow) - convolution_integral(slow, fast)) / fast;
}

}  // namespace gearlash
