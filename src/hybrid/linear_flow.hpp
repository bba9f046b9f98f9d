// A linear flow, prepared for Taylor steps.
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "hybrid/hybrid_system.hpp"

namespace gearlash::hybrid {

/// For a sum of some products, as a share of the largest of them.
inline constexpr double product_rounding = 4.0 * std::numeric_limits<double>::epsilon();
/// Rounding of a sum of products, as a share of the sum of their magnitudes.
inline constexpr double sum_rounding = 16.0 * std::numeric_limits<double>::epsilon();

/// The order at which a series with this rate (length times rate) is truncated:
///   Σ_{j>k} |x₍ⱼ₎| ≤ |x₍₁₎| rates^k/(k + 1)! / (1 − rates/(k + 2)) ≤ left_out |x₍₁₎|.
/// Magnitudes are weighted. What one velocity does to one number is left out by no larger share,
/// however far apart the weights of the two are: around a loop of numbers they cancel.
/// Precondition: rates ≤ longest_in_rates.
int order_for(double rates);
inline constexpr double left_out = 0x1p-62;
/// A step times the rate. Cancellation between terms is then below e².
inline constexpr double longest_in_rates = 2.0;

/// The velocity of the moving numbers at a state.
struct Velocity {
  std::vector<double> values;
  std::vector<double> noise;  ///< uncertainty of each by rounding
  std::vector<double> sizes;  ///< an upper bound: |value| and all possible rounding
};

/// x′ = A x + b, which follows only the numbers that move. Weights w_i (powers of 2) make the rate,
/// max_i Σ_j |A_ij| w_j/w_i, small: numbers of unlike units count alike (Osborne 1960). A number
/// that only follows from others, as a position from a speed, counts by how far those take it in
/// their own time.
class LinearFlow {
 public:
  explicit LinearFlow(const AffineFlow& flow);

  int count() const { return static_cast<int>(numbers_.size()); }  ///< of numbers that move
  int number(int moving) const { return numbers_[static_cast<std::size_t>(moving)]; }
  double rate() const { return rate_; }
  double longest_step() const { return longest_step_; }
  /// If no number acts on itself, even through others, the motion is a polynomial of time: its
  /// order; else 0. The rate is then 0, and a step may be arbitrarily long.
  int polynomial_order() const { return polynomial_order_; }
  /// Order of a series over a time.
  int order(double length) const {
    return polynomial_order_ > 0 ? polynomial_order_ : order_for(length * rate_);
  }
  double weight(int moving) const { return weights_[static_cast<std::size_t>(moving)]; }

  void velocity_at(const double* state, const double* noise, Velocity& velocity) const;
  /// The same for `values` alone.
  void velocity_at(const double* state, Velocity& velocity) const;

  /// Length of a step from a state where the motion is a polynomial: four times the time until any
  /// two of its terms are equal, so that it suits the motion whatever the units.
  double natural_step(const double* state, const Velocity& velocity,
                      std::vector<double>& scratch) const;

  /// Adds the series to the state of all numbers, by x₍ₖ₊₁₎ = h/(k+1) A x₍ₖ₎. `scratch` is
  /// overwritten. Precondition: |length| ≤ longest_step().
  void advance(const Velocity& velocity, double length, double* state,
               std::vector<double>& scratch) const;
  /// Adds Σ|x₍ₖ₎| to each number.
  void add_sizes(const Velocity& velocity, double length, double* sizes,
                 std::vector<double>& scratch) const;

  /// The moving numbers that act on a number, directly or through others.
  std::vector<std::size_t> acting() const;
  /// result = factor Aᵀ row, for moving numbers; with |A| if `sizes`.
  void times_transposed(const double* row, double factor, bool sizes, double* result) const;

 private:
  struct Entry {
    int column;
    double factor;
  };
  /// next = length/order A here.
  void next_term(const double* here, double length, int order, double* next) const;
  void find_moving(const AffineFlow& flow);
  std::vector<std::vector<bool>> reaches() const;
  void weigh();
  template <class Counts>
  double sum_of_row(std::size_t row, const Counts& counts) const;
  void weigh_within_loops(const std::vector<std::vector<bool>>& reached);
  void weigh_between_loops(const std::vector<std::vector<bool>>& reached, double fastest);

  std::vector<int> numbers_;
  std::vector<Entry> velocity_entries_;     ///< of A, columns among all numbers
  std::vector<Entry> entries_;              ///< of A, columns among those that move
  std::vector<std::size_t> velocity_rows_;  ///< where each row's entries begin, and their end
  std::vector<std::size_t> rows_;
  std::vector<double> offsets_;
  std::vector<double> weights_;
  double rate_ = 0.0;
  double longest_step_ = std::numeric_limits<double>::max();
  int polynomial_order_ = 0;
};

/// The state after a step, from a table made once for the longest one, h:
///   x(s h) − x(0) = s h v + Σ_{k≥2} s^k Tₖ v,   Tₖ = A^{k−1} h^k/k!,
/// with v the velocity, by Horner's scheme. The table pays if few numbers move.
class Stride {
 public:
  Stride(const LinearFlow& flow, double longest);

  /// As those of LinearFlow.
  void advance(const LinearFlow& flow, const Velocity& velocity, double length,
               double* state) const;
  /// Over the longest step, and no less if sizes are upper bounds.
  void add_sizes(const LinearFlow& flow, const Velocity& velocity, double* sizes) const;

 private:
  static constexpr std::size_t lanes = 4;
  using Rows = Eigen::Array<double, lanes, 1>;  ///< `lanes` rows of a column

  double length_;
  std::size_t orders_;
  std::vector<std::size_t> acting_;  ///< the columns in which Tₖ is not 0
  std::vector<Rows> terms_;  ///< of Tₖ, by blocks of rows, then by orders, then by acting columns
  std::vector<Rows> change_;  ///< Σ Tₖ, by blocks of rows, then by columns
  std::vector<Rows> sizes_;   ///< Σ |Tₖ|, likewise
};

}  // namespace gearlash::hybrid
