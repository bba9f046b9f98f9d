// The flow of a mode, made ready for Taylor steps.
#pragma once

#include <optional>
#include <vector>

#include "gearlash/hybrid/hybrid_system.hpp"

namespace gearlash::hybrid {

/// x(t₀ + τh) = Σ term(k) τᵏ for τ from 0 to 1, to within `remainder`.
class Series {
 public:
  int order() const { return order_; }
  double length() const { return length_; }
  /// Proved, but for rounding: |x_i − Σ| ≤ remainder · weight_i of the flow.
  double remainder() const { return remainder_; }
  const double* term(int k) const { return &terms_[static_cast<std::size_t>(k * size_)]; }
  /// What rounding may add to each number of term(k), to first order.
  const double* rounding(int k) const { return &rounding_[static_cast<std::size_t>(k * size_)]; }
  Vector at(double share) const;
  /// Σ_k |term(k)_i|: what rounding is a share of.
  Vector magnitude() const;

 private:
  friend class LinearFlow;
  int size_ = 0;
  int order_ = 0;
  double length_ = 0.0;
  double remainder_ = 0.0;
  std::vector<double> terms_;
  std::vector<double> rounding_;
};

/// x′ = A x + b, in weights w_i (powers of 2) that make the norm of A, max_i Σ_j |A_ij| w_j/w_i,
/// small: numbers of unlike units count alike (Osborne 1960).
class LinearFlow {
 public:
  explicit LinearFlow(const AffineFlow& flow);

  /// As long a step as one series may make.
  double longest_step() const { return longest_step_; }
  double rate() const { return norm_; }
  double weight(int number) const { return weights_[static_cast<std::size_t>(number)]; }
  Vector velocity(const Vector& state) const { return matrix_ * state + offset_; }

  /// By x₍ₖ₊₁₎ = h/(k+1) A x₍ₖ₎ until what is left out,
  ///   Σ_{j>k} |x₍ⱼ₎| ≤ |x₍ₖ₎| q/(1 − q),  q = h‖A‖/(k + 1),
  /// is below rounding. `noise` is how well each number of the state is known.
  /// Precondition: 0 ≤ length ≤ longest_step().
  void expand(const Vector& state, const Vector& noise, double length, Series& series) const;

 private:
  void balance();
  double weighted_norm(const double* vector) const;

  int size_;
  Matrix matrix_;
  Matrix sizes_;  ///< |A|
  Vector offset_;
  std::vector<double> weights_;
  double norm_ = 0.0;
  double longest_step_ = 0.0;
};

/// A flow with its fast decays split off, where there are some: A = A P + A (I − P), P the spectral
/// projector on the fast ones. Once P x has come to its rest, to rounding, it stays there, and
///   x′ = A (I − P) x + (I − P) b,
/// whose steps are as long as the slow ones permit.
class PreparedFlow {
 public:
  explicit PreparedFlow(const AffineFlow& flow);

  const LinearFlow& whole() const { return whole_; }
  /// The one to go on with from a state.
  const LinearFlow& from(const Vector& state) const;
  /// A state that one of them has come to: what is at rest is put there, so that rounding of the
  /// slow flow, a share of ‖A‖, does not add up.
  Vector corrected(const LinearFlow& flow, const Vector& state) const;

 private:
  struct Split {
    LinearFlow slow;
    Matrix projector;  ///< P
    Vector rest;       ///< of P x
  };
  static std::optional<Split> split(const AffineFlow& flow);

  LinearFlow whole_;
  std::optional<Split> split_;
};

}  // namespace gearlash::hybrid
