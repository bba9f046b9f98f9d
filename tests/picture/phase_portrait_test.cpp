// Phase planes of searched drives: ways, starts, borders, and leaps of speed.
#include "picture/phase_portrait.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "picture/attractor_picture.hpp"
#include "picture/gnuplot.hpp"
#include "picture/hunting_drive.hpp"
#include "picture/svg_reading.hpp"
#include "question/analyse.hpp"

namespace gearlash::phase_portrait_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// It hunts from all starts.
Drive limited_drive() {
  Drive drive = test::hunting_drive();
  drive.motor.limit = 2.0;
  return drive;
}

MotionPicture portrait_of(const Drive& drive, const Analysis& analysis, const Basins* basins) {
  MotionPicture picture = attractor_picture("title", drive, analysis.reduced, *analysis.search);
  const auto plane = plane_to_draw(picture, analysis.reduced, *analysis.search);
  if (!plane) throw std::runtime_error("no plane");
  add_portrait(picture, analysis.reduced, *analysis.search, *plane, basins);
  return picture;
}

TEST(PhasePortrait, ShowsTheWaysToTheHuntingUnderOneName) {
  const Drive drive = limited_drive();
  const Analysis analysis = analyse_in_full(drive);
  ASSERT_FALSE(has_several_basins(*analysis.search));
  const MotionPicture picture = portrait_of(drive, analysis, nullptr);
  const auto ways =
      std::count_if(picture.motions.begin(), picture.motions.end(),
                    [](const DrawnMotion& drawn) { return drawn.role == MotionRole::to_hunting; });
  EXPECT_GE(ways, 8);
  const std::string svg = draw(phase_plot(picture), PictureFormat::svg);
  EXPECT_EQ(test::count_of(">load, on its way to hunting</tspan>", svg), 1U);
  EXPECT_THAT(svg, AllOf(HasSubstr("load, stable cycle"), Not(HasSubstr("border between basins")),
                         Not(HasSubstr("start that leads"))));
}

/// All of the cycle lies in the plane, with both shafts.
TEST(PhasePortrait, ThePlaneHoldsTheHunting) {
  const Drive drive = limited_drive();
  const Analysis analysis = analyse_in_full(drive);
  const MotionPicture picture = portrait_of(drive, analysis, nullptr);
  const double amplitude = analysis.answer.cycles.front().amplitude;
  EXPECT_GT(picture.window->positions.high, 1.05 * amplitude);
  EXPECT_LT(picture.window->positions.high, 3.0 * amplitude);
  const Motion& cycle = picture.motions.front().motion;
  for (int i = 0; i < 100; ++i) {
    const Shafts shafts = cycle.at(cycle.end_time() * i / 100.0).shafts;
    EXPECT_LT(std::abs(shafts.motor_speed), picture.window->speeds.high);
    EXPECT_LT(std::abs(shafts.load_speed), picture.window->speeds.high);
  }
}

TEST(PhasePortrait, MarksStartsByTheirEndAndTheBorder) {
  const Drive drive = limited_drive();
  const Analysis analysis = analyse_in_full(drive);
  const Basins basins{
      .positions = {.path = "position", .values = {-1.0, 1.0}},
      .speeds = {.path = "speed", .values = {-1.0, 1.0}},
      .kinds = {BasinKind::rest, BasinKind::hunting, BasinKind::running_away, BasinKind::rest},
      .borders = {{{-0.5, 0.0}, {0.5, 0.0}}}};
  const MotionPicture picture = portrait_of(drive, analysis, &basins);
  ASSERT_EQ(picture.window->starts.size(), 4U);
  EXPECT_EQ(picture.window->starts[2].position, -1.0);
  EXPECT_EQ(picture.window->starts[2].speed, 1.0);
  EXPECT_EQ(picture.window->starts[2].leads, MotionRole::running_away);
  EXPECT_THAT(draw(phase_plot(picture), PictureFormat::svg),
              AllOf(HasSubstr("start that leads to rest"), HasSubstr(">to hunting<"),
                    HasSubstr(">to running away<"), HasSubstr("border between basins")));
}

TEST(PhasePortrait, ARampHasNoPlaneOfStarts) {
  Drive drive = limited_drive();
  const Analysis analysis = analyse_in_full(drive);
  drive::ReducedDrive reduced = analysis.reduced;
  reduced.reference = drive::Ramp{.rate = 1.0};
  EXPECT_FALSE(plane_to_draw({}, reduced, *analysis.search));
}

/// At an impact the motor's speed leaps at one position: no line of the motor's colour is upright.
TEST(PhasePlane, SpeedsThatLeapAreNotJoinedByTheLineOfTheMotion) {
  Drive drive = normal_form(0.19, 2.0, 0.1, 0.3);
  drive.reference = 1.0;
  MotionPicture picture{.title = "title", .drive = drive};
  picture.period = 6.0;
  picture.motions.push_back({.motion = simulate(drive, {.until = 20.0})});
  const std::string svg = draw(phase_plot(picture), PictureFormat::svg);
  const std::vector<test::Stroke> strokes = test::strokes_of(svg, "stroke='rgb(213,  94,   0)'");
  EXPECT_GT(strokes.size(), 50U);
  for (const test::Stroke& stroke : strokes) {
    constexpr double far = 20.0;  // pixels
    const bool is_upright = std::abs(stroke.right - stroke.from_right) < 0.05 &&
                            std::abs(stroke.down - stroke.from_down) > far;
    EXPECT_FALSE(stroke.is_drawn && is_upright) << stroke.right << " " << stroke.down;
  }
}

}  // namespace
}  // namespace gearlash::phase_portrait_test
