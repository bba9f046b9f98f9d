// Affine forms over the numbers that they contain, and as polynomials over a step.
#pragma once

#include <vector>

#include "hybrid/linear_flow.hpp"

namespace gearlash::hybrid {

/// An affine form as a sum over the numbers that it contains.
struct SparseForm {
  struct Term {
    int number;
    double factor;
  };
  std::vector<Term> terms;
  double offset = 0.0;

  explicit SparseForm(const AffineForm& form);
  double at(const double* state) const;
  double size_at(const double* state) const;  ///< sum of the magnitudes of its terms
  /// Bound of the rounding in at(), with `noise` the uncertainty of each number.
  double noise_at(const double* state, const double* noise) const;
};

/// A form g as a polynomial over a step of share s of the flow's longest one (of a time unit if the
/// motion is a polynomial), at τ from 0 to 1:
///   g(τ) = g₀ + Σ_k (s τ)^k rowₖ·v,   rowₖ = cᵀ A^{k−1} h^k/k!
/// with v the velocity. Rounding adds to a coefficient at most some multiples of epsilon of
///   |c|ᵀ |A|^{k−1} h^k/k! |v|.
class GuardTable {
 public:
  GuardTable(const LinearFlow& flow, const SparseForm& form);

  /// Largest possible distance of g from g₀, rounding included.
  double reach(const Velocity& velocity, double share) const;
  /// Bound of the rounding in all coefficients from order `first` ≥ 1 to `last`.
  double uncertainty(const Velocity& velocity, double share, int first, int last) const;
  /// A cheap upper bound of that to the highest order. It is far too high if the share is small and
  /// high orders are uncertain.
  double bound_of_uncertainty(const Velocity& velocity, double share, int first) const;
  /// An upper bound of all coefficients beyond the first few orders, `few_orders`.
  double beyond_few(const Velocity& velocity, double share) const;
  int few_orders() const { return static_cast<int>(few_); }
  /// Bound of the rounding in the coefficient of an order.
  double uncertainty_of(const Velocity& velocity, double share, int order) const;
  /// Writes orders 1 to `last` to coefficients[1], …, which must have room for three more.
  void coefficients(const Velocity& velocity, double share, int last, double* coefficients) const;
  /// The zero of g₀ + … of order 4 near the start, by Newton's method, as a time.
  double time_to_zero(double value, const Velocity& velocity) const;
  /// |c|·weights: for a remainder.
  double weight() const { return weight_; }

 private:
  std::size_t count_;
  /// Σ s^k sizesₖ·v over orders: for a polynomial motion, whose share has no meaning by itself.
  double sizes_from(const Velocity& velocity, double share, std::size_t first) const;

  bool is_polynomial_;
  double length_;  ///< of the longest step
  std::size_t orders_;
  std::size_t room_;           ///< orders rounded up to a multiple of four
  std::vector<double> rows_;   ///< by velocities, then by orders
  std::vector<double> sizes_;  ///< likewise
  std::size_t few_;
  std::vector<double> reach_;        ///< Σ of sizes, by velocities
  std::vector<double> beyond_;       ///< likewise, beyond the first few orders
  std::vector<std::size_t> acting_;  ///< the velocities that are in it
  double weight_ = 0.0;
};

}  // namespace gearlash::hybrid
