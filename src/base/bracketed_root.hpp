// Newton's method that cannot leave its bracket: the last step of every crossing.
#pragma once

#include <cmath>
#include <limits>

namespace gearlash {

template <class Real>
struct BasicValueAndSlope {
  Real value;
  Real slope;
  Real curvature = 0.0;  ///< second derivative where known: Halley's step instead of Newton's
};
using ValueAndSlope = BasicValueAndSlope<double>;

/// Step towards the zero: Newton's, or Halley's if the curvature is known. Halley's step tends to 0
/// at an extremum too, so a short step proves nothing; use is_near_zero().
template <class Real>
Real newton_step(const BasicValueAndSlope<Real>& at) {
  const Real newton = -at.value / at.slope;
  return newton / (1.0 + 0.5 * newton * at.curvature / at.slope);
}

/// Whether the zero is within `distance`, by Newton's step.
template <class Real>
auto is_near_zero(const BasicValueAndSlope<Real>& at, const Real& distance) {
  using std::abs;
  return abs(at.value) <= distance * abs(at.slope);
}

namespace detail {

/// Halley's step, except where it is much shorter than Newton's, as next to an extremum.
inline double trusted_step(const ValueAndSlope& at) {
  const double newton = -at.value / at.slope;
  const double step = newton_step(at);
  return std::abs(step) < 0.25 * std::abs(newton) ? newton : step;
}

/// A point strictly inside the bracket. It halves the bracket, or its exponents if the bracket
/// spans more than a factor of four. So a root at 1e-80 is as near as one at 1.
inline double middle_of(double low, double high) {
  if (std::isinf(high)) return 2.0 * low + 1.0;
  if (low > 0.0 && high > 4.0 * low) return std::sqrt(low) * std::sqrt(high);
  if (low == 0.0) return high < 1e-300 ? 0.5 * high : high * 0x1p-20;
  return 0.5 * (low + high);
}

}  // namespace detail

/// Root of a continuous function in [low, high], by default to the last bits of a double.
///
/// `high` may be infinite if f takes the sign `sign_at_high` somewhere above. Until that sign is
/// seen, steps are Newton's if they are not too wild, else doublings. Precondition: f(high) has the
/// sign `sign_at_high` (+1 or −1) or is zero, f(low) the opposite sign or zero, 0 ≤ low. The
/// bracket shrinks at every evaluation. Bisection replaces a step that would leave it or that does
/// not halve the one before, so the loop ends for any f. It ends when
///   |step| ≤ tolerance · |x|,
/// or when the next step would be below an eighth of that. (The next step is |step|³/|last step|²
/// for a method of second order and |step|⁴/|last step|³ for third order, if both are within the
/// root's own size.) It also ends at an exact zero, or when the bracket is down to neighbouring
/// numbers.
template <class Function>
double bracketed_root(const Function& f, double low, double high, double guess, double sign_at_high,
                      double tolerance = std::numeric_limits<double>::epsilon()) {
  constexpr double rounding = std::numeric_limits<double>::epsilon();
  constexpr int step_limit = 256;
  constexpr double wild = 1e3;
  double x = guess > low && guess < high ? guess : detail::middle_of(low, high);
  double last_step = high - low;  // infinite at first where high is
  bool last_was_newton = false;
  for (int count = 0; count < step_limit; ++count) {
    const ValueAndSlope at_x = f(x);
    if (at_x.value == 0.0) return x;
    (at_x.value * sign_at_high > 0.0 ? high : low) = x;
    const bool bracketed = !std::isinf(high);
    if (bracketed && high - low <= rounding * std::abs(high)) return x;
    double step = detail::trusted_step(at_x);
    // Below the resolution of x a step has converged, even across the bracket's end.
    if (std::abs(step) <= tolerance * std::abs(x)) return std::fmin(std::fmax(x + step, low), high);
    const bool is_newton =
        bracketed ? x + step > low && x + step < high && std::abs(step) <= 0.5 * std::abs(last_step)
                  : step > 0.0 && step < wild * (1.0 + x);
    const double next = is_newton ? x + step : detail::middle_of(low, high);
    step = next - x;
    x = next;
    const double ratio = std::abs(step / last_step);
    const double gain = at_x.curvature == 0.0 ? ratio * ratio : ratio * ratio * ratio;
    if (is_newton && last_was_newton && std::abs(last_step) <= std::abs(x) &&
        std::abs(step) * gain <= 0.125 * tolerance * std::abs(x)) {
      return x;
    }
    last_step = step;
    last_was_newton = is_newton;
  }
  return x;
}

}  // namespace gearlash
