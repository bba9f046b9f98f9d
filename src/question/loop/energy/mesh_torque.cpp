// mean|N| ≤ |N₀| + (b/2) sup Re(H (1 − λ s)) on the imaginary axis, for every λ ≥ 0, with N₀ the
// mesh torque of the rest without a gap. λ is chosen in floating point, where the largest of many
// frequencies is least; the supremum is proved by the sign of a polynomial.
#include "question/loop/energy/mesh_torque.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include "base/arithmetic.hpp"
#include "question/loop/energy/loop_polynomials.hpp"

namespace gearlash {
namespace {

using drive::ReducedDrive;
using Complex = std::complex<double>;
using Polynomial = IntervalPolynomial;

Complex value(const Polynomial& polynomial, Complex s) {
  Complex sum = 0.0;
  for (std::size_t i = polynomial.size(); i-- > 0;) sum = sum * s + middle(polynomial[i]);
  return sum;
}

/// 0, and from far below to far above all moduli of the roots.
std::vector<double> frequencies(const Polynomial& closed) {
  const std::size_t order = closed.size() - 1;
  double slow = infinity;
  double fast = 0.0;
  for (std::size_t k = 0; k <= order; ++k) {
    const double size = std::abs(middle(closed[k]));
    if (size == 0.0) continue;
    const auto below = static_cast<double>(k);
    const auto above = static_cast<double>(order - k);
    if (k > 0) slow = std::min(slow, std::pow(std::abs(middle(closed[0])) / size, 1.0 / below));
    if (k < order) fast = std::max(fast, std::pow(size / middle(closed[order]), 1.0 / above));
  }
  constexpr int count = 2000;
  constexpr double beyond = 1e3;
  std::vector<double> result{0.0};
  for (int i = 0; i <= count; ++i) {
    const double share = static_cast<double>(i) / count;
    result.push_back(slow / beyond * std::pow(fast / slow * beyond * beyond, share));
  }
  return result;
}

/// Re H and ω Im H.
struct Response {
  double real;
  double turned;
};

/// max(real + λ turned): convex in λ.
double largest(const std::vector<Response>& responses, double lambda) {
  double result = -infinity;
  for (const Response& one : responses) result = std::max(result, one.real + lambda * one.turned);
  return result;
}

/// By bisection of intervals in the golden section of the logarithm.
double best_lambda(const std::vector<Response>& responses, double unit) {
  constexpr double widest = 1e8;
  constexpr int steps = 80;
  const double section = 0.5 * (std::sqrt(5.0) - 1.0);
  double low = std::log(unit / widest);
  double high = std::log(unit * widest);
  for (int i = 0; i < steps; ++i) {
    const double a = high - section * (high - low);
    const double b = low + section * (high - low);
    (largest(responses, std::exp(a)) < largest(responses, std::exp(b)) ? high : low) =
        largest(responses, std::exp(a)) < largest(responses, std::exp(b)) ? b : a;
  }
  return std::exp(0.5 * (low + high));
}

/// Whether bound > Re(N (1 − λ s)/D) for all ω > 0: the sign of a polynomial in ω².
bool is_above(const Interval& bound, const Polynomial& numerator, const Polynomial& denominator,
              double lambda) {
  const Polynomial turned = product(numerator, {1.0, -Interval(lambda)});
  const Polynomial response = real_part(product(turned, conjugate(denominator)));
  const Polynomial size = real_part(product(denominator, conjugate(denominator)));
  return is_positive(sum(product({bound}, size), product({-1.0}, response)));
}

bool is_covered(const ReducedDrive& drive) {
  return drive::has_linear_control(drive) &&
         std::holds_alternative<drive::RigidContact>(drive.contact) && !drive.sampling &&
         drive.sensing.resolution == 0.0 && !drive::has_dry_friction(drive) &&
         std::holds_alternative<double>(drive.load_torque) &&
         std::holds_alternative<double>(drive.reference);
}

/// N₀ = k_g y₀ − w, with closed(0) y₀ = denominator(0) w + at_reference(0) r. Precondition: the
/// loop is stable.
Interval torque_at_rest(const CourseOf<Interval>& course, const Interval& weight,
                        const LoopPolynomials& loop) {
  if (is_exactly(weight, 0.0)) return -course.load_torque;
  const Interval position = (loop.denominator.front() * course.load_torque +
                             loop.at_reference.front() * course.reference) /
                            loop.closed.front();
  return weight * position - course.load_torque;
}

}  // namespace

std::optional<double> highest_mean_mesh_torque(const EnclosedDrive& drive) {
  if (!proves() || !is_covered(drive.form())) return std::nullopt;
  const LinearDrive<Interval> linear = linear_drive(drive);
  if (linear.order() > highest_order_of_polynomials) return std::nullopt;
  const LoopPolynomials loop = loop_polynomials(linear);
  if (!is_stable(loop.closed)) return std::nullopt;
  const Polynomial numerator = product({-1.0}, product(loop.load, loop.motor));
  std::vector<Response> responses;
  const std::vector<double> grid = frequencies(loop.closed);
  for (const double frequency : grid) {
    const Complex s(0.0, frequency);
    const Complex response = value(numerator, s) / value(loop.closed, s);
    responses.push_back({response.real(), frequency * response.imag()});
  }
  const double best = best_lambda(responses, 1.0 / grid[grid.size() / 2]);
  // Often the best is the least with which high frequencies count nothing: it needs a margin.
  for (const double margin : {0.0, 1e-4, 1e-3, 1e-2, 0.1}) {
    const double lambda = best * (1.0 + margin);
    const double seen = largest(responses, lambda);
    if (!(seen > 0.0) || !std::isfinite(seen)) return std::nullopt;
    constexpr double slack = 1e-3;
    const Interval bound = (1.0 + slack) * Interval(seen);
    if (is_above(bound, numerator, loop.closed, lambda)) {
      const Interval at_rest = torque_at_rest(drive.course(), linear.weight, loop);
      return (abs(at_rest) + 0.5 * drive.numbers().backlash * bound).high;
    }
  }
  return std::nullopt;
}

}  // namespace gearlash
