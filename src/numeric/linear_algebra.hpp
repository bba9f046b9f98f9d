// Dense linear algebra behind plain functions, so that Eigen's heavy templates are compiled once.
#pragma once

#include <Eigen/Core>
#include <optional>

namespace gearlash {

// ---- matrices of any size -----------------------------------------------------------------------

/// e^matrix, by scaling and squaring of Padé approximants (Higham 2005) of the balanced matrix:
/// numbers in units of very different sizes cost no digits.
Eigen::MatrixXd exponential(const Eigen::MatrixXd& matrix);

/// Units of the numbers, powers of 2, in which the sums of sizes of each row and its column,
/// without the diagonal, are alike (Osborne 1960; Parlett & Reinsch 1969, but nothing is permuted).
Eigen::VectorXd balancing_scales(Eigen::MatrixXd matrix);

/// In these units. The eigenvalues are the same, and lose fewer digits.
Eigen::MatrixXd balanced(const Eigen::MatrixXd& matrix);

/// All eigenvalues, by the QR algorithm.
Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& matrix);

struct Eigensystem {
  Eigen::VectorXcd values;
  Eigen::MatrixXcd vectors;  ///< column i belongs to value i
};
Eigensystem eigensystem(const Eigen::MatrixXd& matrix);
/// The same, the values by falling modulus.
Eigensystem sorted_eigensystem(const Eigen::MatrixXd& matrix);

/// Solves matrix x = right by elimination with partial pivoting. Precondition: not singular.
Eigen::VectorXd solved(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& right);
Eigen::MatrixXcd solved(const Eigen::MatrixXcd& matrix, const Eigen::MatrixXcd& right);
Eigen::MatrixXd inverse(const Eigen::MatrixXd& matrix);

/// The same by full pivoting, which a nearly singular matrix needs. If the matrix is singular to
/// rounding, the undetermined component is 0.
Eigen::VectorXd solved_with_full_pivoting(const Eigen::MatrixXd& matrix,
                                          const Eigen::VectorXd& right);

/// All x with matrix x = right: one of them, and a basis of the directions in which it may move.
struct Solutions {
  Eigen::VectorXd one;
  Eigen::MatrixXd directions;  ///< columns; none if there is only one solution
};
/// By full pivoting, with rows and columns scaled to 1. Empty if there is none to within a share of
/// 1e-9 of the terms.
std::optional<Solutions> all_solutions(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& right);

/// An orthonormal basis of the columns' span, by Householder reflections.
Eigen::MatrixXd orthonormal_basis(const Eigen::MatrixXd& columns);

/// An orthonormal basis of what is orthogonal to the columns' span.
Eigen::MatrixXd complement(const Eigen::MatrixXd& columns);

/// Upper triangular U with UᵀU = matrix (Cholesky); empty unless it is positive definite.
Eigen::MatrixXd cholesky_factor(const Eigen::MatrixXd& matrix);

// ---- matrices of a fixed size -------------------------------------------------------------------

Eigen::Vector3cd eigenvalues(const Eigen::Matrix3d& matrix);

/// By full pivoting.
Eigen::Vector3d solved_with_full_pivoting(const Eigen::Matrix3d& matrix,
                                          const Eigen::Vector3d& right);
/// Pivots of the elimination with full pivoting, by modulus.
double least_pivot(const Eigen::Matrix3d& matrix);

}  // namespace gearlash
