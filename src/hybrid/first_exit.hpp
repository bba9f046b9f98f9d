// Where a polynomial first turns negative, to within what is known of it.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

namespace gearlash::hybrid {

struct FirstExit {
  std::optional<double> at;     ///< in [0, 1]: the polynomial is negative just after it
  std::optional<double> touch;  ///< before it, the first place where it is 0 to within
                                ///< `uncertainty` and goes on not negative; 1 where it comes down
                                ///< to 0 there, and what follows says whether it touches
};

/// Of p(τ) = Σ coefficients[k] τᵏ, which stands for a function that it is within `uncertainty` of,
/// on [0, 1]; p is not below −uncertainty at 0. An exit is where the function is certain to have
/// turned negative soon after: p falls below −uncertainty. Three stages, each for what the one
/// before leaves open:
///   exclusion    partial sums of the coefficients, a mean of which p is, above `uncertainty`;
///   isolation    Bernstein's coefficients enclose p, and their changes of sign are at least the
///                number of its zeros (Descartes' rule; Farouki & Rajan 1987); where there is more
///                than one change the interval is halved, the left half first;
///   refinement   on an interval with one change, from where Bernstein's polygon falls, by Newton's
///                method; where that does not converge at once, by TOMS 748 (Alefeld, Potra & Shi
///                1995).
/// In exact arithmetic, missed are only excursions that p makes to less than `uncertainty` below 0,
/// and negligible_share of it: those are touches. Rounding in these stages is to be part of
/// `uncertainty`.
FirstExit first_exit(std::span<const double> coefficients, double uncertainty);

/// Of `uncertainty`: last terms that are less, all together, are left out.
inline constexpr double negligible_share = 0x1p-6;

inline constexpr std::size_t most_leading = 12;

/// What the leading terms of a polynomial tell of its first exit.
struct RoughExit {
  std::optional<double> at;  ///< nothing where there is none
  double within = 0.0;       ///< the exit is no farther from it
};

/// Of p, a polynomial of order `last`, on [0, 1], by at most `most_leading` leading terms q.
/// Precondition: |p − q| and what is unknown of p are together less than `rest`, as a sum of terms.
/// Nothing where q cannot tell. No exit where q's Bernstein coefficients are all above `rest`. One
/// exit where they fall from above `rest` to below −`rest`, once, and q is steep enough beside its
/// curvature: with |q(r)| ≤ rest = E, slopes below −D at r, and M ≥ |p″|, |q″|, both fall all the
/// way from r − 8E/D to r + 8E/D where 16 E M ≤ D²; p is beyond ±2E there, and q beyond ±E, which
/// by its coefficients it passes through only once: p has no other zero.
std::optional<RoughExit> rough_exit(std::span<const double> leading, double rest, int last);

}  // namespace gearlash::hybrid
