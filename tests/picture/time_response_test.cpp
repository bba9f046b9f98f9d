// Responses over time: the end enlarged, encoder steps, leaps, and tics that can be read.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "picture/gnuplot.hpp"
#include "picture/hunting_drive.hpp"
#include "picture/motion_picture.hpp"
#include "picture/plot_making.hpp"
#include "picture/shown_end.hpp"
#include "picture/svg_reading.hpp"

namespace gearlash::time_response_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

using test::visible_text;

/// A load that approaches 100 and swings by ±`swing` about it with a period of 2 s; the motor
/// follows `lag` behind.
std::vector<DrawnPiece> swinging(double swing, double lag, double end_time) {
  DrawnPiece piece;
  for (double time = 0.0; time <= end_time; time += 0.01) {
    const double load = 100.0 * (1.0 - std::exp(-time)) + swing * std::sin(std::numbers::pi * time);
    piece.points.push_back(
        {.time = time, .load_position = load, .motor_position = load - lag, .reference = 100.0});
  }
  return {piece};
}

Extent positions_of(const std::vector<DrawnPiece>& pieces) {
  Extent extent;
  for (const DrawnPoint& point : pieces.front().points) extent.include(point.load_position);
  return extent;
}

TEST(ShownEnd, MeasuresThePeriodAndShowsThreeOfThem) {
  constexpr double until = 60.0;
  const std::vector<DrawnPiece> pieces = swinging(0.2, 0.1, until);
  const ShownEnd end = end_of(pieces, until, 0.0);
  EXPECT_NEAR(end.period, 2.0, 0.005);
  EXPECT_NEAR(end.from, until - 6.0, 0.02);
  EXPECT_NEAR(end.load.high, 0.2, 1e-4);
  EXPECT_NEAR(end.motor.low, -0.3, 1e-4);
  EXPECT_EQ(end.reference, 100.0);
  EXPECT_TRUE(is_worth_enlarging(end, positions_of(pieces), 0.1, until));
}

TEST(ShownEnd, TakesAKnownPeriodButAtMostTheLastThird) {
  const std::vector<DrawnPiece> pieces = swinging(0.2, 0.1, 60.0);
  EXPECT_NEAR(end_of(pieces, 60.0, 4.0).from, 48.0, 1e-12);
  EXPECT_NEAR(end_of(pieces, 60.0, 40.0).from, 40.0, 1e-12);
}

TEST(ShownEnd, LargeAndSlowSwingsAreNotEnlarged) {
  const std::vector<DrawnPiece> pieces = swinging(50.0, 0.1, 12.0);
  const ShownEnd end = end_of(pieces, 12.0, 0.0);
  EXPECT_FALSE(is_worth_enlarging(end, positions_of(pieces), 0.1, 12.0));
  // As large, but thirty periods of it cannot be told apart.
  const std::vector<DrawnPiece> many = swinging(50.0, 0.1, 60.0);
  EXPECT_TRUE(is_worth_enlarging(end_of(many, 60.0, 0.0), positions_of(many), 0.1, 60.0));
}

TEST(ShownEnd, RestOnTheReferenceIsNotEnlarged) {
  const std::vector<DrawnPiece> pieces = swinging(0.0, 0.0, 60.0);
  EXPECT_FALSE(is_worth_enlarging(end_of(pieces, 60.0, 0.0), positions_of(pieces), 0.1, 60.0));
}

TEST(ShownEnd, AReferenceFarAwayIsNotShown) {
  ShownEnd end;
  end.load.include(0.8);
  end.load.include(0.9);
  end.motor.include(0.75);
  EXPECT_EQ(end.shown_errors().low, 0.75);
  end.motor.include(0.2);
  EXPECT_EQ(end.shown_errors().low, 0.0);
}

/// The y axis of a panel as high as the gap's.
PlotAxis axis_of(const char* name, const char* unit, const Bounds& range) {
  return finished_y(
      {.y = {.name = name, .unit = unit, .low = range.low, .high = range.high}, .height = 120.0});
}

std::string numbers_of(const PlotAxis& axis) {
  std::string text;
  for (const Tic& tic : axis.tics) text += tic.text + " ";
  return text;
}

TEST(DrawnAxis, NumbersAreShortWhateverTheirSize) {
  const PlotAxis gap = axis_of("gap", "rad", {-2.9e-7, 2.9e-7});
  EXPECT_EQ(gap.label, "gap (nrad)");
  EXPECT_EQ(numbers_of(gap), "-200 0 200 ");
  EXPECT_DOUBLE_EQ(gap.tics.front().at, -2e-7);
  EXPECT_EQ(axis_of("position", "rad", {0.0, 0.016}).label, "position (mrad)");
  EXPECT_EQ(axis_of("position", "deg", {0.0, 0.004}).label, "position (10⁻³ deg)");
  EXPECT_EQ(axis_of("torque", "N m", {-2.5e6, 1e6}).label, "torque (MN m)");
  EXPECT_EQ(axis_of("share", "", {0.0, 0.004}).label, "share (10⁻³)");
  EXPECT_EQ(numbers_of(axis_of("time", "s", {0.0, 3.6})), "0 1 2 3 ");
  EXPECT_EQ(axis_of("position", "deg", {0.0, 25.0}).label, "position (deg)");
}

TEST(DrawnAxis, StepsAreAtMostThoseAskedFor) {
  EXPECT_EQ(round_step(1.0, 6), 0.2);
  EXPECT_EQ(round_step(1.0, 5), 0.2);
  EXPECT_EQ(round_step(1.0, 4), 0.5);
  EXPECT_EQ(round_step(1.0, 10), 0.1);
}

/// A drive of the general engine that hunts, whose encoder has coarse steps.
Drive coarse_drive() {
  Drive drive = test::hunting_drive();
  drive.sensor.encoder.counts_per_turn = 100.0;
  drive.sampling = Sampling{.period = 0.05};
  drive.reference = StepSignal{.before = 0.0, .after = 5.0, .time = 2.0};
  return drive;
}

MotionPicture picture_of(const Drive& drive, double until) {
  MotionPicture picture{.title = "title", .subtitle = "hunts: ±0.2 rad", .drive = drive};
  picture.period = 2.0 * std::numbers::pi;
  picture.motions.push_back({.motion = simulate(drive, {.until = until})});
  return picture;
}

TEST(TimeResponse, TheEndHasAColumnOfItsOwnWithEncoderSteps) {
  const std::string text =
      visible_text(draw(time_plot(picture_of(coarse_drive(), 60.0)), PictureFormat::svg));
  EXPECT_THAT(text, AllOf(HasSubstr("s, enlarged"), HasSubstr("from the reference (rad)"),
                          HasSubstr("encoder reading"), HasSubstr("encoder step 0.0628 rad"),
                          HasSubstr("hunts: ±0.2 rad")));
  Drive exact = coarse_drive();
  exact.sensor.encoder.counts_per_turn.reset();
  EXPECT_THAT(visible_text(draw(time_plot(picture_of(exact, 60.0)), PictureFormat::svg)),
              AllOf(HasSubstr("s, enlarged"), Not(HasSubstr("encoder"))));
}

/// Steps are the reading's only changes, and lie half a step from what is measured.
TEST(TimeResponse, TheEncoderReadsTheNearestStepOfTheLoad) {
  const Drive drive = coarse_drive();
  const double step = 2.0 * std::numbers::pi / *drive.sensor.encoder.counts_per_turn;
  const Plot plot = time_plot(picture_of(drive, 60.0));
  const auto curve_of = [&](const char* name) {
    MapCurve points;
    for (const Layer& layer : plot.columns[0][0].layers) {
      if (layer.name == name) points = layer.points;
    }
    return points;
  };
  const MapCurve reading = curve_of("encoder reading");
  const MapCurve load = curve_of("load");
  ASSERT_GT(reading.size(), 100U);
  std::size_t at = 0;
  for (std::size_t i = 0; i < reading.size(); ++i) {
    EXPECT_NEAR(std::remainder(reading[i].y, step), 0.0, 1e-9);
    const bool is_step = i > 0 && reading[i].y != reading[i - 1].y;
    EXPECT_EQ(reading[i].x, is_step ? reading[i - 1].x : reading[i].x);
    while (at + 2 < load.size() && load[at + 1].x <= reading[i].x) ++at;
    const bool is_last = i + 1 == reading.size() || reading[i + 1].x != reading[i].x;
    if (!is_last || reading[i].x == 2.0) continue;  // where the reference leaps
    const double share = (reading[i].x - load[at].x) / (load[at + 1].x - load[at].x);
    EXPECT_LE(std::abs(reading[i].y - std::lerp(load[at].y, load[at + 1].y, share)), 0.55 * step);
  }
}

TEST(TimeResponse, EachThingHasOneNameInTheLegend) {
  std::string text = draw(time_plot(picture_of(coarse_drive(), 60.0)), PictureFormat::svg);
  // A layer's title is what a browser shows beside the pointer.
  for (std::size_t from = text.find("<title>"); from != std::string::npos;
       from = text.find("<title>", from)) {
    text.erase(from, text.find("</title>", from) - from);
  }
  for (const std::string name : {"gap, ± half the backlash", "faces apart", "encoder reading"}) {
    EXPECT_EQ(test::count_of(name, text), 1U) << name;
  }
}

/// The reference is the only line of its grey: no stroke of it goes from one height to another.
TEST(TimeResponse, ALeapOfTheReferenceIsNotJoinedByALine) {
  const std::string svg = draw(time_plot(picture_of(coarse_drive(), 60.0)), PictureFormat::svg);
  const std::vector<test::Stroke> strokes = test::strokes_of(svg, "stroke='rgb( 85,  85,  85)'");
  EXPECT_GT(strokes.size(), 2U);
  for (const test::Stroke& stroke : strokes) {
    if (!stroke.is_drawn) continue;
    EXPECT_NEAR(stroke.down, stroke.from_down, 0.5);
  }
}

}  // namespace
}  // namespace gearlash::time_response_test
