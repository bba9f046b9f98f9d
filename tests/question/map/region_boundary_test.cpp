// The curves that bound a region: of regions whose boundary is known.
#include "question/map/region_boundary.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace gearlash::region_boundary_test {
namespace {

using SideAt = std::function<Side(const MapPoint&)>;

Axis axis(const char* path, double from, double to, std::size_t count,
          Spacing spacing = Spacing::linear) {
  return spaced_axis("axis", path, from, to, count, spacing);
}

Axis unit_axis(std::size_t count) { return axis("servo.friction_ratio", 0.0, 1.0, count); }

std::vector<MapCurve> boundary(const Axis& x, const Axis& y, const SideAt& side_at) {
  std::vector<Side> corners;
  for (const double up : y.values) {
    for (const double along : x.values) corners.push_back(side_at({along, up}));
  }
  return boundary_of_region(x, y, corners, side_at);
}

Side inside_if(bool holds) { return holds ? Side::inside : Side::outside; }

/// Twice the area that a ring goes round against the clock.
double doubled_area(const MapCurve& ring) {
  double sum = 0.0;
  for (std::size_t i = 0; i + 1 < ring.size(); ++i) {
    sum += ring[i].x * ring[i + 1].y - ring[i + 1].x * ring[i].y;
  }
  return sum;
}

TEST(OracleRegionBoundary, CoarseGridGivesASmoothCircle) {
  const auto radius = [](const MapPoint& point) {
    return std::hypot(point.x - 0.47, point.y - 0.52);
  };
  for (const std::size_t count : {5U, 20U, 333U}) {
    const auto curves = boundary(unit_axis(count), unit_axis(count), [&](const MapPoint& point) {
      return inside_if(radius(point) < 0.4);
    });
    ASSERT_EQ(curves.size(), 1U) << count;
    const MapCurve& circle = curves.front();
    EXPECT_EQ(circle.front(), circle.back());
    // A hair's breadth inside: the last bit of a place, some four of the radius.
    for (const MapPoint& point : circle) {
      EXPECT_NEAR(radius(point), 0.4, 1e-15);
    }
    // Chords of a circle of radius r sag by s where they are 2√(2rs) long: that is how far apart
    // the points may be for a sag of twice the straightness.
    for (std::size_t i = 0; i + 1 < circle.size(); ++i) {
      const MapPoint middle{0.5 * (circle[i].x + circle[i + 1].x),
                            0.5 * (circle[i].y + circle[i + 1].y)};
      EXPECT_NEAR(radius(middle), 0.4, 4e-4);
    }
    EXPECT_GT(doubled_area(circle), 0.0);  // the region is on the left
    EXPECT_NEAR(0.5 * doubled_area(circle), M_PI * 0.16, 4e-4);
  }
}

TEST(OracleRegionBoundary, ALineInLogarithmsRunsFromEdgeToEdge) {
  const Axis x = axis("servo.inertia_ratio", 0.01, 100.0, 7, Spacing::logarithmic);
  const Axis y = axis("servo.damping", 0.1, 10.0, 6, Spacing::logarithmic);
  const auto curves =
      boundary(x, y, [](const MapPoint& point) { return inside_if(point.x * point.y < 2.0); });
  ASSERT_EQ(curves.size(), 1U);
  // Below and on the left of it: the curve goes down to the right with the region on its right, so
  // it is followed the other way.
  EXPECT_NEAR(curves[0].front().x, 20.0, 1e-13);
  EXPECT_EQ(curves[0].front().y, 0.1);
  EXPECT_NEAR(curves[0].back().x, 0.2, 1e-15);
  EXPECT_EQ(curves[0].back().y, 10.0);
  for (const MapPoint& point : curves[0]) EXPECT_NEAR(point.x * point.y, 2.0, 2e-14);
}

TEST(EdgeRegionBoundary, ASaddleIsJoinedAsItsMiddleSays) {
  const Axis side = unit_axis(2);
  for (const bool middle_inside : {true, false}) {
    for (const double turn : {1.0, -1.0}) {
      const auto curves = boundary(side, side, [&](const MapPoint& point) {
        const double saddle = turn * (point.x - 0.5) * (point.y - 0.5);
        return inside_if(saddle > (middle_inside ? -0.01 : 0.01));
      });
      ASSERT_EQ(curves.size(), 2U);
      for (const MapCurve& curve : curves) {
        // Neither goes through the middle: each goes round one corner, inside or outside.
        const double along = 0.5 * (curve.front().x + curve.back().x) - 0.5;
        const double up = 0.5 * (curve.front().y + curve.back().y) - 0.5;
        EXPECT_EQ(turn * along * up < 0.0, middle_inside);
        for (const MapPoint& point : curve) {
          EXPECT_NEAR(turn * (point.x - 0.5) * (point.y - 0.5), middle_inside ? -0.01 : 0.01,
                      1e-15);
        }
      }
    }
  }
}

TEST(EdgeRegionBoundary, AllOrNothingHasNone) {
  for (const Side side : {Side::inside, Side::outside, Side::unknown}) {
    EXPECT_TRUE(
        boundary(unit_axis(4), unit_axis(9), [&](const MapPoint&) { return side; }).empty());
  }
}

TEST(EdgeRegionBoundary, NothingPassesWhatIsUnknown) {
  const auto curves = boundary(unit_axis(11), unit_axis(11), [](const MapPoint& point) {
    if (point.x > 0.55) return Side::unknown;
    return inside_if(point.y < 0.33);
  });
  ASSERT_EQ(curves.size(), 1U);
  EXPECT_NEAR(curves[0].back().x, 0.0, 1e-15);
  EXPECT_NEAR(curves[0].front().x, 0.5, 1e-15);
  // Next to the unknown there is no boundary, though one side of it is inside.
  EXPECT_TRUE(boundary(unit_axis(11), unit_axis(11), [](const MapPoint& point) {
                return point.x > 0.55 ? Side::unknown : Side::inside;
              }).empty());
  // Nor where it hides between two points of the grid.
  EXPECT_TRUE(boundary(unit_axis(2), unit_axis(2), [](const MapPoint& point) {
                if (point.x > 0.3 && point.x < 0.7) return Side::unknown;
                return inside_if(point.x < 0.5);
              }).empty());
}

TEST(EdgeRegionBoundary, AnAxisWithoutLengthHasNone) {
  const auto left = [](const MapPoint& point) { return inside_if(point.x < 2.0); };
  const Axis infinite{"servo.inertia_ratio", {1.0, 3.0, INFINITY}};
  EXPECT_TRUE(boundary(infinite, unit_axis(3), left).empty());
  EXPECT_TRUE(boundary(axis("servo.inertia_ratio", 1.0, 1.0, 1), unit_axis(3), left).empty());
}

}  // namespace
}  // namespace gearlash::region_boundary_test
