// e^matrix of numbers in units of very different sizes.
#include <gtest/gtest.h>

#include <cmath>

#include "numeric/linear_algebra.hpp"

namespace gearlash::matrix_exponential_test {
namespace {

TEST(MatrixExponential, KeepsItsDigitsInUnitsOfVeryDifferentSizes) {
  // An oscillator of rate 3 whose speed is in units of 1e-9 and drives a lag in units of 1e9.
  constexpr double small = 1e-9;
  const double time = 2.0;
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(3, 3);
  matrix(0, 1) = small;
  matrix(1, 0) = -9.0 / small;
  matrix(2, 1) = 1e-18;
  matrix(2, 2) = -1.0;
  const Eigen::MatrixXd found = exponential(matrix * time);
  EXPECT_NEAR(found(0, 0), std::cos(6.0), 1e-14);
  EXPECT_NEAR(found(0, 1), small * std::sin(6.0) / 3.0, 1e-14 * small);
  EXPECT_NEAR(found(1, 0), -3.0 / small * std::sin(6.0), 1e-13 / small);
  // ∫₀² e^{−(2 − s)} 1e-18 cos 3s ds
  const double driven = 1e-18 * (std::cos(6.0) + 3.0 * std::sin(6.0) - std::exp(-time)) / 10.0;
  EXPECT_NEAR(found(2, 1), driven, 1e-32);
}

TEST(EdgeMatrixExponential, OfWhatDecouplesIsThatOfItsParts) {
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(2, 2);
  EXPECT_EQ(exponential(matrix), Eigen::MatrixXd::Identity(2, 2));
  matrix(0, 1) = 1e6;
  const Eigen::MatrixXd found = exponential(matrix);
  EXPECT_NEAR(found(0, 1), 1e6, 1e-8);
  EXPECT_NEAR(found(0, 0), 1.0, 1e-14);
  EXPECT_EQ(found(1, 0), 0.0);
}

}  // namespace
}  // namespace gearlash::matrix_exponential_test
