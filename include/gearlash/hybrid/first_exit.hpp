// Where a polynomial first turns negative: no crossing is stepped over.
#pragma once

#include <optional>
#include <span>

namespace gearlash::hybrid {

struct FirstExit {
  std::optional<double> at;     ///< in [0, 1]: the polynomial is negative just after it
  std::optional<double> touch;  ///< before it, the first place where it is 0 to within
                                ///< `uncertainty` and goes on not negative
};

/// Of p(τ) = Σ coefficients[k] τᵏ, which stands for a function that it is within `uncertainty` of,
/// on [0, 1]; p is not below −uncertainty at 0. An exit is where the function is certain to have
/// turned negative soon after: p falls below −uncertainty. Three stages, each for what the one
/// before leaves open:
///   exclusion    p(0) − Σ max(0, −coefficients[k]) ≥ −uncertainty;
///   isolation    Bernstein's coefficients enclose p, and their changes of sign are at least the
///                number of its zeros (Descartes' rule; Farouki & Rajan 1987); where there is more
///                than one change the interval is halved, the left half first;
///   refinement   on an interval with one change, from where Bernstein's polygon falls, by Newton's
///                method; where that does not converge at once, by TOMS 748 (Alefeld, Potra & Shi
///                1995).
/// Missed are only excursions that p makes to less than `uncertainty` below 0: those are touches.
FirstExit first_exit(std::span<const double> coefficients, double uncertainty);

/// Whether p is certain to be above `uncertainty` on [0, 1]: its Bernstein coefficients are.
bool stays_positive(std::span<const double> coefficients, double uncertainty);

}  // namespace gearlash::hybrid
