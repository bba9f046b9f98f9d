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

  /// An upper bound of all coefficients beyond an order, also of those that no table has. Each
  /// velocity counts by what it does to this form, not by the weights of the flow, which may be any
  /// distance apart where numbers hardly act on each other.
  double beyond(const Velocity& velocity, double share, int order) const;
  /// Largest possible distance of g from g₀, rounding included.
  double reach(const Velocity& velocity, double share) const { return beyond(velocity, share, 0); }
  /// Bound of the rounding in all coefficients from order `first` ≥ 1 to `last`.
  double uncertainty(const Velocity& velocity, double share, int first, int last) const;
  /// A cheap upper bound of that to the highest order. It is far too high if the share is small and
  /// high orders are uncertain.
  double bound_of_uncertainty(const Velocity& velocity, double share, int first) const;
  int few_orders() const { return static_cast<int>(few_); }  ///< as many as a rough answer uses
  /// Bound of the rounding in the coefficient of an order.
  double uncertainty_of(const Velocity& velocity, double share, int order) const;
  /// Writes orders 1 to `last` to coefficients[1], …, which must have room for three more.
  void coefficients(const Velocity& velocity, double share, int last, double* coefficients) const;
  /// The zero of g₀ + … of order 4 near the start, by Newton's method, as a time.
  double time_to_zero(double value, const Velocity& velocity) const;

 private:
  void add_up(const LinearFlow& flow, const std::vector<double>& sizes);
  std::vector<double> left_out_by(const LinearFlow& flow, std::vector<double> sizes) const;

  std::size_t count_;
  bool is_polynomial_;
  double length_;  ///< of the longest step
  std::size_t orders_;
  std::size_t room_;           ///< orders rounded up to a multiple of four
  std::vector<double> rows_;   ///< by velocities, then by orders
  std::vector<double> sizes_;  ///< likewise
  std::size_t few_;
  std::vector<double> beyond_;       ///< Σ of sizes beyond an order: by orders, then by velocities
  std::vector<std::size_t> acting_;  ///< the velocities that are in it
};

}  // namespace gearlash::hybrid
