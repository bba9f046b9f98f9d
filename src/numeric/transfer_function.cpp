#include "numeric/transfer_function.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>

#include "base/lists.hpp"
#include "base/range_check.hpp"
#include "base/special_numbers.hpp"
#include "numeric/linear_algebra.hpp"

namespace gearlash {
namespace {

using Complex = std::complex<double>;

using std::numbers::pi;

void check_polynomial(RangeCheck& check, std::string_view field,
                      const std::vector<double>& coefficients) {
  for (const double coefficient : coefficients) check.finite(field, coefficient);
  const bool has_some = any_of(coefficients, [](double coefficient) { return coefficient != 0.0; });
  if (!has_some) check.refuse(field, "", "must have a coefficient other than 0");
}

struct PolynomialValue {
  Complex value;
  Complex slope;
};

PolynomialValue polynomial_at(const std::vector<double>& coefficients, const Complex& s) {
  PolynomialValue at{0.0, 0.0};
  for (const double coefficient : coefficients) {
    at.slope = at.slope * s + at.value;
    at.value = at.value * s + coefficient;
  }
  return at;
}

/// Without leading zeros, and without those at the end, which are roots at the origin.
struct StrippedPolynomial {
  std::vector<double> coefficients;
  std::size_t roots_at_origin;
};

StrippedPolynomial stripped(const std::vector<double>& coefficients) {
  const auto is_not_zero = [](double coefficient) { return coefficient != 0.0; };
  const auto first = std::find_if(coefficients.begin(), coefficients.end(), is_not_zero);
  const auto end = std::find_if(coefficients.rbegin(), coefficients.rend(), is_not_zero).base();
  return {{first, end}, static_cast<std::size_t>(coefficients.end() - end)};
}

/// In the variable s/scale, so that the product of the roots has modulus 1 and no coefficient of a
/// physical unit makes the matrix lopsided.
Eigen::MatrixXd companion_matrix(const std::vector<double>& coefficients, double scale) {
  const auto degree = static_cast<Eigen::Index>(coefficients.size()) - 1;
  Eigen::MatrixXd companion = Eigen::MatrixXd::Zero(degree, degree);
  companion.diagonal(-1).setOnes();
  double power = 1.0;
  for (Eigen::Index column = degree - 1; column >= 0; --column) {
    power *= scale;
    const double coefficient = coefficients[static_cast<std::size_t>(degree - column)];
    companion(column, degree - 1) = -coefficient / coefficients.front() / power;
  }
  return companion;
}

Complex without_noise(const Complex& root) {
  constexpr double noise = 1e-9;
  return std::abs(root.real()) <= noise * std::abs(root) ? Complex{0.0, root.imag()} : root;
}

std::vector<Complex> roots_of(const std::vector<double>& polynomial) {
  const StrippedPolynomial rest = stripped(polynomial);
  std::vector<Complex> roots(rest.roots_at_origin, 0.0);
  const std::size_t degree = rest.coefficients.size() - 1;
  if (degree == 0) return roots;
  const double product = std::abs(rest.coefficients.back() / rest.coefficients.front());
  const double scale = std::pow(product, 1.0 / static_cast<double>(degree));
  const Eigen::VectorXcd values = eigenvalues(balanced(companion_matrix(rest.coefficients, scale)));
  for (const Complex& eigenvalue : values) roots.push_back(without_noise(scale * eigenvalue));
  return roots;
}

// ---- Bounds of one factor jω − root, d = ω − Im root, x = Re root.

struct Distances {
  double low;
  double high;
  double nearest;
  double farthest;
};

Distances distances(double imaginary, double low, double high) {
  const double from = low - imaginary;
  const double to = high - imaginary;
  const bool passes = from < 0.0 && to > 0.0;
  return {from, to, passes ? 0.0 : std::min(std::abs(from), std::abs(to)),
          std::max(std::abs(from), std::abs(to))};
}

/// Phase of −x + jd: in the right half plane for x < 0; for x > 0 in the left one, passed
/// clockwise.
Bounds phase_bounds(double real, const Distances& d) {
  if (real < 0.0) return {std::atan2(d.low, -real), std::atan2(d.high, -real)};
  if (real > 0.0) return {pi - std::atan2(d.high, real), pi - std::atan2(d.low, real)};
  return {d.low < 0.0 ? -0.5 * pi : 0.5 * pi, d.high > 0.0 ? 0.5 * pi : -0.5 * pi};
}

/// d/(x² + d²), odd, with its extremes ±1/(2|x|) at d = ±|x|.
Bounds log_gain_slope_bounds(double real, const Distances& d) {
  if (real == 0.0 && d.nearest == 0.0) return {-infinity, infinity};
  const auto slope = [real](double distance) {
    return 1.0 / (distance + (distance == 0.0 ? infinity : real * (real / distance)));
  };
  const double x = std::abs(real);
  Bounds bounds{std::min(slope(d.low), slope(d.high)), std::max(slope(d.low), slope(d.high))};
  if (d.low < x && x < d.high) bounds.high = 0.5 / x;
  if (d.low < -x && -x < d.high) bounds.low = -0.5 / x;
  return bounds;
}

/// −x/(x² + d²).
Bounds phase_slope_bounds(double real, const Distances& d) {
  if (real == 0.0) return {0.0, 0.0};
  const auto slope = [real](double distance) {
    return -1.0 / (real + distance * (distance / real));
  };
  const double nearest = slope(d.nearest);
  const double farthest = slope(d.farthest);
  return {std::min(nearest, farthest), std::max(nearest, farthest)};
}

ResponseBounds factor_bounds(const Complex& root, double low, double high) {
  const Distances d = distances(root.imag(), low, high);
  return {
      {std::log(std::hypot(root.real(), d.nearest)), std::log(std::hypot(root.real(), d.farthest))},
      phase_bounds(root.real(), d),
      log_gain_slope_bounds(root.real(), d),
      phase_slope_bounds(root.real(), d)};
}

}  // namespace

std::vector<Fault> faults(const TransferFunction& transfer) {
  RangeCheck check;
  check_polynomial(check, "numerator", transfer.numerator);
  check_polynomial(check, "denominator", transfer.denominator);
  check.not_negative("delay", transfer.delay, "");
  return check.faults();
}

FrequencyResponse frequency_response(const TransferFunction& transfer, double frequency) {
  constexpr Complex j{0.0, 1.0};
  const Complex s{0.0, frequency};
  const PolynomialValue numerator = polynomial_at(transfer.numerator, s);
  const PolynomialValue denominator = polynomial_at(transfer.denominator, s);
  return {numerator.value / denominator.value * std::polar(1.0, -frequency * transfer.delay),
          j * (numerator.slope / numerator.value - denominator.slope / denominator.value -
               transfer.delay)};
}

FactoredTransferFunction factored(const TransferFunction& transfer) {
  require_none(faults(transfer));
  const double gain = stripped(transfer.numerator).coefficients.front() /
                      stripped(transfer.denominator).coefficients.front();
  return {gain, roots_of(transfer.numerator), roots_of(transfer.denominator), transfer.delay};
}

ResponseBounds response_bounds(const FactoredTransferFunction& transfer, double low, double high) {
  const double log_gain = std::log(std::abs(transfer.gain));
  const double phase = transfer.gain < 0.0 ? pi : 0.0;
  const double delay = transfer.delay;
  ResponseBounds sum{{log_gain, log_gain},
                     {phase - delay * high, phase - delay * low},
                     {0.0, 0.0},
                     {-delay, -delay}};
  const auto include = [&](const Complex& root, bool divides) {
    const ResponseBounds factor = factor_bounds(root, low, high);
    for (const auto part : {&ResponseBounds::log_gain, &ResponseBounds::phase,
                            &ResponseBounds::log_gain_slope, &ResponseBounds::phase_slope}) {
      const Bounds& term = factor.*part;
      (sum.*part).low += divides ? -term.high : term.low;
      (sum.*part).high += divides ? -term.low : term.high;
    }
  };
  for (const Complex& zero : transfer.zeros) include(zero, false);
  for (const Complex& pole : transfer.poles) include(pole, true);
  return sum;
}

}  // namespace gearlash
