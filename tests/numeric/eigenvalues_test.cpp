// Eigenvalues that the algorithm does not find are not a number, whatever the memory held.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <limits>

#include "numeric/linear_algebra.hpp"

namespace gearlash::eigenvalues_test {
namespace {

TEST(Eigenvalues, OracleOfATriangularMatrixTheyAreItsDiagonal) {
  const Eigen::MatrixXd matrix{{2.0, 1.0, 5.0}, {0.0, -3.0, 7.0}, {0.0, 0.0, 0.5}};
  const Eigen::VectorXcd values = eigenvalues(matrix);
  for (Eigen::Index i = 0; i < 3; ++i) EXPECT_EQ(values[i], std::complex<double>(matrix(i, i)));
  const Eigensystem system = eigensystem(matrix);
  EXPECT_EQ(system.values, values);
  const Eigen::MatrixXcd off = matrix * system.vectors - system.vectors * values.asDiagonal();
  EXPECT_LT(off.cwiseAbs().maxCoeff(), 1e-14);
}

TEST(Eigenvalues, EdgeOfNumbersThatAreNoneAreUnknown) {
  for (const double number :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Identity(4, 4);
    matrix(1, 2) = matrix(2, 1) = number;
    for (const std::complex<double>& value : eigenvalues(matrix)) {
      EXPECT_TRUE(std::isnan(value.real()));
    }
    const Eigensystem system = eigensystem(matrix);
    EXPECT_TRUE(system.values.array().isNaN().all());
    EXPECT_TRUE(system.vectors.array().isNaN().all());
    EXPECT_EQ(system.vectors.rows(), 4);
  }
}

}  // namespace
}  // namespace gearlash::eigenvalues_test
