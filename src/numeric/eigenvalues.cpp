#include <Eigen/Eigenvalues>
#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "numeric/linear_algebra.hpp"

namespace gearlash {
namespace {

using Solver = Eigen::EigenSolver<Eigen::MatrixXd>;

/// Those of a solver that failed are memory that it has not written.
Eigen::VectorXcd values_of(const Solver& solver, Eigen::Index size) {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  if (solver.info() != Eigen::Success) return Eigen::VectorXcd::Constant(size, unknown);
  return solver.eigenvalues();
}

}  // namespace

Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& matrix) {
  constexpr bool with_vectors = false;
  return values_of(Solver(matrix, with_vectors), matrix.rows());
}

Eigensystem eigensystem(const Eigen::MatrixXd& matrix) {
  const Solver solver(matrix);
  Eigen::VectorXcd values = values_of(solver, matrix.rows());
  if (solver.info() == Eigen::Success) return {std::move(values), solver.eigenvectors()};
  return {values, values.replicate(1, matrix.cols())};
}

Eigensystem sorted_eigensystem(const Eigen::MatrixXd& matrix) {
  const auto [values, vectors] = eigensystem(matrix);
  std::vector<Eigen::Index> order(static_cast<std::size_t>(values.size()));
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  std::stable_sort(order.begin(), order.end(), [&values = values](Eigen::Index a, Eigen::Index b) {
    return std::abs(values[a]) > std::abs(values[b]);
  });
  return {values(order), vectors(Eigen::all, order)};
}

Eigen::Vector3cd eigenvalues(const Eigen::Matrix3d& matrix) {
  return eigenvalues(Eigen::MatrixXd(matrix));  // the same bits in half the compile time
}

}  // namespace gearlash
