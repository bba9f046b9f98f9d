// Polynomials with interval coefficients: products, and a proof that they are positive.
#pragma once

#include <vector>

#include "base/interval.hpp"

namespace gearlash {

/// By ascending powers.
using IntervalPolynomial = std::vector<Interval>;

IntervalPolynomial sum(const IntervalPolynomial& a, const IntervalPolynomial& b);
IntervalPolynomial product(const IntervalPolynomial& a, const IntervalPolynomial& b);

/// The real part on the imaginary axis of p(s), as a polynomial of ω², s = jω.
IntervalPolynomial real_part(const IntervalPolynomial& polynomial);

/// Whether every polynomial within the intervals is positive for all x > 0. Factors x are taken
/// out. Bernstein coefficients of x = scale t/(1 − t), by bisection; false where the intervals or
/// the depth of bisection leave it open.
bool is_positive(IntervalPolynomial polynomial);

}  // namespace gearlash
