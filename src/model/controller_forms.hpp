// Controllers as linear ones, for any numbers: doubles, intervals.
#pragma once

#include <algorithm>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/number.hpp"
#include "model/controller.hpp"
#include "numeric/elimination.hpp"
#include "numeric/linear_algebra.hpp"

namespace gearlash::drive::forms {

template <class Number>
LinearControllerOf<Number> linear(const ProportionalDerivativeOf<Number>& controller) {
  LinearControllerOf<Number> result;
  result.direct = {controller.proportional, -controller.proportional, -controller.derivative};
  return result;
}

/// The states are ∫e dt, times its gain, and the filter's.
template <class Number>
LinearControllerOf<Number> linear(const ProportionalIntegralDerivativeOf<Number>& controller) {
  const bool has_filter = is_above_zero(controller.filter);
  LinearControllerOf<Number> result = linear(ProportionalDerivativeOf<Number>{
      controller.proportional, has_filter ? Number(0.0) : controller.derivative});
  const bool integrates = !is_exactly(controller.integral, 0.0);
  const bool filters = has_filter && !is_exactly(controller.derivative, 0.0);
  const std::size_t order = (integrates ? 1U : 0U) + (filters ? 1U : 0U);
  result.state_matrix.assign(order, std::vector<Number>(order, Number(0.0)));
  result.input_matrix.assign(order, std::vector<Number>(3, Number(0.0)));
  result.output.assign(order, Number(1.0));
  if (integrates) {
    result.input_matrix[0] = {controller.integral, -controller.integral, 0.0};
    if (is_above_zero(controller.tracking_time)) {
      result.anti_windup.assign(order, Number(0.0));
      result.anti_windup[0] = 1.0 / controller.tracking_time;
    }
  }
  if (filters) {
    const Number rate = 1.0 / controller.filter;
    const Number gain = controller.derivative * rate;
    result.state_matrix[order - 1][order - 1] = -rate;
    if (controller.derivative_of_speed) {
      result.input_matrix[order - 1] = {0.0, 0.0, -gain};
      return result;
    }
    // d s/(Ts + 1) = (d/T)(1 − 1/(Ts + 1))
    const Number fed = gain * rate;
    result.input_matrix[order - 1] = {-fed, fed, 0.0};
    result.direct[0] = result.direct[0] + gain;
    result.direct[1] = result.direct[1] - gain;
  }
  return result;
}

/// Puts 1/(time s + 1) before the speed: its last state is the filtered one.
template <class Number>
void filter_speed(LinearControllerOf<Number>& controller, const Number& time) {
  for (std::size_t i = 0; i < controller.order(); ++i) {
    controller.state_matrix[i].push_back(std::exchange(controller.input_matrix[i][2], Number(0.0)));
  }
  controller.output.push_back(std::exchange(controller.direct[2], Number(0.0)));
  controller.state_matrix.emplace_back(controller.order(), Number(0.0)).back() = -1.0 / time;
  controller.input_matrix.push_back({0.0, 0.0, 1.0 / time});
  if (!controller.anti_windup.empty()) controller.anti_windup.push_back(0.0);
}

template <class Number>
LinearControllerOf<Number> linear(const CascadeOf<Number>& controller) {
  LinearControllerOf<Number> result;
  const Number stiffness = controller.speed * controller.position;
  result.direct = {stiffness, -stiffness, -controller.speed};
  if (!is_exactly(controller.speed_integral, 0.0)) {
    const Number integral = controller.speed_integral;
    const Number of_error = integral * controller.position;
    result.state_matrix.assign(1, {Number(0.0)});
    result.input_matrix.push_back({of_error, -of_error, -integral});
    result.output.push_back(1.0);
    if (is_above_zero(controller.tracking_time)) {
      result.anti_windup.push_back(1.0 / controller.tracking_time);
    }
  }
  if (is_above_zero(controller.filter)) filter_speed(result, controller.filter);
  return result;
}

template <class Number>
std::vector<Number> without_leading_zeros(const std::vector<Number>& coefficients) {
  const auto first = std::find_if(coefficients.begin(), coefficients.end(),
                                  [](const Number& one) { return !is_exactly(one, 0.0); });
  return {first, coefficients.end()};
}

/// Controllable canonical form of numerator/denominator, descending powers, times e = r − y.
template <class Number>
LinearControllerOf<Number> canonical_form(const std::vector<Number>& numerator_given,
                                          const std::vector<Number>& denominator_given) {
  const std::vector<Number> denominator = without_leading_zeros(denominator_given);
  const std::vector<Number> given = without_leading_zeros(numerator_given);
  const std::size_t order = denominator.size() - 1;
  const Number lead = denominator[0];
  std::vector<Number> numerator(denominator.size(), Number(0.0));
  std::copy_backward(given.begin(), given.end(), numerator.end());
  LinearControllerOf<Number> result;
  const Number direct = numerator[0] / lead;
  result.direct = {direct, -direct, 0.0};
  result.state_matrix.assign(order, std::vector<Number>(order, Number(0.0)));
  result.input_matrix.assign(order, std::vector<Number>(3, Number(0.0)));
  for (std::size_t i = 0; i < order; ++i) {
    if (i + 1 < order) result.state_matrix[i][i + 1] = 1.0;
    // The last row has the lowest power first.
    result.state_matrix[order - 1][i] = -denominator[order - i] / lead;
    result.output.push_back((numerator[order - i] - direct * denominator[order - i]) / lead);
  }
  if (order > 0) result.input_matrix[order - 1] = {1.0, -1.0, 0.0};
  return result;
}

template <class Number>
LinearControllerOf<Number> linear(const ErrorTransferOf<Number>& controller) {
  return canonical_form(controller.function.numerator, controller.function.denominator);
}

template <class Number>
LinearControllerOf<Number> linear(const SampledTransferOf<Number>& controller) {
  return canonical_form(controller.numerator, controller.denominator);
}

template <class Number>
LinearControllerOf<Number> linear(const LeadLagOf<Number>& controller) {
  // Rounding must not leave dynamics where there are none.
  if (are_equal(controller.zero, controller.pole)) {
    return linear(ProportionalDerivativeOf<Number>{.proportional = controller.gain});
  }
  return canonical_form<Number>({controller.gain / controller.zero, controller.gain},
                                {1.0 / controller.pole, 1.0});
}

template <class Number>
LinearControllerOf<Number> linear(const LinearControllerOf<Number>& controller) {
  return controller;
}

template <class Number>
LinearControllerOf<Number> linear_controller(const ControllerOf<Number>& controller) {
  return std::visit([](const auto& one) { return linear(one); }, controller);
}

// ---- from sample to sample ----------------------------------------------------------------------

template <class Number>
MatrixOf<Number> matrix_of(const std::vector<std::vector<Number>>& rows, std::size_t columns) {
  MatrixOf<Number> matrix(static_cast<Eigen::Index>(rows.size()),
                          static_cast<Eigen::Index>(columns));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (std::size_t j = 0; j < columns; ++j) {
      matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = rows[i][j];
    }
  }
  return matrix;
}

template <class Number>
VectorOf<Number> vector_of(const std::vector<Number>& numbers) {
  return Eigen::Map<const VectorOf<Number>>(numbers.data(),
                                            static_cast<Eigen::Index>(numbers.size()));
}

template <class Number>
std::vector<Number> numbers_of(const VectorOf<Number>& vector) {
  return {vector.data(), vector.data() + vector.size()};
}

template <class Number>
std::vector<std::vector<Number>> rows_of(const MatrixOf<Number>& matrix) {
  std::vector<std::vector<Number>> rows;
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    rows.push_back(numbers_of<Number>(matrix.row(i).transpose()));
  }
  return rows;
}

template <class Number>
MatrixOf<Number> inverse_of(const MatrixOf<Number>& matrix) {
  if constexpr (std::is_same_v<Number, double>) {
    return inverse(matrix);
  } else {
    return inverse_by_elimination(matrix);
  }
}

/// The reference enters as the position does, with the other sign.
template <class Number>
void make_difference(std::vector<Number>& row) {
  row[0] = -row[1];
}

/// With d/dt ↦ (z − 1)/(T (share z + 1 − share)), S = (I − share T A)⁻¹:
///   z⁺ = S (I + (1 − share) T A) z + S B T u,  output C S z + (D + share T C S B) u.
template <class Number>
LinearControllerOf<Number> sampled_controller(const ControllerOf<Number>& controller,
                                              const SamplingOf<Number>& sampling) {
  LinearControllerOf<Number> given = linear_controller(controller);
  const std::size_t order = given.order();
  if (std::holds_alternative<SampledTransferOf<Number>>(controller) || order == 0) return given;
  const double share = share_of_end(sampling.method);
  const Number period = sampling.period;
  const auto size = static_cast<Eigen::Index>(order);
  const MatrixOf<Number> dynamics = matrix_of(given.state_matrix, order);
  const MatrixOf<Number> input = matrix_of(given.input_matrix, 3);
  const MatrixOf<Number> identity = MatrixOf<Number>::Identity(size, size);
  const Number at_end = share * period;
  const Number at_start = (1.0 - share) * period;
  const MatrixOf<Number> solved = inverse_of<Number>(identity - at_end * dynamics);
  const Number one = 1.0;
  const VectorOf<Number> output = product(one, solved.transpose(), vector_of(given.output));
  LinearControllerOf<Number> result;
  const MatrixOf<Number> start = identity + at_start * dynamics;
  result.state_matrix = rows_of<Number>(product(one, solved, start));
  result.input_matrix = rows_of<Number>(product(period, solved, input));
  result.output = numbers_of<Number>(output);
  result.direct =
      numbers_of<Number>(vector_of(given.direct) + product(at_end, input.transpose(), output));
  if (!given.anti_windup.empty()) {
    result.anti_windup = numbers_of<Number>(product(period, solved, vector_of(given.anti_windup)));
  }
  if (knows_error_alone(given)) {
    make_difference(result.direct);
    for (std::vector<Number>& row : result.input_matrix) make_difference(row);
  }
  return result;
}

}  // namespace gearlash::drive::forms
