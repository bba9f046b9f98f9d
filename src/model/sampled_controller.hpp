// Controllers from sample to sample, for any numbers: doubles, intervals.
#pragma once

#include <type_traits>
#include <vector>

#include "model/controller.hpp"
#include "numeric/elimination.hpp"
#include "numeric/linear_algebra.hpp"

namespace gearlash::drive::forms {

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
LinearControllerOf<Number> sampled(const LinearControllerOf<Number>& given, const Number& period,
                                   Discretization method) {
  const std::size_t order = given.order();
  if (given.is_of_samples || order == 0) return given;
  const double share = share_of_end(method);
  const auto size = static_cast<Eigen::Index>(order);
  const MatrixOf<Number> dynamics = matrix_of(given.state_matrix, order);
  const MatrixOf<Number> input = matrix_of(given.input_matrix, 3);
  const MatrixOf<Number> identity = MatrixOf<Number>::Identity(size, size);
  const Number at_end = share * period;
  const Number at_start = (1.0 - share) * period;
  const MatrixOf<Number> solved = inverse_of<Number>(identity - at_end * dynamics);
  const VectorOf<Number> output = product(solved.transpose(), vector_of(given.output));
  LinearControllerOf<Number> result{.is_of_samples = true};
  const MatrixOf<Number> start = identity + at_start * dynamics;
  result.state_matrix = rows_of<Number>(product(solved, start));
  result.input_matrix = rows_of<Number>(product(period * solved, input));
  result.output = entries_of<Number>(output);
  result.direct =
      entries_of<Number>(vector_of(given.direct) + product(at_end * input.transpose(), output));
  if (!given.anti_windup.empty()) {
    result.anti_windup = entries_of<Number>(product(period * solved, vector_of(given.anti_windup)));
  }
  if (knows_error_alone(given)) {
    make_difference(result.direct);
    for (std::vector<Number>& row : result.input_matrix) make_difference(row);
  }
  return result;
}

}  // namespace gearlash::drive::forms
