// Regions of a map against independent judgements of places, and against the closed form's borders.
#include "question/map/map_regions.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <set>

#include "base/stopping.hpp"
#include "closed_form/growth_at_rest.hpp"
#include "gearlash/analyse.hpp"
#include "question/change/target.hpp"
#include "question/map/servo_grids.hpp"
#include "question/pd_drive.hpp"

namespace gearlash::map_regions_test {
namespace {

Grid grid_of_servos() {
  return {.drive = drive_of({.inertia_ratio = 2.0, .backlash = 0.3}),
          .axes = {logarithmic("servo.damping", 0.1, 0.8, 9),
                   linear("servo.friction_ratio", 0.05, 0.95, 11)}};
}

/// A drive that is searched: it rests at low gains, and hunts if disturbed at high ones.
Grid grid_of_searched_drives() {
  return {.drive = pd_drive(),
          .axes = {linear("controller.derivative", 0.02, 0.04, 5),
                   logarithmic("controller.proportional", 1.0, 6.0, 7)}};
}

std::vector<PlaceKind> kinds_of(const Grid& grid, const std::optional<Target>& target) {
  const Family family(grid);
  std::vector<PlaceKind> kinds(grid.size());
  evaluate(family, rows_of(grid, 0, grid.size()), asked_for_kinds(target, kinds));
  return kinds;
}

std::vector<MapRegion> regions_of(const Grid& grid, const std::optional<Target>& target = {},
                                  Progress& progress = no_progress()) {
  return gearlash::regions_of(grid, kinds_of(grid, target), target, progress);
}

/// In shares of the axes.
MapPoint shares_of(const Grid& grid, const MapPoint& point) {
  return {position_on(grid.axes[1], point.x), position_on(grid.axes[0], point.y)};
}
MapPoint at_shares(const Grid& grid, const MapPoint& shares) {
  return {value_at(grid.axes[1], shares.x), value_at(grid.axes[0], shares.y)};
}

/// Calls `take` with the ends of all lines of the curves, in shares of the axes.
void for_each_line(const std::vector<MapCurve>& curves, const Grid& grid,
                   const std::function<void(const MapPoint&, const MapPoint&)>& take) {
  for (const MapCurve& curve : curves) {
    for (std::size_t i = 0; i + 1 < curve.size(); ++i) {
      take(shares_of(grid, curve[i]), shares_of(grid, curve[i + 1]));
    }
  }
}

/// In shares of the axes; a hole counts negative.
double area_of(const MapRegion& region, const Grid& grid) {
  double twice = 0.0;
  for_each_line(region.outlines, grid, [&](const MapPoint& from, const MapPoint& to) {
    twice += from.x * to.y - from.y * to.x;
  });
  return 0.5 * twice;
}

/// Whether the region's outlines wind around a place.
bool contains(const MapRegion& region, const Grid& grid, const MapPoint& shares) {
  int windings = 0;
  for_each_line(region.outlines, grid, [&](const MapPoint& from, const MapPoint& to) {
    if ((from.y > shares.y) == (to.y > shares.y)) return;
    const double x = from.x + (shares.y - from.y) / (to.y - from.y) * (to.x - from.x);
    if (x > shares.x) windings += to.y > from.y ? 1 : -1;
  });
  return windings != 0;
}

double distance_to(const std::vector<MapCurve>& curves, const Grid& grid, const MapPoint& shares) {
  double least = 1.0;
  for_each_line(curves, grid, [&](const MapPoint& from, const MapPoint& to) {
    const MapPoint along{to.x - from.x, to.y - from.y};
    const double length = along.x * along.x + along.y * along.y;
    const double dot = (shares.x - from.x) * along.x + (shares.y - from.y) * along.y;
    const double share = length > 0.0 ? std::clamp(dot / length, 0.0, 1.0) : 0.0;
    least = std::min(least, std::hypot(shares.x - from.x - share * along.x,
                                       shares.y - from.y - share * along.y));
  });
  return least;
}

/// By an analysis of its own.
bool meets(const Grid& grid, const MapPoint& shares, const Target& target) {
  const MapPoint place = at_shares(grid, shares);
  Drive drive = grid.drive;
  set_on(grid.axes, drive, std::array{place.y, place.x});
  return is_met(target, analyse(drive, wanted_for(target)));
}

/// The region that meets the target is the one that does at random places, but next to its border,
/// and it is so on both sides of the border. Returns how many of the places meet it.
int expect_region_is_the_targets(const Grid& grid, const Target& target, double located,
                                 int places) {
  const std::vector<MapRegion> regions = regions_of(grid, target);
  EXPECT_EQ(regions.size(), 2U);
  EXPECT_EQ(regions[0].kind, PlaceKind::met);
  EXPECT_EQ(regions[1].kind, PlaceKind::missed);
  const std::vector<MapCurve> borders = borders_of(regions, grid);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  int met = 0;
  for (int i = 0; i < places; ++i) {
    const MapPoint place{share(random), share(random)};
    if (distance_to(borders, grid, place) < located) continue;
    const bool is_met_there = meets(grid, place, target);
    EXPECT_EQ(contains(regions[0], grid, place), is_met_there) << place.x << ' ' << place.y;
    EXPECT_EQ(contains(regions[1], grid, place), !is_met_there) << place.x << ' ' << place.y;
    met += is_met_there ? 1 : 0;
  }
  int lines = 0;
  for_each_line(borders, grid, [&](const MapPoint& from, const MapPoint& to) {
    const double length = std::hypot(to.x - from.x, to.y - from.y);
    const MapPoint left{-(to.y - from.y) / length, (to.x - from.x) / length};
    const MapPoint middle{0.5 * (from.x + to.x), 0.5 * (from.y + to.y)};
    const MapPoint inside{middle.x + located * left.x, middle.y + located * left.y};
    const MapPoint outside{middle.x - located * left.x, middle.y - located * left.y};
    const bool is_clear = length > located && distance_to(borders, grid, inside) > 0.9 * located &&
                          distance_to(borders, grid, outside) > 0.9 * located;
    const auto is_on_map = [](const MapPoint& at) {
      return std::min(at.x, at.y) > 0.0 && std::max(at.x, at.y) < 1.0;
    };
    if (!is_clear || !is_on_map(inside) || !is_on_map(outside)) return;
    ++lines;
    EXPECT_TRUE(meets(grid, inside, target)) << middle.x << ' ' << middle.y;
    EXPECT_FALSE(meets(grid, outside, target)) << middle.x << ' ' << middle.y;
  });
  EXPECT_GT(lines, 2);
  return met;
}

TEST(OracleMapRegions, OfATargetInClosedFormAreWhereItIsMet) {
  const Grid grid{.drive = drive_of({.damping = 0.2, .inertia_ratio = 2.0, .backlash = 0.3}, 20.0),
                  .axes = {logarithmic("servo.damping", 0.1, 0.8, 5),
                           linear("servo.friction_ratio", 0.05, 0.95, 5)}};
  Target target{.no_hunting = true};
  constexpr double located = 4e-3;  // corners, where two limits meet, are cut by no more
  constexpr int places = 200;
  const int alone = expect_region_is_the_targets(grid, target, located, places);
  target.require(Quantity::bandwidth, {4.0, infinity});
  const int both = expect_region_is_the_targets(grid, target, located, places);
  EXPECT_GT(both, 5);
  EXPECT_LT(both, alone - 5);
}

TEST(OracleMapRegions, OfATargetOfSearchedDrivesAreWhereItIsMet) {
  const Grid grid = grid_of_searched_drives();
  Target target = always_at_rest();
  target.require(Quantity::bandwidth, {2.5, infinity});
  // Located to 1/400 on the lines of the grid, and straight between them.
  const int met = expect_region_is_the_targets(grid, target, 0.02, 60);
  EXPECT_GT(met, 10);
  EXPECT_LT(met, 50);
}

TEST(EdgeMapRegions, WithoutAValidDriveAreNotKnown) {
  Grid grid = grid_of_searched_drives();
  grid.axes[0] = {.path = "gearbox.backlash", .values = {-1e-3, 2e-3}};
  const std::vector<PlaceKind> kinds = kinds_of(grid, Target{.no_hunting = true});
  EXPECT_EQ(std::count(kinds.begin(), kinds.end(), PlaceKind::not_known), 7);
  EXPECT_EQ(regions_of(grid, Target{.no_hunting = true}).back().kind, PlaceKind::not_known);
}

TEST(OracleMapRegions, EndWhereGrowthAtRestIsOne) {
  const Grid grid = grid_of_servos();
  const std::vector<MapRegion> regions = regions_of(grid);
  ASSERT_EQ(regions.size(), 2U);
  EXPECT_EQ(regions[0].kind, PlaceKind::rests);
  EXPECT_EQ(regions[1].kind, PlaceKind::hunts);
  const std::vector<MapCurve> borders = borders_of(regions, grid);
  ASSERT_EQ(borders.size(), 1U);
  EXPECT_GT(borders[0].size(), 8U);
  constexpr double located = 1e-6;
  for (const MapPoint& point : borders[0]) {
    // Within 1e-6 of either axis growth at rest crosses 1.
    std::set<bool> sides;
    for (const double aside : {-located, located}) {
      const MapPoint at = shares_of(grid, point);
      for (const MapPoint& near : {MapPoint{at.x + aside, at.y}, MapPoint{at.x, at.y + aside}}) {
        sides.insert(growth_at_rest(servo_dynamics(servo_at(grid, at_shares(grid, near)))) > 1.0);
      }
    }
    EXPECT_EQ(sides.size(), 2U) << point.x << ' ' << point.y;
  }
}

TEST(MapRegions, CoverTheMapOnce) {
  for (const Grid& grid : {grid_of_servos(), grid_of_searched_drives()}) {
    double whole = 0.0;
    for (const MapRegion& region : regions_of(grid)) {
      for (const MapCurve& outline : region.outlines) EXPECT_EQ(outline.front(), outline.back());
      const double area = area_of(region, grid);
      EXPECT_GT(area, 0.1);
      whole += area;
    }
    EXPECT_NEAR(whole, 1.0, 1e-9);
  }
}

/// Kinds by hand: an island of drives that run away, with its border half-way to the others.
TEST(MapRegions, AnIslandIsAHoleOfItsSea) {
  const Grid grid = grid_of_searched_drives();
  std::vector<PlaceKind> kinds(grid.size(), PlaceKind::hunts);
  kinds[7 + 3] = PlaceKind::runs_away;
  test::Stopping stop;
  const std::vector<MapRegion> regions = gearlash::regions_of(grid, kinds, std::nullopt, stop);
  ASSERT_EQ(regions.size(), 2U);
  EXPECT_EQ(regions[0].kind, PlaceKind::hunts);
  EXPECT_EQ(regions[0].outlines.size(), 2U);
  EXPECT_EQ(regions[1].kind, PlaceKind::runs_away);
  EXPECT_EQ(regions[1].outlines.size(), 1U);
  EXPECT_NEAR(area_of(regions[1], grid), 0.5 / (4.0 * 6.0), 1e-9);
  EXPECT_NEAR(area_of(regions[0], grid) + area_of(regions[1], grid), 1.0, 1e-9);
  EXPECT_EQ(borders_of(regions, grid).size(), 1U);
}

TEST(EdgeMapRegions, OfOneKindAreTheMap) {
  const Grid grid = grid_of_searched_drives();
  const std::vector<PlaceKind> kinds(grid.size(), PlaceKind::not_known);
  const std::vector<MapRegion> regions = gearlash::regions_of(grid, kinds, std::nullopt);
  ASSERT_EQ(regions.size(), 1U);
  EXPECT_EQ(regions[0].kind, PlaceKind::not_known);
  EXPECT_NEAR(area_of(regions[0], grid), 1.0, 1e-9);
  EXPECT_TRUE(borders_of(regions, grid).empty());
}

TEST(EdgeMapRegions, StoppedTheirBordersLieHalfWay) {
  for (const Grid& grid : {grid_of_servos(), grid_of_searched_drives()}) {
    test::Stopping stop;
    const std::vector<MapRegion> regions = regions_of(grid, {}, stop);
    ASSERT_EQ(regions.size(), 2U);
    EXPECT_GT(area_of(regions[0], grid), 0.1);
    EXPECT_NEAR(area_of(regions[0], grid) + area_of(regions[1], grid), 1.0, 1e-9);
  }
}

}  // namespace
}  // namespace gearlash::map_regions_test
