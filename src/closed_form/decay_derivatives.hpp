// Derivatives of decays and convolutions by their exponents, as exact as the functions.
//
// The derivative of a divided difference of exp by a node is the divided difference with that node
// twice:
//   d exp[0, −x]/dx = −exp[0, −x, −x],   ∂ exp[−x, −y]/∂x = −exp[−x, −x, −y],   and so on.
// For small exponents the longest difference is a power series and the others follow downwards; for
// large ones the same equations are solved upwards, from
//   exp[−x, −x, −y] = e^{−x} exp[0, 0, −(y − x)]   (x ≤ y),   e^{−y} exp[0, −(x − y), −(x − y)].
// Permitted: exponents ≥ 0 and finite. All are negative. Relative error: at most 128 epsilons
// (tests/closed_form, against 50 digits). Source: as decay_integral.hpp.
#pragma once

#include "closed_form/decay_integral.hpp"

namespace gearlash {

/// By the exponent.
struct DecaySlope {
  double factor;           ///< −e^{−x}
  double integral;         ///< −exp[0, −x, −x]
  double double_integral;  ///< −exp[0, 0, −x, −x]
};

inline DecaySlope decay_slope(const Decay& x) {
  const Convolution twice = convolution(x, x);
  return {-x.factor, -twice.integral, -twice.double_integral};
}

/// By the exponent of one of the two decays.
struct ConvolutionSlope {
  double value;            ///< −exp[−x, −x, −y]
  double integral;         ///< −exp[0, −x, −x, −y]
  double double_integral;  ///< −exp[0, 0, −x, −x, −y]
};

namespace detail {

/// exp[0, 0, −x, −x, −y] = Σ_k (−1)^k h_k(x, x, y)/(k + 4)!, h_k the complete symmetric polynomial.
inline double repeated_rate_series(double x, double y) {
  double power = 1.0;     // y^k
  double once = 1.0;      // h_k(x, y)
  double repeated = 1.0;  // h_k(x, x, y)
  double sign = 1.0;
  double sum = 0.0;
  for (std::size_t k = 0; k < series_terms + 4; ++k) {
    sum += sign * repeated * inverse_factorials[k + 4];
    power *= y;
    once = power + x * once;
    repeated = once + x * repeated;
    sign = -sign;
  }
  return sum;
}

/// exp[−x, −x, −y].
inline double repeated_rate_value(const Decay& x, const Decay& y) {
  const double difference = y.exponent - x.exponent;
  if (difference >= 0.0) return x.factor * decay(difference).double_integral;
  const Decay split = decay(-difference);
  return y.factor * convolution(split, split).integral;
}

}  // namespace detail

/// ∂ convolution(x, y)/∂x. The derivative by y is convolution_slope(y, x).
inline ConvolutionSlope convolution_slope(const Decay& x, const Decay& y) {
  const Convolution twice = convolution(x, x);
  if (std::max(x.exponent, y.exponent) < detail::series_limit) {
    const double double_integral = detail::repeated_rate_series(x.exponent, y.exponent);
    const double integral = twice.double_integral - y.exponent * double_integral;
    return {-(twice.integral - y.exponent * integral), -integral, -double_integral};
  }
  // Without the faster of the two.
  const bool is_slow = x.exponent <= y.exponent;
  const Convolution rest = is_slow ? twice : convolution(x, y);
  const double inverse = 1.0 / std::max(x.exponent, y.exponent);
  const double value = detail::repeated_rate_value(x, y);
  const double integral = (rest.integral - value) * inverse;
  return {-value, -integral, -(rest.double_integral - integral) * inverse};
}

}  // namespace gearlash
