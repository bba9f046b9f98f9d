// The hunting-free boundary against growth at rest, and against long simulations.
#include "question/map/hunting_boundary.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <optional>
#include <random>

#include "closed_form/growth_at_rest.hpp"
#include "closed_form/trajectory.hpp"
#include "question/map/servo_grids.hpp"

namespace gearlash::hunting_boundary_test {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

std::vector<MapCurve> boundary_of(const Grid& grid) {
  return hunting_boundary(grid, worked_out(grid)[Quantity::growth_at_rest]);
}

double growth_of(const NormalizedServo& servo) { return growth_at_rest(servo_dynamics(servo)); }

/// Of all pairs of inputs on which the growth depends, on axes of both kinds.
std::vector<Grid> plastic_grids() {
  return {
      {drive_of({.inertia_ratio = 2.0, .backlash = 1.0}),
       {linear("servo.damping", 0.1, 0.8, 15), linear("servo.friction_ratio", 0.05, 0.95, 17)}},
      {drive_of({.friction_ratio = 0.2, .backlash = 1.0}),
       {linear("servo.damping", 0.1, 0.9, 11), logarithmic("servo.inertia_ratio", 0.05, 20.0, 12)}},
      {drive_of({.damping = 0.5, .backlash = 1.0}),
       {logarithmic("servo.inertia_ratio", 0.05, 20.0, 21),
        linear("servo.friction_ratio", 0.05, 0.95, 9)}},
      {drive_of({.damping = 0.45, .backlash = 1.0}),
       {logarithmic("servo.friction_ratio", 0.03, 0.97, 13),
        logarithmic("servo.inertia_ratio", 0.1, 10.0, 14)}},
      {drive_of({.inertia_ratio = 0.5, .backlash = 1.0}),
       {logarithmic("servo.friction_ratio", 0.03, 0.97, 10),
        logarithmic("servo.damping", 0.2, 0.9, 8)}}};
}

/// How far the place of the boundary may be off along an axis, in shares of it: where the growth
/// changes by the fraction `slope` over the whole axis, an error of the growth by so many epsilons
/// moves it by epsilons/slope; the place itself is rounded, and so is the value there, whose
/// logarithm the axis may have.
double place_tolerance(double slope, double epsilons) {
  return epsilon * (epsilons / std::abs(slope) + 16.0);
}

TEST(PropertyHuntingBoundary, GrowthAtRestIsOneThere) {
  for (const Grid& grid : plastic_grids()) {
    const std::vector<MapCurve> curves = boundary_of(grid);
    ASSERT_FALSE(curves.empty());
    for (const MapCurve& curve : curves) {
      EXPECT_GT(curve.size(), 10U);
      for (const MapPoint& point : curve) {
        // Just inside the region that hunts; a place is exact to an epsilon of its axis, over which
        // the growth changes by less than a hundredfold in these grids; and itself it is good to
        // some twenty.
        const double growth = growth_of(servo_at(grid, point));
        EXPECT_GT(growth, 1.0);
        EXPECT_LT(growth, 1.0 + 200.0 * epsilon) << point.x << ", " << point.y;
      }
    }
  }
}

TEST(PropertyHuntingBoundary, BetweenItsPointsItIsStraight) {
  for (const Grid& grid : plastic_grids()) {
    for (const MapCurve& curve : boundary_of(grid)) {
      for (std::size_t i = 0; i + 1 < curve.size(); ++i) {
        const auto middle = [&](const Axis& axis, double from, double to) {
          return 0.5 * (position_on(axis, from) + position_on(axis, to));
        };
        const double along = middle(grid.axes[1], curve[i].x, curve[i + 1].x);
        const double up = middle(grid.axes[0], curve[i].y, curve[i + 1].y);
        const auto hunts = [&](double right, double higher) {
          return side_of_hunting(servo_at(
              grid, {value_at(grid.axes[1], along + right), value_at(grid.axes[0], up + higher)}));
        };
        // Twice the straightness away, at right angles, both sides are met.
        const double right =
            position_on(grid.axes[1], curve[i + 1].x) - position_on(grid.axes[1], curve[i].x);
        const double higher =
            position_on(grid.axes[0], curve[i + 1].y) - position_on(grid.axes[0], curve[i].y);
        const double scale = 4e-4 / std::hypot(right, higher);
        EXPECT_EQ(hunts(-scale * higher, scale * right), Side::inside);
        EXPECT_EQ(hunts(scale * higher, -scale * right), Side::outside);
      }
    }
  }
}

/// The logarithm of how much a motion that is small against the backlash grows in a half cycle, as
/// the simulation has it: the load rests in the gap at −a while the motor creeps up at a/F_M; each
/// time a shaft has crossed the gap and hits the other face the load rests again, somewhere else.
///
/// a is 1e-6 of the backlash: a crossing then lasts 10⁶F_M, over which what is left of the shafts'
/// motion dies to exp(−10⁶F_M min(c, D)) < exp(−400) for the servos below (F_M and the rates are
/// above 0.02): the half cycle is linear to the last bit.
double simulated_growth(const NormalizedServo& servo) {
  constexpr double start = 1e-6;
  constexpr std::size_t half_cycles = 4;
  const double motor_friction = servo_dynamics(servo).motor_friction;
  const Trajectory motion = simulate(
      servo,
      {.motor_position = -start, .motor_speed = start / motor_friction, .load_position = -start},
      {.until = 20.0 * motor_friction / start, .reference = 0.0});
  std::vector<double> rests;
  std::optional<Face> face;
  for (const Event& event : motion.events()) {
    if (event.kind != EventKind::impact || event.face == face) continue;
    face = event.face;
    rests.push_back(std::abs(event.before.load_position));
  }
  if (rests.size() < 2) return -std::numeric_limits<double>::infinity();
  const std::size_t last = std::min(rests.size() - 1, half_cycles);
  return std::log(rests[last] / rests[0]) / static_cast<double>(last);
}

/// Across the boundary at one of its points, along one axis: position, and what grows there.
struct Crossing {
  const Grid& grid;
  MapPoint point;
  std::size_t axis;

  double place() const { return position_on(grid.axes[axis], axis == 1 ? point.x : point.y); }
  double growth(double place) const {
    MapPoint moved = point;
    (axis == 1 ? moved.x : moved.y) = value_at(grid.axes[axis], place);
    return simulated_growth(servo_at(grid, moved));
  }
};

/// The place where motion neither grows nor dies away, by bisection on simulations.
double simulated_place(const Crossing& crossing, double grows, double dies) {
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (grows + dies);
    (crossing.growth(middle) > 0.0 ? grows : dies) = middle;
  }
  return grows;
}

/// Compares at a point of the curve, along the axis over which the growth changes faster. Nothing
/// is compared next to the plane's edge, where there is no room to bisect.
bool agrees_at(const Grid& grid, const MapPoint& point, double epsilons) {
  constexpr double reach = 1e-3;
  double slope = 0.0;
  Crossing steepest{grid, point, 0};
  for (const std::size_t axis : {0U, 1U}) {
    const Crossing crossing{grid, point, axis};
    const double place = crossing.place();
    if (place < reach || place > 1.0 - reach) continue;
    const double change =
        (crossing.growth(place + reach) - crossing.growth(place - reach)) / (2.0 * reach);
    if (std::abs(change) <= std::abs(slope)) continue;
    slope = change;
    steepest.axis = axis;
  }
  if (slope == 0.0) return false;
  const double place = steepest.place();
  const double towards = slope > 0.0 ? reach : -reach;
  EXPECT_GT(steepest.growth(place + towards), 0.0);
  EXPECT_LT(steepest.growth(place - towards), 0.0);
  EXPECT_NEAR(place, simulated_place(steepest, place + towards, place - towards),
              place_tolerance(slope, epsilons))
      << point.x << ", " << point.y << ", slope " << slope;
  return true;
}

void compare_at_random(const std::vector<Grid>& grids, std::size_t places, double epsilons) {
  std::vector<std::vector<MapCurve>> boundaries;
  for (const Grid& grid : grids) boundaries.push_back(boundary_of(grid));
  constexpr unsigned seed = 1960;
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  const auto any = [&](std::size_t count) {
    return std::uniform_int_distribution<std::size_t>(0, count - 1)(random);
  };
  std::size_t compared = 0;
  for (std::size_t tries = 0; compared < places && tries < 3 * places; ++tries) {
    const std::size_t grid = any(grids.size());
    ASSERT_FALSE(boundaries[grid].empty());
    const MapCurve& curve = boundaries[grid][any(boundaries[grid].size())];
    compared += agrees_at(grids[grid], curve[any(curve.size())], epsilons) ? 1U : 0U;
  }
  EXPECT_EQ(compared, places);
}

TEST(OracleHuntingBoundary, LongSimulationsNeitherGrowNorDieThere) {
  // Four half cycles of some ten roundings each, and the growth itself.
  compare_at_random(plastic_grids(), 200, 50.0);
}

TEST(OracleHuntingBoundary, LongSimulationsWithBouncesNeitherGrowNorDieThere) {
  const Grid grid{
      drive_of({.inertia_ratio = 2.0, .backlash = 1.0, .restitution = 0.3}),
      {linear("servo.damping", 0.3, 0.6, 12), linear("servo.friction_ratio", 0.2, 0.9, 12)}};
  compare_at_random({grid}, 30, 50.0);
}

TEST(EdgeHuntingBoundary, FrictionOnOneSideOnlyAlwaysHunts) {
  // The growth is infinite at friction ratio 0 and 1: the boundary ends at the map's top on either
  // side, short of them.
  const Grid grid{
      drive_of({.inertia_ratio = 2.0, .backlash = 1.0}),
      {linear("servo.damping", 0.0, 0.8, 9), linear("servo.friction_ratio", 0.0, 1.0, 11)}};
  const std::vector<MapCurve> curves = boundary_of(grid);
  ASSERT_EQ(curves.size(), 1U);
  EXPECT_EQ(curves[0].front().y, 0.8);
  EXPECT_EQ(curves[0].back().y, 0.8);
  EXPECT_GT(curves[0].front().x, 0.9);
  EXPECT_LT(curves[0].front().x, 1.0);
  EXPECT_GT(curves[0].back().x, 0.0);
  EXPECT_LT(curves[0].back().x, 0.2);
}

TEST(EdgeHuntingBoundary, BacklashHasNoInfluence) {
  const Grid grid{
      drive_of({.inertia_ratio = 2.0, .friction_ratio = 0.5}),
      {logarithmic("servo.backlash", 1e-3, 1.0, 4), linear("servo.damping", 0.2, 0.8, 7)}};
  const std::vector<MapCurve> curves = boundary_of(grid);
  ASSERT_EQ(curves.size(), 1U);
  EXPECT_EQ(curves[0].front().y, 1e-3);  // upwards: what hunts has less damping, on the left
  EXPECT_EQ(curves[0].back().y, 1.0);
  for (const MapPoint& point : curves[0]) EXPECT_EQ(point.x, curves[0][0].x);
}

TEST(EdgeHuntingBoundary, RefusedCombinationsHaveNone) {
  // A massless load without friction is no servo: nothing is known of the cell beside it.
  const Grid grid{
      drive_of({.damping = 0.5, .backlash = 1.0}),
      {{"servo.inertia_ratio", {0.0, 0.5, 1.0, 2.0}}, linear("servo.friction_ratio", 0.0, 1.0, 6)}};
  const std::vector<MapCurve> curves = boundary_of(grid);
  ASSERT_FALSE(curves.empty());
  for (const MapCurve& curve : curves) {
    for (const MapPoint& point : curve) {
      EXPECT_FALSE(point.x < 0.2 && point.y < 0.5) << point.x << ", " << point.y;
    }
  }
}

}  // namespace
}  // namespace gearlash::hunting_boundary_test
