#include "numeric/elimination.hpp"

#include <gtest/gtest.h>

#include "base/references.hpp"
#include "base/seeded_draws.hpp"

namespace gearlash::elimination_test {
namespace {

TEST(PropertyElimination, ContainsTheInverseOfEveryMatrixWithin) {
  constexpr std::uint64_t seed = 4403;
  SCOPED_TRACE(seed);
  SeededDraws draws(seed);
  int finite = 0;
  for (int i = 0; i < 2000; ++i) {
    const auto size = static_cast<Eigen::Index>(draws.uniform(1.0, 6.0));
    MatrixOf<Interval> enclosed(size, size);
    MatrixOf<Wide> within(size, size);
    const double width = draws.log_uniform(1e-15, 1e-3);
    for (Eigen::Index row = 0; row < size; ++row) {
      for (Eigen::Index column = 0; column < size; ++column) {
        const double low = draws.happens(0.3) ? 0.0 : draws.either_sign(1e-2, 1e2);
        const double high = low + width * std::abs(low);
        enclosed(row, column) = {low, high};
        within(row, column) = low + Wide(draws.uniform(0.0, 1.0)) * (Wide(high) - Wide(low));
      }
    }
    const MatrixOf<Interval> found = inverse_by_elimination(enclosed);
    const MatrixOf<Wide> inverse = inverse_by_elimination(within);
    for (Eigen::Index k = 0; k < size * size; ++k) {
      const Interval& one = found.data()[k];
      const Wide exact = inverse.data()[k];
      if (!(one.high - one.low < infinity) || std::isnan(exact)) continue;
      ++finite;
      // The reference is rounded as well.
      const Wide rounding = 1e-3L * (Wide(one.high) - Wide(one.low));
      EXPECT_TRUE(one.low - rounding <= exact && exact <= one.high + rounding)
          << "matrix " << i << ": " << one.low << " … " << one.high << " without " << exact;
    }
  }
  EXPECT_GT(finite, 10000);
}

TEST(Elimination, ProvesNothingOfASingularMatrix) {
  MatrixOf<Interval> matrix(2, 2);
  matrix << Interval(1.0, 1.1), Interval(2.0), Interval(1.0), Interval(2.0);
  EXPECT_EQ(inverse_by_elimination(matrix)(0, 0).high, infinity);
}

/// An exact 0 stays one: rows that are not connected are not widened.
TEST(Elimination, KeepsZeros) {
  MatrixOf<Interval> matrix(2, 2);
  matrix << Interval(4.0), Interval(0.0), Interval(1.0), Interval(2.0);
  EXPECT_TRUE(is_exactly(inverse_by_elimination(matrix)(0, 1), 0.0));
}

}  // namespace
}  // namespace gearlash::elimination_test
