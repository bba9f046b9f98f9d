#include <Eigen/Dense>
#include <cmath>
#include <unsupported/Eigen/MatrixFunctions>

#include "numeric/linear_algebra.hpp"

namespace gearlash {

Eigen::VectorXd balancing_scales(Eigen::MatrixXd matrix) {
  const Eigen::Index size = matrix.rows();
  matrix.diagonal().setZero();
  Eigen::VectorXd scales = Eigen::VectorXd::Ones(size);
  constexpr int most_rounds = 30;
  bool is_balanced = false;
  for (int round = 0; round < most_rounds && !is_balanced; ++round) {
    is_balanced = true;
    for (Eigen::Index i = 0; i < size; ++i) {
      double column = matrix.col(i).cwiseAbs().sum();
      double row = matrix.row(i).cwiseAbs().sum();
      // Nothing acts on the number, or it acts on nothing: the other sum becomes about 1.
      if (row == 0.0 && column > 1.0) row = 1.0 / column;
      if (column == 0.0 && row > 1.0) column = 1.0 / row;
      if (!(column > 0.0) || !(row > 0.0)) continue;
      const double factor = std::exp2(std::round(0.5 * std::log2(row / column)));
      constexpr double worthwhile = 0.95;
      if (!(column * factor + row / factor < worthwhile * (column + row))) continue;
      is_balanced = false;
      scales[i] *= factor;
      matrix.col(i) *= factor;
      matrix.row(i) /= factor;
    }
  }
  return scales;
}

namespace {

Eigen::MatrixXd scaled_by(const Eigen::VectorXd& scales, const Eigen::MatrixXd& matrix) {
  return scales.cwiseInverse().asDiagonal() * matrix * scales.asDiagonal();
}

}  // namespace

Eigen::MatrixXd balanced(const Eigen::MatrixXd& matrix) {
  const Eigen::VectorXd scales = balancing_scales(matrix);
  return scales.allFinite() && matrix.allFinite() ? scaled_by(scales, matrix) : matrix;
}

Eigen::MatrixXd exponential(const Eigen::MatrixXd& matrix) {
  const Eigen::VectorXd scales = balancing_scales(matrix);
  if (!scales.allFinite() || !matrix.allFinite()) return matrix.exp();
  return scales.asDiagonal() * scaled_by(scales, matrix).exp() * scales.cwiseInverse().asDiagonal();
}

}  // namespace gearlash
