// Matrices of intervals.
#pragma once

#include <vector>

#include "base/interval.hpp"
#include "numeric/elimination.hpp"

namespace gearlash {

using IntervalVector = std::vector<Interval>;
using IntervalMatrix = MatrixOf<Interval>;

inline Eigen::MatrixXd middle(const IntervalMatrix& matrix) {
  return matrix.unaryExpr([](const Interval& entry) { return middle(entry); });
}

/// Contains e^A of every A within, by Taylor's series of A/2ᵏ, whose remainder is bounded, and
/// squaring.
IntervalMatrix enclosed_exponential(const IntervalMatrix& matrix);

}  // namespace gearlash
