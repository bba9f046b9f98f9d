#include "numeric/polytope.hpp"

#include <algorithm>
#include <cmath>

#include "base/lists.hpp"
#include "numeric/linear_algebra.hpp"

namespace gearlash {

Polytope& Polytope::equal(const Eigen::VectorXd& normal, double value) {
  equalities_.push_back({normal, value});
  return *this;
}

Polytope& Polytope::between(const Eigen::VectorXd& normal, double low, double high) {
  if (std::isfinite(high)) inequalities_.push_back({normal, high});
  if (std::isfinite(low)) inequalities_.push_back({-normal, -low});
  return *this;
}

bool Polytope::contains(const Eigen::VectorXd& point) const {
  constexpr double tolerance = 1e-9;
  const auto excess = [&](const Side& side) {
    const double terms = side.normal.cwiseAbs().dot(point.cwiseAbs()) + std::abs(side.value);
    return terms == 0.0 ? 0.0 : (side.normal.dot(point) - side.value) / terms;
  };
  return all_of(equalities_,
                [&](const Side& side) { return std::abs(excess(side)) <= tolerance; }) &&
         all_of(inequalities_, [&](const Side& side) { return excess(side) <= tolerance; });
}

std::optional<Extent> Polytope::range_of(const Eigen::VectorXd& form) const {
  const auto fixed = static_cast<Eigen::Index>(equalities_.size());
  const std::size_t chosen =
      static_cast<std::size_t>(std::max<Eigen::Index>(0, dimensions_ - fixed));
  if (chosen > inequalities_.size()) return std::nullopt;
  Eigen::MatrixXd normals(fixed + static_cast<Eigen::Index>(chosen), dimensions_);
  Eigen::VectorXd values(normals.rows());
  const auto put = [&](Eigen::Index row, const Side& side) {
    const double size = side.normal.cwiseAbs().maxCoeff();
    normals.row(row) = side.normal.transpose() / size;
    values[row] = side.value / size;
  };
  for (Eigen::Index i = 0; i < fixed; ++i) put(i, equalities_[static_cast<std::size_t>(i)]);
  std::vector<bool> is_active(inequalities_.size(), false);
  std::fill(is_active.begin(), is_active.begin() + static_cast<std::ptrdiff_t>(chosen), true);
  Extent range;
  do {
    Eigen::Index row = fixed;
    for (std::size_t i = 0; i < is_active.size(); ++i) {
      if (is_active[i]) put(row++, inequalities_[i]);
    }
    const Eigen::VectorXd vertex = solved_with_full_pivoting(normals, values);
    if (vertex.allFinite() && contains(vertex)) range.include(form.dot(vertex));
  } while (std::prev_permutation(is_active.begin(), is_active.end()));
  return range.low <= range.high ? std::optional(range) : std::nullopt;
}

}  // namespace gearlash
