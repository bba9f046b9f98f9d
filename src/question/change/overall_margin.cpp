#include "question/change/overall_margin.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "base/lists.hpp"
#include "base/special_numbers.hpp"
#include "closed_form/growth_at_rest.hpp"
#include "model/proportional_servo.hpp"
#include "numeric/differences.hpp"
#include "numeric/linear_algebra.hpp"

namespace gearlash {
namespace {

using Change = Eigen::Matrix<double, 5, 1>;  // logarithms, in the order of LogChange

Drivetrain changed(const Drivetrain& drive, const Change& change) {
  Drivetrain result = drive;
  result.motor_inertia *= std::exp(change(0));
  result.load_inertia *= std::exp(change(1));
  result.motor_friction *= std::exp(change(2));
  result.load_friction *= std::exp(change(3));
  result.stiffness *= std::exp(change(4));
  return result;
}

/// ln μ₀ as a function of the change from a drive; NaN where the changed drive is unsound.
class LogGrowth {
 public:
  explicit LogGrowth(const Drivetrain& drive) : drive_(drive) {}

  double value(const Change& change) const {
    const Drivetrain here = changed(drive_, change);
    if (!faults(here).empty()) return not_a_number;
    return std::log(growth_at_rest(servo_dynamics(normalize(here))));
  }

  struct ValueAndGradient {
    double value = not_a_number;
    Change gradient = Change::Constant(not_a_number);
  };
  ValueAndGradient with_gradient(const Change& change) const {
    ValueAndGradient here{.value = value(change)};
    for (Eigen::Index i = 0; i < change.size(); ++i) {
      const NumbersAt along = [&](double step) -> std::vector<double> {
        return {value(change + step * Change::Unit(i))};
      };
      here.gradient(i) = differences(along, 0.0, {.sizes = {1.0}}).front().slope;
    }
    return here;
  }

 private:
  Drivetrain drive_;
};

// ---- rays ---------------------------------------------------------------------------------------

constexpr double longest_change = 10.0;
constexpr double ray_step = 0.02;

/// The length at which ln μ₀ first changes its sign along a ray, up to `reach`.
std::optional<double> first_crossing(const LogGrowth& growth, const Change& direction,
                                     double reach) {
  const auto hunts_at = [&](double length) { return growth.value(length * direction) > 0.0; };
  const bool hunts = hunts_at(0.0);
  double low = 0.0;
  while (low < reach) {
    double high = std::min(low + ray_step, reach);
    if (std::isnan(growth.value(high * direction))) return std::nullopt;
    if (hunts_at(high) == hunts) {
      low = high;
      continue;
    }
    for (double middle = 0.5 * (low + high); middle > low && middle < high;
         middle = 0.5 * (low + high)) {
      (hunts_at(middle) == hunts ? low : high) = middle;
    }
    return high;
  }
  return std::nullopt;
}

/// Unit vectors along the axes, in both directions, and 128 more (a golden-angle spiral on the
/// sphere), evenly spread over the space orthogonal to changes of the units of torque,
/// (1, 1, 1, 1, 1), and of time, (2, 2, 1, 1, 0).
std::vector<Change> ray_directions() {
  Eigen::Matrix<double, 5, 3> basis;
  basis.col(0) = Change(1.0, -1.0, 0.0, 0.0, 0.0) / std::sqrt(2.0);
  basis.col(1) = Change(0.0, 0.0, 1.0, -1.0, 0.0) / std::sqrt(2.0);
  basis.col(2) = Change(-1.0, -1.0, 2.0, 2.0, -2.0) / std::sqrt(14.0);
  std::vector<Change> directions;
  for (Eigen::Index axis = 0; axis < 5; ++axis) {
    directions.push_back(Change::Unit(axis));
    directions.push_back(-Change::Unit(axis));
  }
  constexpr int count = 128;
  const double golden_angle = std::numbers::pi * (3.0 - std::sqrt(5.0));
  for (int i = 0; i < count; ++i) {
    const double height = 1.0 - (2.0 * i + 1.0) / count;
    const double radius = std::sqrt(1.0 - height * height);
    const Eigen::Vector3d point(radius * std::cos(golden_angle * i),
                                radius * std::sin(golden_angle * i), height);
    directions.push_back(basis * point);
  }
  return directions;
}

/// The crossings found, the nearest first. Rays end somewhat beyond the nearest crossing so far.
std::vector<Change> crossings(const LogGrowth& growth) {
  std::vector<Change> met;
  double nearest = longest_change;
  for (const Change& direction : ray_directions()) {
    constexpr double beyond = 2.0;
    const double reach = std::min(longest_change, beyond * nearest);
    const auto length = first_crossing(growth, direction, reach);
    if (!length) continue;
    met.push_back(*length * direction);
    nearest = std::min(nearest, *length);
  }
  sort_by(met, [](const Change& change) { return change.squaredNorm(); });
  return met;
}

// ---- the least change ---------------------------------------------------------------------------

/// One step, shortened if necessary, towards the nearest point of the linearized boundary; empty
/// where no step lowers ½|x|² + k|ln μ₀|.
std::optional<Change> improved(const LogGrowth& growth, const Change& at,
                               const LogGrowth::ValueAndGradient& here) {
  const double square = here.gradient.squaredNorm();
  const Change target = here.gradient * ((here.gradient.dot(at) - here.value) / square);
  const double weight = 2.0 * std::max(at.norm(), target.norm()) / std::sqrt(square) + 1e-3;
  const auto merit = [&](const Change& x, double value) {
    return 0.5 * x.squaredNorm() + weight * std::abs(value);
  };
  const double present = merit(at, here.value);
  constexpr int most_halvings = 30;
  double share = 1.0;
  for (int i = 0; i < most_halvings; ++i, share *= 0.5) {
    const Change next = at + share * (target - at);
    const double value = growth.value(next);
    if (!std::isnan(value) && merit(next, value) < present) return next;
  }
  return std::nullopt;
}

/// Projects onto the boundary by Newton's method along the gradient.
std::optional<Change> on_boundary(const LogGrowth& growth, Change at) {
  constexpr double near = 1e-13;
  for (int i = 0; i < 20; ++i) {
    const auto here = growth.with_gradient(at);
    if (!std::isfinite(here.value) || !(here.gradient.squaredNorm() > 0.0)) return std::nullopt;
    if (std::abs(here.value) <= near) return at;
    at -= here.gradient * (here.value / here.gradient.squaredNorm());
  }
  constexpr double acceptable = 1e-11;
  if (std::abs(growth.value(at)) <= acceptable) return at;
  return std::nullopt;
}

/// Second derivatives of ln μ₀ by differences of its gradient.
Eigen::Matrix<double, 5, 5> curvature(const LogGrowth& growth, const Change& at) {
  constexpr double step = 1e-4;
  Eigen::Matrix<double, 5, 5> second;
  for (Eigen::Index i = 0; i < 5; ++i) {
    const Change aside = step * Change::Unit(i);
    second.col(i) =
        (growth.with_gradient(at + aside).gradient - growth.with_gradient(at - aside).gradient) /
        (2.0 * step);
  }
  return 0.5 * (second + second.transpose());
}

/// Newton's method on x = λg, ln μ₀ = 0, from near a solution. Where the boundary is as curved as
/// the sphere about the present drive, the steps above oscillate.
std::optional<Change> stationary_change(const LogGrowth& growth, Change at) {
  double multiplier = not_a_number;
  for (int i = 0; i < 30; ++i) {
    const auto here = growth.with_gradient(at);
    if (!std::isfinite(here.value) || !(here.gradient.squaredNorm() > 0.0)) return std::nullopt;
    if (i == 0) multiplier = at.dot(here.gradient) / here.gradient.squaredNorm();
    Eigen::MatrixXd slope = Eigen::MatrixXd::Zero(6, 6);
    slope.topLeftCorner<5, 5>().setIdentity();
    slope.topLeftCorner<5, 5>() -= multiplier * curvature(growth, at);
    slope.topRightCorner<5, 1>() = -here.gradient;
    slope.bottomLeftCorner<1, 5>() = here.gradient.transpose();
    Eigen::VectorXd residual(6);
    residual << at - multiplier * here.gradient, here.value;
    const Eigen::VectorXd step = solved(slope, Eigen::VectorXd(-residual));
    if (!step.allFinite()) return std::nullopt;
    at += step.head<5>();
    multiplier += step(5);
    constexpr double short_step = 1e-11;
    if (step.head<5>().norm() <= short_step * (1.0 + at.norm())) return on_boundary(growth, at);
  }
  return std::nullopt;
}

/// A point where the boundary is perpendicular to the change, which is necessary for a least
/// change; empty if the steps do not converge.
std::optional<Change> least_change(const LogGrowth& growth, Change at) {
  constexpr int most_steps = 30;
  for (int i = 0; i < most_steps; ++i) {
    const auto here = growth.with_gradient(at);
    if (!std::isfinite(here.value) || !(here.gradient.squaredNorm() > 0.0)) return std::nullopt;
    const auto next = improved(growth, at, here);
    if (!next) break;
    constexpr double short_step = 1e-4;
    const bool is_near = (*next - at).norm() <= short_step * (1.0 + at.norm());
    at = *next;
    if (is_near) break;
  }
  return stationary_change(growth, at);
}

void accept(OverallMargin& margin, const LogGrowth& growth, const Change& change) {
  if (margin.change && margin.change->length() <= change.norm()) return;
  constexpr double acceptable = 1e-10;
  if (!(std::abs(std::exp(growth.value(change)) - 1.0) < acceptable)) return;
  margin.outcome = MarginOutcome::found;
  margin.change = LogChange{change(0), change(1), change(2), change(3), change(4)};
}

std::optional<MarginOutcome> outcome_without_search(const Drivetrain& drive) {
  if (drive.backlash == 0.0) return MarginOutcome::never_hunts;
  if (drive.motor_friction == 0.0 || drive.load_friction == 0.0) return MarginOutcome::always_hunts;
  return std::nullopt;
}

}  // namespace

double LogChange::length() const {
  return Change(motor_inertia, load_inertia, motor_friction, load_friction, stiffness).norm();
}

OverallMargin overall_margin(const Drivetrain& drive) {
  const NormalizedServo servo = normalize(drive);
  OverallMargin margin;
  margin.hunts = drive.backlash > 0.0 && growth_at_rest(servo_dynamics(servo)) > 1.0;
  if (const auto outcome = outcome_without_search(drive)) {
    margin.outcome = *outcome;
    return margin;
  }
  const LogGrowth growth(drive);
  std::vector<Change> starts = crossings(growth);
  for (const Change& crossing : starts) accept(margin, growth, crossing);
  constexpr std::size_t most_crossings = 8;
  if (starts.size() > most_crossings) starts.resize(most_crossings);
  starts.push_back(Change::Zero());
  margin.starts = starts.size();
  for (const Change& start : starts) {
    const auto least = least_change(growth, start);
    if (!least) continue;
    ++margin.converged;
    accept(margin, growth, *least);
  }
  if (margin.outcome != MarginOutcome::found) margin.outcome = MarginOutcome::out_of_reach;
  return margin;
}

std::optional<OverallMargin> overall_margin(const Drive& drive) {
  const std::optional<ProportionalServo> servo = settled_servo(drive);
  return servo ? std::optional(overall_margin(servo->drivetrain)) : std::nullopt;
}

}  // namespace gearlash
