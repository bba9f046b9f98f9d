// Vectors and matrices of intervals, and the flow of a linear equation over a time.
#pragma once

#include <cstddef>
#include <vector>

#include "base/interval.hpp"
#include "numeric/vector_algebra.hpp"

namespace gearlash {

using IntervalVector = std::vector<Interval>;

/// Square, by rows.
struct IntervalMatrix {
  std::vector<IntervalVector> rows;

  explicit IntervalMatrix(std::size_t size) : rows(size, IntervalVector(size, Interval(0.0))) {}
  std::size_t size() const { return rows.size(); }
};

IntervalVector times(const IntervalMatrix& matrix, const IntervalVector& column);
IntervalVector times(const IntervalVector& row, const IntervalMatrix& matrix);
IntervalMatrix times(const IntervalMatrix& left, const IntervalMatrix& right);

/// x′ = A x + Σ inputᵢ uᵢ with constant u, over a time: x⁺ = flow x + Σ of_inputᵢ uᵢ.
struct LinearPassage {
  IntervalMatrix flow;                    ///< e^{A t}
  std::vector<IntervalVector> of_inputs;  ///< ∫e^{A s} ds inputᵢ
};
/// Contains the passage over every time within the interval, by Taylor's series of e^{A t/2ᵏ},
/// whose remainder is bounded, and squaring. Precondition: the times are not negative.
LinearPassage passage(const IntervalMatrix& matrix, const std::vector<IntervalVector>& inputs,
                      const Interval& time);

}  // namespace gearlash
