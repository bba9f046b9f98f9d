// The laws of gearlash/controller.hpp as linear controllers, for any numbers: doubles, intervals.
// `gain` makes a Number of each of their doubles; `scale` is torque per unit of output.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "base/lists.hpp"
#include "base/number.hpp"
#include "model/controller.hpp"
#include "numeric/vector_algebra.hpp"

namespace gearlash::drive::forms {

template <class Number>
LinearControllerOf<Number> proportional(const Number& of_position, const Number& of_speed) {
  LinearControllerOf<Number> result;
  result.direct = {of_position, -of_position, -of_speed};
  return result;
}

/// The states are ∫e dt, times its gain, and the filter's.
template <class Number, class Gain>
LinearControllerOf<Number> linear(const PID& pid, const Gain& gain, const Number& scale) {
  const bool has_integral = pid.terms == PIDTerms::PI || pid.terms == PIDTerms::PID;
  const bool has_derivative = pid.terms == PIDTerms::PD || pid.terms == PIDTerms::PID;
  const Number derivative = has_derivative ? Number(scale * gain(pid.derivative)) : Number(0.0);
  const Number filter = has_derivative ? Number(gain(pid.filter)) : Number(0.0);
  const Number integral = has_integral ? Number(scale * gain(pid.integral)) : Number(0.0);
  const bool has_filter = is_above_zero(filter);
  LinearControllerOf<Number> result =
      proportional<Number>(scale * gain(pid.proportional), has_filter ? Number(0.0) : derivative);
  const bool integrates = !is_exactly(integral, 0.0);
  const bool filters = has_filter && !is_exactly(derivative, 0.0);
  const std::size_t order = (integrates ? 1U : 0U) + (filters ? 1U : 0U);
  result.state_matrix.assign(order, std::vector<Number>(order, Number(0.0)));
  result.input_matrix.assign(order, std::vector<Number>(3, Number(0.0)));
  result.output.assign(order, Number(1.0));
  if (integrates) {
    result.input_matrix[0] = {integral, -integral, 0.0};
    const Number tracking_time = gain(pid.tracking_time);
    if (is_above_zero(tracking_time)) {
      result.anti_windup.assign(order, Number(0.0));
      result.anti_windup[0] = 1.0 / tracking_time;
    }
  }
  if (filters) {
    const Number rate = 1.0 / filter;
    const Number by_rate = derivative * rate;
    result.state_matrix[order - 1][order - 1] = -rate;
    if (pid.derivative_of_speed) {
      result.input_matrix[order - 1] = {0.0, 0.0, -by_rate};
      return result;
    }
    // d s/(Ts + 1) = (d/T)(1 − 1/(Ts + 1))
    const Number fed = by_rate * rate;
    result.input_matrix[order - 1] = {-fed, fed, 0.0};
    result.direct[0] = result.direct[0] + by_rate;
    result.direct[1] = result.direct[1] - by_rate;
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

template <class Number, class Gain>
LinearControllerOf<Number> linear(const CascadeController& cascade, const Gain& gain,
                                  const Number& scale) {
  const Number position = gain(cascade.position);
  const Number speed = scale * gain(cascade.speed);
  const Number integral = scale * gain(cascade.speed_integral);
  LinearControllerOf<Number> result = proportional<Number>(speed * position, speed);
  if (!is_exactly(integral, 0.0)) {
    const Number of_error = integral * position;
    result.state_matrix.assign(1, {Number(0.0)});
    result.input_matrix.push_back({of_error, -of_error, -integral});
    result.output.push_back(1.0);
    const Number tracking_time = gain(cascade.tracking_time);
    if (is_above_zero(tracking_time)) result.anti_windup.push_back(1.0 / tracking_time);
  }
  const Number filter = gain(cascade.filter);
  if (is_above_zero(filter)) filter_speed(result, filter);
  return result;
}

template <class Number>
std::vector<Number> without_leading_zeros(const std::vector<Number>& coefficients) {
  const auto first = std::find_if(coefficients.begin(), coefficients.end(),
                                  [](const Number& one) { return !is_exactly(one, 0.0); });
  return {first, coefficients.end()};
}

/// Controllable canonical form of numerator/denominator, descending powers, times e = r − y; empty,
/// a faulty controller, if it is not proper or of too high an order.
template <class Number>
LinearControllerOf<Number> canonical_form(const std::vector<Number>& numerator_given,
                                          const std::vector<Number>& denominator_given) {
  const std::vector<Number> denominator = without_leading_zeros(denominator_given);
  const std::vector<Number> given = without_leading_zeros(numerator_given);
  LinearControllerOf<Number> result;
  result.direct.clear();
  const bool is_proper = !denominator.empty() && given.size() <= denominator.size();
  if (!is_proper || denominator.size() > highest_order + 1) return result;
  const std::size_t order = denominator.size() - 1;
  const Number lead = denominator[0];
  std::vector<Number> numerator(denominator.size(), Number(0.0));
  std::copy_backward(given.begin(), given.end(), numerator.end());
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

template <class Number, class Gain>
LinearControllerOf<Number> linear(const LeadLagController& lead_lag, const Gain& gain,
                                  const Number& scale) {
  const Number whole = scale * gain(lead_lag.gain);
  const Number zero = gain(lead_lag.zero);
  const Number pole = gain(lead_lag.pole);
  // Rounding must not leave dynamics where there are none.
  if (are_equal(zero, pole)) return proportional<Number>(whole, 0.0);
  return canonical_form<Number>({whole / zero, whole}, {1.0 / pole, 1.0});
}

template <class Number, class Gain>
LinearControllerOf<Number> linear(const TransferFunctionController& function, const Gain& gain,
                                  const Number& scale) {
  LinearControllerOf<Number> result = canonical_form<Number>(
      scaled<Number>(scale * gain(function.gain), of_each(function.numerator, gain)),
      of_each(function.denominator, gain));
  result.is_of_samples = function.is_sampled;
  return result;
}

/// Columns for r, y and v, from a single column for the error.
template <class Gain>
auto row_of_three_inputs(const std::vector<double>& row, const Gain& gain) {
  auto result = of_each(row, gain);
  if (row.size() == 1) result = {result[0], -result[0], 0.0};
  return result;
}

template <class Number, class Gain>
LinearControllerOf<Number> linear(const StateSpaceController& system, const Gain& gain,
                                  const Number& scale) {
  const Number factor = scale * gain(system.gain);
  LinearControllerOf<Number> result;
  result.state_matrix =
      of_each(system.A, [&](const std::vector<double>& row) { return of_each(row, gain); });
  result.input_matrix = of_each(
      system.B, [&](const std::vector<double>& row) { return row_of_three_inputs(row, gain); });
  result.output = scaled<Number>(factor, of_each(system.C, gain));
  result.direct = scaled<Number>(factor, row_of_three_inputs(system.D, gain));
  return result;
}

/// On the signs that an ErrorShape gives.
template <class Number, class Gain>
LinearControllerOf<Number> linear(const RelayController& relay, const Gain& gain,
                                  const Number& scale) {
  return proportional<Number>(scale * gain(relay.level), 0.0);
}

}  // namespace gearlash::drive::forms
