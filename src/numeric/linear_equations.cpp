#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/QR>

#include "numeric/linear_algebra.hpp"

namespace gearlash {

Eigen::VectorXd solved(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& right) {
  return matrix.partialPivLu().solve(right);
}

Eigen::MatrixXcd solved(const Eigen::MatrixXcd& matrix, const Eigen::MatrixXcd& right) {
  return matrix.partialPivLu().solve(right);
}

Eigen::MatrixXd inverse(const Eigen::MatrixXd& matrix) { return matrix.partialPivLu().inverse(); }

Eigen::VectorXd solved_with_full_pivoting(const Eigen::MatrixXd& matrix,
                                          const Eigen::VectorXd& right) {
  return matrix.fullPivLu().solve(right);
}

std::optional<Solutions> all_solutions(const Eigen::MatrixXd& matrix,
                                       const Eigen::VectorXd& right) {
  const Eigen::Index columns = matrix.cols();
  if (matrix.rows() == 0) {
    return Solutions{Eigen::VectorXd::Zero(columns), Eigen::MatrixXd::Identity(columns, columns)};
  }
  const auto inverse_of = [](double size) { return size > 0.0 ? 1.0 / size : 1.0; };
  Eigen::MatrixXd scaled = matrix;
  Eigen::VectorXd wanted = right;
  Eigen::VectorXd unit(columns);
  for (Eigen::Index i = 0; i < columns; ++i) {
    unit[i] = inverse_of(scaled.col(i).cwiseAbs().maxCoeff());
    scaled.col(i) *= unit[i];
  }
  for (Eigen::Index i = 0; i < scaled.rows(); ++i) {
    const double factor = inverse_of(scaled.row(i).cwiseAbs().maxCoeff());
    scaled.row(i) *= factor;
    wanted[i] *= factor;
  }
  Eigen::FullPivLU<Eigen::MatrixXd> factors(scaled);
  const Eigen::VectorXd one = factors.solve(wanted);
  constexpr double tolerance = 1e-9;
  const Eigen::VectorXd terms = scaled.cwiseAbs() * one.cwiseAbs() + wanted.cwiseAbs();
  if (((scaled * one - wanted).array().abs() > tolerance * terms.array()).any()) {
    return std::nullopt;
  }
  const bool is_single = factors.dimensionOfKernel() == 0;
  return Solutions{unit.asDiagonal() * one,
                   is_single ? Eigen::MatrixXd(columns, 0)
                             : Eigen::MatrixXd(unit.asDiagonal() * factors.kernel())};
}

Eigen::MatrixXd orthonormal_basis(const Eigen::MatrixXd& columns) {
  return columns.householderQr().householderQ() *
         Eigen::MatrixXd::Identity(columns.rows(), columns.cols());
}

Eigen::MatrixXd complement(const Eigen::MatrixXd& columns) {
  const Eigen::Index rows = columns.rows();
  const Eigen::MatrixXd all =
      columns.householderQr().householderQ() * Eigen::MatrixXd::Identity(rows, rows);
  return all.rightCols(rows - columns.cols());
}

Eigen::MatrixXd cholesky_factor(const Eigen::MatrixXd& matrix) {
  const Eigen::LLT<Eigen::MatrixXd> decomposition(matrix);
  if (decomposition.info() != Eigen::Success) return {};
  return decomposition.matrixU();
}

// For three rows the functions for any size give the same bits with less to compile.

Eigen::Vector3d solved_with_full_pivoting(const Eigen::Matrix3d& matrix,
                                          const Eigen::Vector3d& right) {
  return solved_with_full_pivoting(Eigen::MatrixXd(matrix), Eigen::VectorXd(right));
}

double least_pivot(const Eigen::Matrix3d& matrix) {
  return Eigen::MatrixXd(matrix).fullPivLu().matrixLU().diagonal().cwiseAbs().minCoeff();
}

}  // namespace gearlash
