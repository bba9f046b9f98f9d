// Contours: round levels, and places at which the quantity is what they say.
#include "question/map/contours.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "question/map/hunting_boundary.hpp"
#include "question/map/servo_grids.hpp"

namespace gearlash::contours_test {
namespace {

using testing::DoubleEq;
using testing::IsEmpty;
using testing::Pointwise;

constexpr double infinity = std::numeric_limits<double>::infinity();

std::vector<double> spread(double from, double to, bool by_factors) {
  std::vector<double> values;
  for (int i = 0; i <= 1000; ++i) {
    values.push_back(by_factors ? from * std::pow(to / from, i / 1000.0)
                                : from + (to - from) * i / 1000.0);
  }
  return values;
}

TEST(Contours, LevelsAreRoundNumbersWithinTheBulkOfTheValues) {
  EXPECT_THAT(round_levels(spread(1.0, 2.0, false)),
              Pointwise(DoubleEq(), {1.1, 1.2, 1.3, 1.4, 1.5, 1.6, 1.7, 1.8, 1.9}));
  EXPECT_THAT(round_levels(spread(6.0, 16.0, false)),
              Pointwise(DoubleEq(), {7.0, 8.0, 9.0, 10.0, 11.0, 12.0, 13.0, 14.0, 15.0}));
  EXPECT_THAT(round_levels(spread(0.04, 2.5, true)),
              Pointwise(DoubleEq(), {0.05, 0.07, 0.1, 0.15, 0.2, 0.3, 0.5, 0.7, 1.0, 1.5, 2.0}));
  EXPECT_THAT(round_levels(spread(0.009, 11.0, true)),
              Pointwise(DoubleEq(), {0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0}));
  EXPECT_LE(round_levels(spread(1e-12, 1e12, true)).size(), 12U);
}

TEST(EdgeContours, LevelsOfFewOrStrangeValues) {
  EXPECT_THAT(round_levels({}), IsEmpty());
  EXPECT_THAT(round_levels({NAN, -1.0, 0.0, infinity}), IsEmpty());
  EXPECT_THAT(round_levels({0.3, 0.3, 0.3}), IsEmpty());
  EXPECT_THAT(round_levels({0.95, 1.85, NAN, infinity, -3.0}),
              Pointwise(DoubleEq(), {1.0, 1.1, 1.2, 1.3, 1.4, 1.5, 1.6, 1.7, 1.8}));
}

Grid grid_with(double restitution) {
  return {drive_of({.inertia_ratio = 2.0, .backlash = 1.0, .restitution = restitution}),
          {spaced_axis("y", "servo.damping", 0.1, 0.7, 9, Spacing::linear),
           spaced_axis("x", "servo.friction_ratio", 0.05, 0.95, 9, Spacing::linear)}};
}

double quantity_at(const Grid& grid, const MapPoint& point, Quantity quantity) {
  const NormalizedServo servo = servo_at(grid, point);
  Table row = table_of(1);
  find_limit_cycles({&servo, 1}, columns_of(row));
  return row[quantity][0];
}

TEST(PropertyContours, TheQuantityIsTheirLevel) {
  const Grid grid = grid_with(0.0);
  const Table cycles = worked_out(grid);
  for (const auto& [quantity, levels] : std::vector<std::pair<Quantity, std::vector<double>>>{
           {Quantity::amplitude, {0.1, 0.2, 0.5}},
           {Quantity::period, {7.0, 8.0, 12.0}},
           {Quantity::multiplier, {0.3, 0.6, 0.9}},
           {Quantity::growth_at_rest, {0.5, 2.0, 5.0}}}) {
    const std::vector<Contour> contours = contours_of(grid, cycles, quantity, levels);
    ASSERT_EQ(contours.size(), levels.size());
    for (const Contour& contour : contours) {
      ASSERT_FALSE(contour.curves.empty()) << name_of(quantity) << " " << contour.level;
      for (const MapCurve& curve : contour.curves) {
        for (const MapPoint& point : curve) {
          // A place is good to 2⁻²⁴ of the map, across which no quantity changes by more than a
          // thousandfold but close to the boundary; none of these levels is as close.
          EXPECT_NEAR(quantity_at(grid, point, quantity), contour.level, 1e-4 * contour.level)
              << name_of(quantity) << " " << contour.level;
        }
      }
    }
  }
}

TEST(PropertyContours, RunAlongTheBoundaryWithoutCrossingIt) {
  const Grid grid = grid_with(0.0);
  const std::vector<Contour> contours =
      contours_of(grid, worked_out(grid), Quantity::amplitude, {0.02, 0.05, 0.1});
  for (const Contour& contour : contours) {
    ASSERT_EQ(contour.curves.size(), 1U);  // not broken where a cell has no cycle in a corner
    for (const MapPoint& point : contour.curves[0]) {
      EXPECT_EQ(side_of_hunting(servo_at(grid, point)), Side::inside);
    }
  }
}

TEST(Contours, AreInterpolatedWhereFacesBounce) {
  const Grid grid = grid_with(0.2);
  // A plane of its own, not of these servos: what is interpolated is the table.
  Table cycles = table_of(grid.size());
  const auto plane = [](double damping, double friction) { return 2.0 * damping + friction; };
  for (std::size_t row = 0; row < grid.size(); ++row) {
    const NormalizedServo servo = servo_of(grid.at(row));
    cycles.column(Quantity::amplitude)[row] = plane(servo.damping, servo.friction_ratio);
  }
  const std::vector<Contour> contours = contours_of(grid, cycles, Quantity::amplitude, {1.0});
  ASSERT_EQ(contours[0].curves.size(), 1U);
  for (const MapPoint& point : contours[0].curves[0]) {
    EXPECT_NEAR(plane(point.y, point.x), 1.0, 1e-6);
  }
  // Nothing is known of a point: no contour passes its cells.
  cycles.column(Quantity::amplitude)[4 * 9 + 4] = NAN;
  const std::vector<Contour> broken = contours_of(grid, cycles, Quantity::amplitude, {1.3});
  ASSERT_EQ(broken[0].curves.size(), 2U);
  std::vector<double> ends;
  for (const MapCurve& curve : broken[0].curves) {
    ends.push_back(curve.front().x);
    ends.push_back(curve.back().x);
  }
  std::sort(ends.begin(), ends.end());
  EXPECT_NEAR(ends[1], 0.3875, 1e-6);  // as far as the next known points
  EXPECT_NEAR(ends[2], 0.6125, 1e-6);
  for (const MapCurve& curve : broken[0].curves) {
    for (const MapPoint& point : curve) {
      EXPECT_FALSE(std::abs(point.x - 0.5) < 0.11 && std::abs(point.y - 0.4) < 0.074);
    }
  }
}

}  // namespace
}  // namespace gearlash::contours_test
