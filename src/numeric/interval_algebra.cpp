#include "numeric/interval_algebra.hpp"

#include <algorithm>
#include <cmath>

#include "base/lists.hpp"

namespace gearlash {
namespace {

constexpr int terms = 20;             ///< of the series
constexpr double longest_step = 0.5;  ///< ‖A t/2ᵏ‖: the rest of the series is 0.5²⁰/20! = 4e-25

/// ≥ the largest sum of the sizes in a row.
double norm(const IntervalMatrix& matrix) {
  Interval largest = 0.0;
  for (const IntervalVector& row : matrix.rows) {
    Interval sum = 0.0;
    for (const Interval& entry : row) sum = sum + abs(entry);
    largest = max(largest, sum);
  }
  return largest.high;
}

IntervalMatrix scaled(const Interval& factor, IntervalMatrix matrix) {
  for (IntervalVector& row : matrix.rows) row = scaled(factor, std::move(row));
  return matrix;
}

/// Σ matrixᵏ/k!, with the rest of the series in every entry.
IntervalMatrix exponential_series(const IntervalMatrix& matrix) {
  IntervalMatrix result(matrix.size());
  for (std::size_t i = 0; i < matrix.size(); ++i) result.rows[i][i] = 1.0;
  IntervalMatrix term = result;
  Interval rest = 1.0;  // ≥ the norm of the first term that is left out
  const Interval size = norm(matrix);
  for (int k = 1; k <= terms; ++k) {
    const Interval share = 1.0 / Interval(static_cast<double>(k));
    rest = rest * size * share;
    if (k == terms) break;
    term = scaled(share, times(term, matrix));
    for (std::size_t i = 0; i < matrix.size(); ++i) {
      result.rows[i] = added(std::move(result.rows[i]), term.rows[i]);
    }
  }
  const double left_out = (2.0 * rest).high;  // ‖matrix‖ ≤ 1/2: a geometric series
  for (IntervalVector& row : result.rows) {
    for (Interval& entry : row) entry = entry + Interval(-left_out, left_out);
  }
  return result;
}

}  // namespace

IntervalVector times(const IntervalMatrix& matrix, const IntervalVector& column) {
  return of_each(matrix.rows, [&](const IntervalVector& row) { return dot(row, column); });
}

IntervalVector times(const IntervalVector& row, const IntervalMatrix& matrix) {
  IntervalVector result(row.size(), Interval(0.0));
  for (std::size_t k = 0; k < row.size(); ++k) {
    for (std::size_t j = 0; j < row.size(); ++j) {
      result[j] = result[j] + row[k] * matrix.rows[k][j];
    }
  }
  return result;
}

IntervalMatrix times(const IntervalMatrix& left, const IntervalMatrix& right) {
  IntervalMatrix result(left.size());
  for (std::size_t i = 0; i < left.size(); ++i) {
    result.rows[i] = times(left.rows[i], right);
  }
  return result;
}

/// The inputs are states that do not change.
LinearPassage passage(const IntervalMatrix& matrix, const std::vector<IntervalVector>& inputs,
                      const Interval& time) {
  const std::size_t size = matrix.size();
  IntervalMatrix whole(size + inputs.size());
  for (std::size_t i = 0; i < size; ++i) {
    for (std::size_t j = 0; j < size; ++j) whole.rows[i][j] = time * matrix.rows[i][j];
    for (std::size_t j = 0; j < inputs.size(); ++j) whole.rows[i][size + j] = time * inputs[j][i];
  }
  int halvings = 0;
  constexpr int most_halvings = 1000;
  for (double step = norm(whole); step > longest_step && halvings < most_halvings; step *= 0.5) {
    ++halvings;
  }
  IntervalMatrix flow = exponential_series(scaled(std::ldexp(1.0, -halvings), std::move(whole)));
  for (int i = 0; i < halvings; ++i) flow = times(flow, flow);
  LinearPassage result{IntervalMatrix(size), {}};
  for (std::size_t i = 0; i < size; ++i) {
    std::copy_n(flow.rows[i].begin(), size, result.flow.rows[i].begin());
  }
  for (std::size_t j = 0; j < inputs.size(); ++j) {
    IntervalVector& of_input = result.of_inputs.emplace_back();
    for (std::size_t i = 0; i < size; ++i) of_input.push_back(flow.rows[i][size + j]);
  }
  return result;
}

}  // namespace gearlash
