#include "model/controller.hpp"

#include <cmath>
#include <limits>
#include <string>

#include "base/range_check.hpp"
#include "model/sampled_controller.hpp"

namespace gearlash::drive {
std::vector<Fault> faults(const LinearController& controller) {
  RangeCheck check("controller.");
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
  if (order > highest_order) {
    check.refuse("state_matrix", "of order " + std::to_string(order),
                 "must be of order at most " + std::to_string(highest_order) + " (order " +
                     std::to_string(order) + ")");
  }
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
  return check.faults();
}

double share_of_end(Discretization method) {
  return method == Discretization::tustin ? 0.5 : method == Discretization::backward ? 1.0 : 0.0;
}

LinearController sampled_controller(const LinearController& controller, const Sampling& sampling) {
  return forms::sampled(controller, sampling.period, sampling.method);
}

LinearControllerOf<Interval> sampled_controller(const LinearControllerOf<Interval>& controller,
                                                const Interval& period, Discretization method) {
  return forms::sampled(controller, period, method);
}

bool integrates(const LinearController& controller) {
  const std::size_t order = controller.order();
  if (order == 0) return false;
  Eigen::MatrixXd velocity = matrix_of(controller.state_matrix, order);
  if (controller.is_of_samples) {
    velocity -= Eigen::MatrixXd::Identity(velocity.rows(), velocity.cols());
  }
  return !all_solutions(velocity, matrix_of(controller.input_matrix, 3).col(1));
}

double spectral_radius(const LinearController& controller) {
  const std::size_t order = controller.order();
  if (order == 0) return 0.0;
  const double radius =
      eigenvalues(matrix_of(controller.state_matrix, order)).cwiseAbs().maxCoeff();
  return std::isfinite(radius) ? radius : std::numeric_limits<double>::infinity();
}

int position_ticks(const Sampling& sampling) {
  if (!sampling.position_period) return 1;
  return static_cast<int>(std::lround(*sampling.position_period / sampling.period));
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
