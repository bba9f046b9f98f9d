// The optimiser without derivatives: minima that are known, and how it is stopped.
#include "numeric/box_minimum.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace gearlash {
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

}  // namespace
}  // namespace gearlash
