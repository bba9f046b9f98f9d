// The optimisers: minima that are known, and how they are stopped.
#include "numeric/box_minimum.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace gearlash::box_minimum_test {
namespace {

TEST(OracleBoxMinimum, OfAQuadraticWithAJumpIsFound) {
  const auto function = [](std::span<const double> x) -> std::optional<double> {
    const double square = std::pow(x[0] - 0.3, 2) + 4.0 * std::pow(x[1] - 0.7, 2);
    return x[0] < 0.25 ? square + 10.0 : square;
  };
  const std::vector<double> start{0.1, 0.1};
  const CubeMinimum found = minimum_on_cube(
      function, start, {.global_evaluations = 100, .local_evaluations = 200, .last_step = 1e-6});
  EXPECT_NEAR(found.point[0], 0.3, 1e-3);
  EXPECT_NEAR(found.point[1], 0.7, 1e-3);
  EXPECT_NEAR(found.value, 0.0, 1e-6);
  EXPECT_LE(found.evaluations, 310U);
  EXPECT_FALSE(found.stopped);
  const CubeMinimum again = minimum_on_cube(
      function, start, {.global_evaluations = 100, .local_evaluations = 200, .last_step = 1e-6});
  EXPECT_EQ(again.point, found.point);
}

TEST(OracleBoxMinimum, TheGlobalSearchLeavesALocalMinimum) {
  const auto function = [](std::span<const double> x) -> std::optional<double> {
    return std::min(std::abs(x[0] - 0.1) + 0.1, 2.0 * std::abs(x[0] - 0.9));
  };
  const std::vector<double> start{0.1};
  EXPECT_NEAR(minimum_on_cube(function, start).point[0], 0.9, 0.02);
  EXPECT_NEAR(minimum_on_cube(function, start, {.global_evaluations = 0}).point[0], 0.1, 0.02);
}

TEST(EdgeBoxMinimum, StopsAndRethrows) {
  const std::vector<double> start{0.5};
  int calls = 0;
  const auto stopping = [&](std::span<const double> x) -> std::optional<double> {
    if (++calls > 5) return std::nullopt;
    return x[0];
  };
  const CubeMinimum found = minimum_on_cube(stopping, start);
  EXPECT_TRUE(found.stopped);
  EXPECT_LE(calls, 6);
  EXPECT_LE(found.value, 0.5);
  const auto throwing = [](std::span<const double>) -> std::optional<double> {
    throw std::runtime_error("thrown across C");
  };
  EXPECT_THROW((void)minimum_on_cube(throwing, start), std::runtime_error);
}

SlopedNumber distance_from(std::span<const double> x, double to_x, double to_y) {
  const double a = x[0] - to_x;
  const double b = x[1] - to_y;
  return {a * a + b * b, {2.0 * a, 2.0 * b}};
}

/// The largest of the distances from two points is least half-way between them; with x ≤ 0.4 it is
/// least at x = 0.4, where the farther point is (0.8, 0.5).
TEST(OracleBoxMinimum, BySlopesTheLeastOfTheLargestWithinALimit) {
  const auto function = [](std::span<const double> x) -> std::optional<SlopedNumbers> {
    return SlopedNumbers{.sizes = {distance_from(x, 0.2, 0.5), distance_from(x, 0.8, 0.5)},
                         .limited = {{x[0] - 0.4, {1.0, 0.0}}}};
  };
  for (const std::vector<double>& start : {std::vector{0.1, 0.1}, {0.9, 0.7}, {0.4, 0.5}}) {
    const auto found = minimum_by_slopes(function, start, 60);
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->point[0], 0.4, 1e-7);
    EXPECT_LE(found->point[0], 0.4);
    EXPECT_NEAR(found->point[1], 0.5, 1e-6);
    EXPECT_NEAR(found->value, 0.16, 1e-7);
  }
}

TEST(EdgeBoxMinimum, BySlopesTurnsBackWhereThereAreNone) {
  const auto function = [](std::span<const double> x) -> std::optional<SlopedNumbers> {
    if (x[0] > 0.6) return std::nullopt;
    return SlopedNumbers{.sizes = {{-x[0], {-1.0}}}, .limited = {}};
  };
  const std::vector<double> start{0.1};
  const auto found = minimum_by_slopes(function, start, 60);
  ASSERT_TRUE(found);
  EXPECT_GT(found->point[0], 0.3);
  EXPECT_LE(found->point[0], 0.6);
  EXPECT_FALSE(minimum_by_slopes(function, std::vector{0.8}, 60));
  const auto throwing = [](std::span<const double> x) -> std::optional<SlopedNumbers> {
    if (x[0] > 0.2) throw std::runtime_error("thrown across C");
    return SlopedNumbers{.sizes = {{-x[0], {-1.0}}}, .limited = {}};
  };
  EXPECT_THROW((void)minimum_by_slopes(throwing, start, 60), std::runtime_error);
}

TEST(EdgeBoxMinimum, BySlopesOfLimitsThatCannotBeKept) {
  const auto function = [](std::span<const double> x) -> std::optional<SlopedNumbers> {
    return SlopedNumbers{.sizes = {{x[0], {1.0}}}, .limited = {{1.0 + x[0], {1.0}}}};
  };
  EXPECT_FALSE(minimum_by_slopes(function, std::vector{0.5}, 60));
}

}  // namespace
}  // namespace gearlash::box_minimum_test
