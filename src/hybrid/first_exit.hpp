// Finds where a polynomial first turns negative, to within its uncertainty.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

namespace gearlash::hybrid {

struct FirstExit {
  std::optional<double> at;     ///< in [0, 1]: the polynomial is negative just after it
  std::optional<double> touch;  ///< the first place before it where the polynomial is 0 to within
                                ///< `uncertainty` and stays not negative; 1 if it comes down to 0
                                ///< there, and the next step decides whether it touches
};

/// For p(τ) = Σ coefficients[k] τᵏ on [0, 1], which represents a function to within `uncertainty`.
/// p is not below −uncertainty at 0. An exit is a place after which the function is certain to turn
/// negative soon: p falls below −uncertainty, or comes so near to it that rounding and
/// negligible_share hide the difference. There are three stages, each for what the one before
/// leaves open:
///   exclusion    p is a mean of partial sums of the coefficients; all are above `uncertainty`;
///   isolation    Bernstein's coefficients enclose p, and their changes of sign are at least the
///                number of its zeros (Descartes' rule; Farouki & Rajan 1987); with more than one
///                change the interval is halved, the left half first;
///   refinement   on an interval with one change, from where Bernstein's polygon falls, by Newton's
///                method; if that does not converge at once, by TOMS 748 (Alefeld, Potra & Shi
///                1995).
/// In exact arithmetic the only missed excursions of p go less than `uncertainty` (and
/// negligible_share of it) below 0. They are touches. `uncertainty` must include the rounding in
/// these stages.
FirstExit first_exit(std::span<const double> coefficients, double uncertainty);

/// Last terms whose sum is below this share of `uncertainty` are left out.
inline constexpr double negligible_share = 0x1p-6;

inline constexpr std::size_t most_leading = 12;

/// What the leading terms of a polynomial show about its first exit.
struct RoughExit {
  std::optional<double> at;  ///< empty if there is none
  double within = 0.0;       ///< bound of the exit's distance from it
};

/// For p, a polynomial of order `last`, on [0, 1], by at most `most_leading` leading terms q.
/// Precondition: |p − q| and the uncertainty of p are together less than `rest`, as a sum of terms.
/// Empty if q does not decide. No exit if q's Bernstein coefficients are all above `rest`. One exit
/// if they fall from above `rest` to below −`rest`, once, and q is steep enough for its curvature.
/// With |q(r)| ≤ rest = E, slopes below −D at r, and M ≥ |p″|, |q″|, both fall all the way from r −
/// 8E/D to r + 8E/D if 16 E M ≤ D². There p passes ±2E, and q ±E. By its coefficients q passes
/// through ±E only once, so p has no other zero.
std::optional<RoughExit> rough_exit(std::span<const double> leading, double rest, int last);

}  // namespace gearlash::hybrid
