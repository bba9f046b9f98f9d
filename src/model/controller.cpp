#include "model/controller.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "base/range_check.hpp"
#include "model/controller_forms.hpp"
#include "numeric/linear_algebra.hpp"

namespace gearlash::drive {
namespace {

// ---- checks -------------------------------------------------------------------------------------

using forms::without_leading_zeros;

/// Work and memory grow with its cube, and coefficients of a higher order lose their digits.
constexpr std::size_t highest_order = 64;

void expect_permitted_order(RangeCheck& check, const char* field, std::size_t order) {
  if (order <= highest_order) return;
  check.refuse(field, "of order " + std::to_string(order),
               "must be of order at most " + std::to_string(highest_order) + " (order " +
                   std::to_string(order) + ")");
}

void inspect(RangeCheck& check, const ProportionalDerivative& controller) {
  check.finite("proportional", controller.proportional);
  check.finite("derivative", controller.derivative);
}

void inspect(RangeCheck& check, const ProportionalIntegralDerivative& controller) {
  inspect(check, ProportionalDerivative{controller.proportional, controller.derivative});
  check.finite("integral", controller.integral);
  check.not_negative("filter", controller.filter, "s");
  check.not_negative("tracking_time", controller.tracking_time, "s");
}

void inspect(RangeCheck& check, const Cascade& controller) {
  check.finite("position", controller.position);
  check.finite("speed", controller.speed);
  check.finite("speed_integral", controller.speed_integral);
  check.not_negative("tracking_time", controller.tracking_time, "s");
  check.not_negative("filter", controller.filter, "s");
}

void inspect(RangeCheck& check, const LeadLag& controller) {
  check.finite("gain", controller.gain);
  check.positive("zero", controller.zero, "rad/s");
  check.positive("pole", controller.pole, "rad/s");
}

void expect_proper(RangeCheck& check, const TransferFunction& function) {
  std::vector<Fault> found = faults(function);
  for (Fault& fault : found) fault.path = "controller." + fault.path;
  check.include(found);
  if (!found.empty()) return;
  const std::size_t numerator = without_leading_zeros(function.numerator).size();
  const std::size_t denominator = without_leading_zeros(function.denominator).size();
  expect_permitted_order(check, "denominator", denominator - 1);
  if (numerator > denominator) {
    check.refuse("numerator", "of degree " + std::to_string(numerator - 1),
                 "must be of no higher degree than the denominator (" +
                     std::to_string(denominator - 1) +
                     "): a controller cannot differentiate its input");
  }
}

void inspect(RangeCheck& check, const ErrorTransfer& controller) {
  expect_proper(check, controller.function);
  if (controller.function.delay != 0.0) {
    check.refuse("delay", exact_text(controller.function.delay),
                 "must be 0: a continuous controller has no delay");
  }
}

void inspect(RangeCheck& check, const SampledTransfer& controller) {
  expect_proper(check, {controller.numerator, controller.denominator});
}

void inspect(RangeCheck& check, const LinearController& controller) {
  const std::size_t order = controller.order();
  const auto expect = [&](const char* field, std::size_t found, std::size_t wanted,
                          const char* what) {
    if (found == wanted) return;
    check.refuse(field, std::to_string(found), "must have " + std::to_string(wanted) + what);
  };
  const auto expect_numbers = [&](const char* field, const std::vector<double>& numbers) {
    for (const double number : numbers) check.finite(field, number);
  };
  const auto expect_rows = [&](const char* field, const auto& rows, std::size_t columns,
                               const char* what) {
    expect(field, rows.size(), order, " rows, as many as the output has numbers");
    for (const auto& row : rows) {
      expect(field, row.size(), columns, what);
      expect_numbers(field, row);
    }
  };
  expect_permitted_order(check, "state_matrix", order);
  expect_numbers("output", controller.output);
  expect_numbers("direct", controller.direct);
  expect_numbers("anti_windup", controller.anti_windup);
  expect_rows("state_matrix", controller.state_matrix, order,
              " numbers in each row, as many as the output has");
  expect_rows("input_matrix", controller.input_matrix, 3, " numbers in each row, of r, y and v");
  expect("direct", controller.direct.size(), 3, " numbers, of r, y and v");
  if (!controller.anti_windup.empty()) {
    expect("anti_windup", controller.anti_windup.size(), order,
           " numbers, as many as the output has");
  }
}

}  // namespace

std::vector<Fault> faults(const Controller& controller) {
  RangeCheck check("controller.");
  std::visit([&](const auto& one) { inspect(check, one); }, controller);
  return check.faults();
}

LinearController linear_controller(const Controller& controller) {
  return forms::linear_controller<double>(controller);
}

LinearControllerOf<Interval> linear_controller(const ControllerOf<Interval>& controller) {
  return forms::linear_controller<Interval>(controller);
}

double share_of_end(Discretization method) {
  return method == Discretization::tustin ? 0.5 : method == Discretization::backward ? 1.0 : 0.0;
}

LinearController sampled_controller(const Controller& controller, const Sampling& sampling) {
  return forms::sampled_controller<double>(controller, sampling);
}

LinearControllerOf<Interval> sampled_controller(const ControllerOf<Interval>& controller,
                                                const SamplingOf<Interval>& sampling) {
  return forms::sampled_controller<Interval>(controller, sampling);
}

bool integrates(const Controller& controller) {
  const LinearController form = linear_controller(controller);
  const std::size_t order = form.order();
  if (order == 0) return false;
  Eigen::MatrixXd velocity = forms::matrix_of(form.state_matrix, order);
  const bool is_from_sample_to_sample = std::holds_alternative<SampledTransfer>(controller);
  if (is_from_sample_to_sample)
    velocity -= Eigen::MatrixXd::Identity(velocity.rows(), velocity.cols());
  return !all_solutions(velocity, forms::matrix_of(form.input_matrix, 3).col(1));
}

double spectral_radius(const LinearController& controller) {
  const std::size_t order = controller.order();
  if (order == 0) return 0.0;
  const double radius =
      eigenvalues(forms::matrix_of(controller.state_matrix, order)).cwiseAbs().maxCoeff();
  return std::isfinite(radius) ? radius : std::numeric_limits<double>::infinity();
}

SplitDelay split_delay(const Sampling& sampling) {
  if (sampling.delay == 0.0) return {};
  constexpr double rounding = 1e-12;
  const double periods = sampling.delay / sampling.period;
  const double whole = std::ceil(periods * (1.0 - rounding)) - 1.0;
  const double rest = sampling.delay - whole * sampling.period;
  return {static_cast<int>(whole),
          rest >= sampling.period * (1.0 - rounding) ? sampling.period : rest};
}

}  // namespace gearlash::drive
