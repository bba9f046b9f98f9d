// A polytope of few dimensions, and the range of a linear form over it.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "base/extent.hpp"

namespace gearlash {

/// All x with the constraints that are added. Each holds to a share of 1e-9 of its terms.
class Polytope {
 public:
  explicit Polytope(Eigen::Index dimensions) : dimensions_(dimensions) {}

  /// normal · x = value. Returns itself.
  Polytope& equal(const Eigen::VectorXd& normal, double value);
  /// low ≤ normal · x ≤ high; either may be infinite. Returns itself.
  Polytope& between(const Eigen::VectorXd& normal, double low, double high);

  /// Of form · x, by the vertices: every choice of as many constraints as there are dimensions.
  /// Empty if nothing meets all constraints. Precondition: the polytope is bounded.
  std::optional<Extent> range_of(const Eigen::VectorXd& form) const;

 private:
  struct Side {
    Eigen::VectorXd normal;
    double value;  ///< normal · x = value, or at most that
  };
  bool contains(const Eigen::VectorXd& point) const;

  Eigen::Index dimensions_;
  std::vector<Side> equalities_;
  std::vector<Side> inequalities_;
};

}  // namespace gearlash
