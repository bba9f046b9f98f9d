#include "numeric/interval_matrix.hpp"

#include <cmath>

namespace gearlash {
namespace {

constexpr int terms = 20;             ///< of the series
constexpr double longest_step = 0.5;  ///< ‖A/2ᵏ‖: the rest of the series is 0.5²⁰/20! = 4e-25

/// ≥ the largest sum of the sizes in a row.
double norm(const IntervalMatrix& matrix) {
  Interval largest = 0.0;
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    Interval sum = 0.0;
    for (const Interval& entry : matrix.row(i)) sum = sum + abs(entry);
    largest = max(largest, sum);
  }
  return largest.high;
}

/// Σ matrixᵏ/k!, with the rest of the series in every entry.
IntervalMatrix exponential_series(const IntervalMatrix& matrix) {
  IntervalMatrix result = IntervalMatrix::Identity(matrix.rows(), matrix.cols());
  IntervalMatrix term = result;
  Interval rest = 1.0;  // ≥ the norm of the first term that is left out
  const Interval size = norm(matrix);
  for (int k = 1; k <= terms; ++k) {
    const Interval share = 1.0 / Interval(static_cast<double>(k));
    rest = rest * size * share;
    if (k == terms) break;
    term = share * product(term, matrix);
    result = result + term;
  }
  const double left_out = (2.0 * rest).high;  // ‖matrix‖ ≤ 1/2: a geometric series
  const Interval more(-left_out, left_out);
  return result + IntervalMatrix::Constant(matrix.rows(), matrix.cols(), more);
}

}  // namespace

IntervalMatrix enclosed_exponential(const IntervalMatrix& matrix) {
  int halvings = 0;
  constexpr int most_halvings = 1000;
  for (double step = norm(matrix); step > longest_step && halvings < most_halvings; step *= 0.5) {
    ++halvings;
  }
  IntervalMatrix flow = exponential_series(Interval(std::ldexp(1.0, -halvings)) * matrix);
  for (int i = 0; i < halvings; ++i) flow = product(flow, flow);
  return flow;
}

}  // namespace gearlash
