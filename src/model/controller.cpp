#include "model/controller.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "base/overloaded.hpp"
#include "base/range_check.hpp"
#include "numeric/linear_algebra.hpp"

namespace gearlash::drive {
namespace {

// ---- as linear ones -----------------------------------------------------------------------------

LinearController linear(const ProportionalDerivative& controller) {
  LinearController result;
  result.direct = {controller.proportional, -controller.proportional, -controller.derivative};
  return result;
}

/// The states are ∫e dt, times its gain, and the filter's.
LinearController linear(const ProportionalIntegralDerivative& controller) {
  LinearController result = linear(ProportionalDerivative{
      controller.proportional, controller.filter > 0.0 ? 0.0 : controller.derivative});
  const bool integrates = controller.integral != 0.0;
  const bool filters = controller.filter > 0.0 && controller.derivative != 0.0;
  const std::size_t order = (integrates ? 1U : 0U) + (filters ? 1U : 0U);
  result.state_matrix.assign(order, std::vector<double>(order, 0.0));
  result.input_matrix.assign(order, std::vector<double>(3, 0.0));
  result.output.assign(order, 1.0);
  if (integrates) {
    result.input_matrix[0] = {controller.integral, -controller.integral, 0.0};
    if (controller.tracking_time > 0.0) {
      result.anti_windup.assign(order, 0.0);
      result.anti_windup[0] = 1.0 / controller.tracking_time;
    }
  }
  if (filters) {
    const double rate = 1.0 / controller.filter;
    const double gain = controller.derivative * rate;
    result.state_matrix[order - 1][order - 1] = -rate;
    if (controller.derivative_of_speed) {
      result.input_matrix[order - 1] = {0.0, 0.0, -gain};
      return result;
    }
    // d s/(Ts + 1) = (d/T)(1 − 1/(Ts + 1))
    result.input_matrix[order - 1] = {-gain * rate, gain * rate, 0.0};
    result.direct[0] += gain;
    result.direct[1] -= gain;
  }
  return result;
}

/// Puts 1/(time s + 1) before the speed: its last state is the filtered one.
void filter_speed(LinearController& controller, double time) {
  for (std::size_t i = 0; i < controller.order(); ++i) {
    controller.state_matrix[i].push_back(std::exchange(controller.input_matrix[i][2], 0.0));
  }
  controller.output.push_back(std::exchange(controller.direct[2], 0.0));
  controller.state_matrix.emplace_back(controller.order(), 0.0).back() = -1.0 / time;
  controller.input_matrix.push_back({0.0, 0.0, 1.0 / time});
  if (!controller.anti_windup.empty()) controller.anti_windup.push_back(0.0);
}

LinearController linear(const Cascade& controller) {
  LinearController result;
  const double stiffness = controller.speed * controller.position;
  result.direct = {stiffness, -stiffness, -controller.speed};
  if (controller.speed_integral != 0.0) {
    const double integral = controller.speed_integral;
    result.state_matrix = {{0.0}};
    result.input_matrix = {
        {integral * controller.position, -integral * controller.position, -integral}};
    result.output = {1.0};
    if (controller.tracking_time > 0.0) result.anti_windup = {1.0 / controller.tracking_time};
  }
  if (controller.filter > 0.0) filter_speed(result, controller.filter);
  return result;
}

std::vector<double> without_leading_zeros(const std::vector<double>& coefficients) {
  const auto first = std::find_if(coefficients.begin(), coefficients.end(),
                                  [](double coefficient) { return coefficient != 0.0; });
  return {first, coefficients.end()};
}

/// Controllable canonical form of numerator/denominator, descending powers, times e = r − y.
LinearController canonical_form(const std::vector<double>& numerator_given,
                                const std::vector<double>& denominator_given) {
  const std::vector<double> denominator = without_leading_zeros(denominator_given);
  const std::vector<double> given = without_leading_zeros(numerator_given);
  const std::size_t order = denominator.size() - 1;
  const double lead = denominator[0];
  std::vector<double> numerator(denominator.size(), 0.0);
  std::copy_backward(given.begin(), given.end(), numerator.end());
  LinearController result;
  const double direct = numerator[0] / lead;
  result.direct = {direct, -direct, 0.0};
  result.state_matrix.assign(order, std::vector<double>(order, 0.0));
  result.input_matrix.assign(order, std::vector<double>(3, 0.0));
  for (std::size_t i = 0; i < order; ++i) {
    if (i + 1 < order) result.state_matrix[i][i + 1] = 1.0;
    // The last row has the lowest power first.
    result.state_matrix[order - 1][i] = -denominator[order - i] / lead;
    result.output.push_back((numerator[order - i] - direct * denominator[order - i]) / lead);
  }
  if (order > 0) result.input_matrix[order - 1] = {1.0, -1.0, 0.0};
  return result;
}

LinearController linear(const ErrorTransfer& controller) {
  return canonical_form(controller.function.numerator, controller.function.denominator);
}

LinearController linear(const SampledTransfer& controller) {
  return canonical_form(controller.numerator, controller.denominator);
}

LinearController linear(const LeadLag& controller) {
  // Rounding must not leave dynamics where there are none.
  if (controller.zero == controller.pole) {
    return linear(ProportionalDerivative{.proportional = controller.gain});
  }
  return linear(ErrorTransfer{
      {{controller.gain / controller.zero, controller.gain}, {1.0 / controller.pole, 1.0}}});
}

LinearController linear(const LinearController& controller) { return controller; }

// ---- checks -------------------------------------------------------------------------------------

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
  std::vector<Fault> faults = validate(function);
  for (Fault& fault : faults) fault.path = "controller." + fault.path;
  check.include(faults);
  if (!faults.empty()) return;
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

std::vector<Fault> validate(const Controller& controller) {
  RangeCheck check("controller.");
  std::visit([&](const auto& one) { inspect(check, one); }, controller);
  return check.faults();
}

LinearController linear_controller(const Controller& controller) {
  return std::visit([](const auto& one) { return linear(one); }, controller);
}

namespace {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

Matrix matrix_of(const std::vector<std::vector<double>>& rows, std::size_t columns) {
  Matrix matrix(static_cast<Eigen::Index>(rows.size()), static_cast<Eigen::Index>(columns));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (std::size_t j = 0; j < columns; ++j) {
      matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = rows[i][j];
    }
  }
  return matrix;
}

Vector vector_of(const std::vector<double>& numbers) {
  return Eigen::Map<const Vector>(numbers.data(), static_cast<Eigen::Index>(numbers.size()));
}

std::vector<std::vector<double>> rows_of(const Matrix& matrix) {
  std::vector<std::vector<double>> rows;
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    const Vector row = matrix.row(i).transpose();
    rows.emplace_back(row.data(), row.data() + row.size());
  }
  return rows;
}

std::vector<double> numbers_of(const Vector& vector) {
  return {vector.data(), vector.data() + vector.size()};
}

}  // namespace

/// With d/dt ↦ (z − 1)/(T (share z + 1 − share)), S = (I − share T A)⁻¹:
///   z⁺ = S (I + (1 − share) T A) z + S B T u,  output C S z + (D + share T C S B) u.
double share_of_end(Discretization method) {
  return method == Discretization::tustin ? 0.5 : method == Discretization::backward ? 1.0 : 0.0;
}

LinearController sampled_controller(const Controller& controller, const Sampling& sampling) {
  LinearController given = linear_controller(controller);
  const std::size_t order = given.order();
  if (std::holds_alternative<SampledTransfer>(controller) || order == 0) return given;
  const double share = share_of_end(sampling.method);
  const double period = sampling.period;
  const auto size = static_cast<Eigen::Index>(order);
  const Matrix dynamics = matrix_of(given.state_matrix, order);
  const Matrix input = matrix_of(given.input_matrix, 3);
  const Matrix identity = Matrix::Identity(size, size);
  const Matrix solved = inverse(identity - share * period * dynamics);
  const Vector output = solved.transpose() * vector_of(given.output);
  LinearController result;
  result.state_matrix = rows_of(solved * (identity + (1.0 - share) * period * dynamics));
  result.input_matrix = rows_of(period * solved * input);
  result.output = numbers_of(output);
  result.direct = numbers_of(vector_of(given.direct) + share * period * input.transpose() * output);
  if (!given.anti_windup.empty()) {
    result.anti_windup = numbers_of(period * solved * vector_of(given.anti_windup));
  }
  return result;
}

bool integrates(const Controller& controller) {
  const LinearController form = linear_controller(controller);
  const std::size_t order = form.order();
  if (order == 0) return false;
  Matrix velocity = matrix_of(form.state_matrix, order);
  const bool is_from_sample_to_sample = std::holds_alternative<SampledTransfer>(controller);
  if (is_from_sample_to_sample) velocity -= Matrix::Identity(velocity.rows(), velocity.cols());
  return !all_solutions(velocity, matrix_of(form.input_matrix, 3).col(1));
}

double spectral_radius(const LinearController& controller) {
  const std::size_t order = controller.order();
  if (order == 0) return 0.0;
  const double radius =
      eigenvalues(matrix_of(controller.state_matrix, order)).cwiseAbs().maxCoeff();
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
