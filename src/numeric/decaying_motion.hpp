// Linear motion that is proved to decay, and proved bounds of its answer to bounded inputs.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "numeric/interval_matrix.hpp"

namespace gearlash {

enum class TimeKind {
  continuous,  ///< x′ = A x
  stepwise     ///< x⁺ = x + A x
};

/// Motion by any A within an interval matrix. All bounds hold for every such A, rounding included.
///
/// Method. A change of coordinates x = S ξ makes A nearly block diagonal, one block for each time
/// scale, and each block Â a contraction (by a Lyapunov function, proved by an interval Cholesky
/// decomposition). The rest, S⁻¹AS − Â, is enclosed by an approximate inverse of S, and its effect
/// bounded by comparison with an M-matrix.
class DecayingMotion {
 public:
  /// Empty if it is not proved that all motions decay.
  static std::optional<DecayingMotion> of(const IntervalMatrix& flow, TimeKind kind);

  /// Encloses ∫₀^∞ |output e^{At} input| dt, or Σ |output (1 + A)ᵏ input|, k ≥ 0: the largest
  /// |output x| that inputs |u| ≤ 1 can cause in x′ = A x + input u, or x⁺ = x + A x + input u. Its
  /// upper end is 0.01 % above the exact value unless the data are wide or the motion swings ten
  /// thousand times before it decays.
  Interval impulse_norm(const IntervalVector& input, const IntervalVector& output) const;
  /// The same for several outputs, which takes little longer than for one.
  std::vector<Interval> impulse_norms(const IntervalVector& input,
                                      const std::vector<IntervalVector>& outputs) const;

 private:
  struct Block {
    Eigen::Index first = 0;
    Eigen::MatrixXd flow;
    double size = 0.0;  ///< ≥ ‖flow‖
    double rate = 0.0;  ///< ‖e^{flow t}‖ ≤ e^{−rate t}, or ‖1 + flow‖ ≤ 1 − rate
  };
  explicit DecayingMotion(TimeKind kind) : kind_(kind) {}
  Eigen::Index end_of(const Block& block) const { return block.first + block.flow.rows(); }
  bool choose_basis(const Eigen::MatrixXd& flow);
  bool prove(const IntervalMatrix& flow);
  std::vector<double> norms(const IntervalVector& numbers) const;
  std::optional<std::vector<double>> integrals(const std::vector<double>& sources) const;

  TimeKind kind_;
  std::vector<Block> blocks_;
  Eigen::MatrixXd basis_;    ///< S
  Eigen::MatrixXd inverse_;  ///< about S⁻¹
  double inverse_error_ = 0.0;  ///< ≥ ‖(S⁻¹ − inverse) S‖ in S⁻¹ = (1 − ·)⁻¹ inverse
  std::vector<std::vector<double>> couplings_;  ///< ≥ ‖S⁻¹AS − Â‖, by blocks
};

}  // namespace gearlash
