// Regions of one kind of motion: their areas, and their borders beside the closed form's.
#include "question/map/motion_regions.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "base/stopping.hpp"
#include "closed_form/growth_at_rest.hpp"
#include "question/map/servo_grids.hpp"

namespace gearlash::motion_regions_test {
namespace {

Grid grid_of_servos() {
  return {.drive = drive_of({.inertia_ratio = 2.0, .backlash = 0.3}),
          .axes = {logarithmic("servo.damping", 0.1, 0.8, 9),
                   linear("servo.friction_ratio", 0.05, 0.95, 11)}};
}

/// In shares of the axes; a hole counts negative.
double area_of(const MotionRegion& region, const Grid& grid) {
  double twice = 0.0;
  for (const MapCurve& outline : region.outlines) {
    for (std::size_t i = 0; i + 1 < outline.size(); ++i) {
      const double x = position_on(grid.axes[1], outline[i].x);
      const double y = position_on(grid.axes[0], outline[i].y);
      twice += x * position_on(grid.axes[0], outline[i + 1].y) -
               y * position_on(grid.axes[1], outline[i + 1].x);
    }
  }
  return 0.5 * twice;
}

TEST(OracleMotionRegions, EndWhereGrowthAtRestIsOne) {
  const Grid grid = grid_of_servos();
  const std::vector<MotionRegion> regions = motion_regions(grid, worked_out(grid));
  ASSERT_EQ(regions.size(), 2U);
  EXPECT_EQ(regions[0].kind, MotionKind::rests);
  EXPECT_EQ(regions[1].kind, MotionKind::hunts);
  const std::vector<MapCurve> borders = borders_of(regions, grid);
  ASSERT_EQ(borders.size(), 1U);
  EXPECT_GT(borders[0].size(), 8U);
  constexpr double located = 1.0 / 400.0;
  for (const MapPoint& point : borders[0]) {
    // Within 1/400 of either axis growth at rest crosses 1.
    std::set<bool> sides;
    for (const double aside : {-located, located}) {
      const double x = position_on(grid.axes[1], point.x);
      const double y = position_on(grid.axes[0], point.y);
      for (const auto& [along, up] : {std::pair{x + aside, y}, std::pair{x, y + aside}}) {
        const MapPoint beside{value_at(grid.axes[1], along), value_at(grid.axes[0], up)};
        sides.insert(growth_at_rest(servo_dynamics(servo_at(grid, beside))) > 1.0);
      }
    }
    EXPECT_EQ(sides.size(), 2U) << point.x << ' ' << point.y;
  }
}

TEST(MotionRegions, CoverTheMapOnce) {
  const Grid grid = grid_of_servos();
  double whole = 0.0;
  for (const MotionRegion& region : motion_regions(grid, worked_out(grid))) {
    for (const MapCurve& outline : region.outlines) EXPECT_EQ(outline.front(), outline.back());
    const double area = area_of(region, grid);
    EXPECT_GT(area, 0.1);
    whole += area;
  }
  EXPECT_NEAR(whole, 1.0, 1e-9);
}

/// Verdicts by hand: an island of drives that run away. The searches between disagree with them,
/// so that the border lies at the outer ends of the edges.
TEST(MotionRegions, AnIslandIsAHoleOfItsSea) {
  const Grid grid = grid_of_servos();
  Table table = worked_out(grid);
  for (Verdict& verdict : table.column_of_verdicts()) verdict = Verdict::hunts;
  table.column_of_verdicts()[4 * 11 + 5] = Verdict::runs_away;
  const std::vector<MotionRegion> regions = motion_regions(grid, table);
  ASSERT_EQ(regions.size(), 2U);
  EXPECT_EQ(regions[0].kind, MotionKind::hunts);
  EXPECT_EQ(regions[0].outlines.size(), 2U);
  EXPECT_EQ(regions[1].kind, MotionKind::runs_away);
  EXPECT_EQ(regions[1].outlines.size(), 1U);
  EXPECT_NEAR(area_of(regions[0], grid) + area_of(regions[1], grid), 1.0, 1e-9);
  EXPECT_EQ(borders_of(regions, grid).size(), 1U);
}

TEST(EdgeMotionRegions, OfOneKindAreTheMap) {
  const Grid grid = grid_of_servos();
  Table table = table_of(grid.size());  // all undecided
  const std::vector<MotionRegion> regions = motion_regions(grid, table);
  ASSERT_EQ(regions.size(), 1U);
  EXPECT_EQ(regions[0].kind, MotionKind::not_known);
  EXPECT_NEAR(area_of(regions[0], grid), 1.0, 1e-9);
  EXPECT_TRUE(borders_of(regions, grid).empty());
}

TEST(EdgeMotionRegions, StoppedTheirBordersLieHalfWay) {
  test::Stopping stop;
  const Grid grid = grid_of_servos();
  EXPECT_EQ(motion_regions(grid, worked_out(grid), stop).size(), 2U);
}

}  // namespace
}  // namespace gearlash::motion_regions_test
