#include <Eigen/Eigenvalues>

#include "numeric/linear_algebra.hpp"

namespace gearlash {

Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& matrix) { return matrix.eigenvalues(); }

Eigensystem eigensystem(const Eigen::MatrixXd& matrix) {
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(matrix);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

Eigen::Vector3cd eigenvalues(const Eigen::Matrix3d& matrix) {
  return eigenvalues(Eigen::MatrixXd(matrix));  // the same bits in half the compile time
}

}  // namespace gearlash
