// Charts for programs: the stated error beside exact answers, and what is not interpolated.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "analysis/grid/hunting_end.hpp"
#include "analysis/grid/servo_grids.hpp"
#include "base/seeded_draws.hpp"
#include "closed_form/growth_at_rest.hpp"
#include "gearlash/chart.hpp"

namespace gearlash::design_chart_test {
namespace {

using testing::HasSubstr;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

Axis damping_axis(std::size_t count) {
  return spaced_axis("x", "servo.damping", 0.05, 0.7, count, Spacing::linear);
}
Axis inertia_axis(std::size_t count) {
  return spaced_axis("y", "servo.inertia_ratio", 1.0 / 9.0, 9.0, count, Spacing::logarithmic);
}
Axis friction_axis(std::size_t count) {
  return spaced_axis("z", "servo.friction_ratio", 0.05, 0.95, count, Spacing::linear);
}

/// Part of it hunts, part of it does not.
Grid grid_of_two(std::size_t count) {
  return {.drive = drive_of({.friction_ratio = 0.3, .backlash = 0.3}),
          .axes = {damping_axis(count), inertia_axis(count)}};
}

double drawn_between(SeededDraws& draws, double low, double high, bool logarithmic) {
  if (!logarithmic) return draws.uniform(low, high);
  return std::min(std::max(draws.log_uniform(low, high), low), high);
}

std::vector<double> any_place(SeededDraws& draws, const Grid& grid) {
  std::vector<double> place;
  for (const Axis& axis : grid.axes) {
    place.push_back(
        drawn_between(draws, axis.values.front(), axis.values.back(), axis.logarithmic));
  }
  return place;
}

NormalizedServo servo_there(const Grid& grid, const std::vector<double>& place) {
  NormalizedServo servo = servo_of(grid.drive);
  for (std::size_t axis = 0; axis < place.size(); ++axis) {
    servo.*normal_form_number(grid.axes[axis].path)->member = place[axis];
  }
  return servo;
}

/// About every third axis.
void space_unevenly(SeededDraws& draws, Axis& axis) {
  if (!draws.happens(0.3)) return;
  for (std::size_t i = 1; i + 1 < axis.values.size(); ++i) {
    axis.values[i] += draws.uniform(0.0, 0.4) * (axis.values[i + 1] - axis.values[i]);
  }
}

/// Of 4 to `most` values over one to five decades, linear: most of what varies does so between the
/// first two.
Axis wide_axis(SeededDraws& draws, const char* path, double high, double most) {
  const double to = draws.log_uniform(0.3 * high, high);
  const double from = to * std::pow(10.0, draws.uniform(-5.0, -1.0));
  Axis axis = spaced_axis("axis", path, from, to, static_cast<std::size_t>(draws.uniform(4, most)),
                          Spacing::linear);
  space_unevenly(draws, axis);
  return axis;
}

/// Of 4 to `most` values between ends drawn in what drives have.
Axis any_axis(SeededDraws& draws, const char* path, double low, double high, double most) {
  const double from = drawn_between(draws, low, 0.9 * low + 0.1 * high, true);
  const double to = drawn_between(draws, 0.5 * low + 0.5 * high, high, false);
  const bool logarithmic = draws.happens(0.5);
  Axis axis = spaced_axis("axis", path, from, to, static_cast<std::size_t>(draws.uniform(4, most)),
                          logarithmic ? Spacing::logarithmic : Spacing::linear);
  space_unevenly(draws, axis);
  return axis;
}

Grid any_grid(SeededDraws& draws) {
  NormalizedServo servo{.backlash = 0.3};
  servo.damping = draws.uniform(0.02, 0.9);
  servo.inertia_ratio = draws.log_uniform(0.05, 20.0);
  servo.friction_ratio = draws.uniform(0.02, 0.98);
  Grid grid{.drive = drive_of(servo)};
  const double most = draws.one_of({15.0, 50.0});
  if (draws.happens(0.6)) grid.axes.push_back(any_axis(draws, "servo.damping", 0.02, 1.2, most));
  if (draws.happens(0.6)) {
    grid.axes.push_back(any_axis(draws, "servo.inertia_ratio", 0.01, 50.0, most));
  }
  if (grid.axes.size() < 2) {
    grid.axes.push_back(any_axis(draws, "servo.friction_ratio", 0.02, 0.98, most));
  }
  return grid;
}

/// One axis or two, at least one of them wide.
Grid any_wide_grid(SeededDraws& draws) {
  NormalizedServo servo{.backlash = 0.3};
  servo.damping = draws.log_uniform(1e-4, 0.9);
  servo.inertia_ratio = draws.log_uniform(1e-3, 100.0);
  servo.friction_ratio = draws.uniform(0.02, 0.98);
  Grid grid{.drive = drive_of(servo)};
  const double which = draws.one_of({1.0, 2.0, 3.0});
  if (which != 3.0) grid.axes.push_back(wide_axis(draws, "servo.damping", 1.2, 40.0));
  if (which != 1.0) grid.axes.push_back(wide_axis(draws, "servo.inertia_ratio", 50.0, 40.0));
  if (grid.axes.size() < 2 && draws.happens(0.5)) {
    grid.axes.push_back(any_axis(draws, "servo.friction_ratio", 0.02, 0.98, 40.0));
  }
  return grid;
}

/// As ChartAnswer::error has it.
double error_of(const DesignChart& chart, double value, double exact) {
  const bool growth = chart.quantity() == Quantity::growth_at_rest;
  return std::abs(value - exact) / (growth ? std::max(exact, 1.0) : std::abs(exact));
}

struct Places {
  std::size_t all = 0;
  std::size_t interpolated = 0;
  std::size_t beyond = 0;  // the error stated, which is an estimate
};

/// Compares what is looked up with find_limit_cycles().
void expect_within_stated_error(const DesignChart& chart,
                                const std::vector<std::vector<double>>& looked_up, Places& places) {
  constexpr double rounding = 1e-13;  // of 1/(1/(1 + growth)) − 1
  const std::size_t count = looked_up.size();
  std::vector<NormalizedServo> servos;
  std::vector<ChartAnswer> answers;
  for (const std::vector<double>& place : looked_up) {
    servos.push_back(servo_there(chart.grid(), place));
    answers.push_back(chart.look_up(place));
  }
  Table exact = table_of(count);
  find_limit_cycles(servos, columns_of(exact));
  for (std::size_t i = 0; i < count; ++i) {
    const ChartAnswer& answer = answers[i];
    const double value = exact[chart.quantity()][i];
    ++places.all;
    if (answer.source == ChartSource::interpolated) ++places.interpolated;
    ASSERT_NE(answer.source, ChartSource::outside);
    ASSERT_EQ(answer.verdict, exact.verdict(i));
    ASSERT_EQ(!answer.value, std::isnan(value));
    ASSERT_LE(answer.error.value(), chart.accuracy().stated_error);
    if (std::isnan(value) || answer.value == value) continue;
    const double error = error_of(chart, *answer.value, value);
    if (error > *answer.error + rounding) ++places.beyond;
    ASSERT_LE(error, 3.0 * *answer.error + rounding);
  }
}

void expect_within_stated_error(const DesignChart& chart, SeededDraws& draws, Places& places) {
  std::vector<std::vector<double>> looked_up;
  for (int i = 0; i < 1'000; ++i) looked_up.push_back(any_place(draws, chart.grid()));
  expect_within_stated_error(chart, looked_up, places);
}

/// Half of the places are drawn evenly on each axis, half of them evenly in each decade.
void expect_within_stated_error_by_decades(const DesignChart& chart, SeededDraws& draws,
                                           Places& places) {
  Grid by_decades = chart.grid();
  for (Axis& axis : by_decades.axes) axis.logarithmic = true;
  std::vector<std::vector<double>> looked_up;
  for (int i = 0; i < 500; ++i) {
    looked_up.push_back(any_place(draws, chart.grid()));
    looked_up.push_back(any_place(draws, by_decades));
  }
  expect_within_stated_error(chart, looked_up, places);
}

/// Along the one axis of a chart, and as many close to its first value.
std::vector<std::vector<double>> places_along(const Axis& axis) {
  constexpr int steps = 20'000;
  std::vector<std::vector<double>> places;
  for (int i = 0; i <= steps; ++i) {
    const double share = i / double{steps};
    for (const std::size_t last : {axis.values.size() - 1, std::size_t{1}}) {
      const double value = std::lerp(axis.values.front(), axis.values[last], share);
      places.push_back({std::min(value, axis.values[last])});
    }
  }
  return places;
}

TEST(PropertyDesignChart, AnswersAreWithinTheStatedError) {
  constexpr std::uint64_t seed = 902;
  SCOPED_TRACE(seed);
  SeededDraws draws(seed);
  Places places;
  for (int i = 0; i < 120; ++i) {
    const Grid grid = any_grid(draws);
    const double tolerance = draws.one_of({1e-2, 1e-3, 1e-4});
    for (const Quantity quantity :
         {Quantity::amplitude, Quantity::motor_amplitude, Quantity::growth_at_rest}) {
      SCOPED_TRACE(testing::Message() << "chart " << i << " of " << name_of(quantity));
      const DesignChart chart(grid, quantity, {.tolerance = tolerance});
      ASSERT_LE(chart.accuracy().stated_error, tolerance);
      expect_within_stated_error(chart, draws, places);
      if (HasFatalFailure()) return;
    }
  }
  EXPECT_GT(places.interpolated, places.all / 3);  // or else the test has compared nothing
  EXPECT_LE(places.beyond, places.interpolated / 50'000);
}

TEST(PropertyDesignChart, AnswersAreWithinTheStatedErrorOverSeveralDecadesOnALinearAxis) {
  constexpr std::uint64_t seed = 906;
  SCOPED_TRACE(seed);
  SeededDraws draws(seed);
  Places places;
  for (int i = 0; i < 200; ++i) {
    const Grid grid = any_wide_grid(draws);
    const double tolerance = draws.one_of({1e-2, 1e-3});
    for (const Quantity quantity : {Quantity::amplitude, Quantity::period, Quantity::growth_at_rest,
                                    Quantity::multiplier, Quantity::load_friction_loss}) {
      SCOPED_TRACE(testing::Message() << "chart " << i << " of " << name_of(quantity));
      const DesignChart chart(grid, quantity, {.tolerance = tolerance});
      expect_within_stated_error_by_decades(chart, draws, places);
      if (HasFatalFailure()) return;
    }
  }
  EXPECT_GT(places.interpolated, places.all / 3);
  EXPECT_LE(places.beyond, places.interpolated / 50'000);
}

/// Growth at rest is smallest and largest in the first cell; once it was answered up to 104 times
/// farther off than stated.
TEST(DesignChart, GrowthAtRestThatVariesByDecadesWithinACell) {
  struct Case {
    double lowest_damping;
    std::size_t count;
    double inertia_ratio;
  };
  for (const Case& one : {Case{0.0002, 10, 0.01}, {0.001, 10, 0.01}, {0.0001, 50, 1.0}}) {
    SCOPED_TRACE(one.lowest_damping);
    const Grid grid{
        .drive =
            drive_of({.inertia_ratio = one.inertia_ratio, .friction_ratio = 0.95, .backlash = 0.3}),
        .axes = {spaced_axis("x", "servo.damping", one.lowest_damping, 0.8, one.count,
                             Spacing::linear)}};
    const DesignChart chart(grid, Quantity::growth_at_rest, {.tolerance = 1e-2});
    Places places;
    expect_within_stated_error(chart, places_along(grid.axes.front()), places);
    EXPECT_EQ(places.beyond, 0U);
    EXPECT_GT(places.interpolated, 0U);
  }
}

/// Their errors change sign close to half-way within the first cell, and beside it is no cell that
/// would tell.
TEST(DesignChart, AnErrorThatHappensToBeSmallHalfWay) {
  struct Case {
    Quantity quantity;
    double damping;
    double friction_ratio;
    Axis inertia_ratios;
  };
  const auto from_to = [](double low, double high, std::size_t count) {
    return spaced_axis("x", "servo.inertia_ratio", low, high, count, Spacing::linear);
  };
  for (const Case& one :
       {Case{Quantity::period, 0.310967, 0.0805016, from_to(0.26264, 35.5773, 12)},
        {Quantity::impact_speed, 0.0742811, 0.663, from_to(0.141731, 37.9208, 13)}}) {
    SCOPED_TRACE(name_of(one.quantity));
    const Grid grid{
        .drive = drive_of(
            {.damping = one.damping, .friction_ratio = one.friction_ratio, .backlash = 0.3}),
        .axes = {one.inertia_ratios}};
    const DesignChart chart(grid, one.quantity, {.tolerance = 1e-2});
    Places places;
    expect_within_stated_error(chart, places_along(grid.axes.front()), places);
    EXPECT_EQ(places.beyond, 0U);
    EXPECT_GT(places.interpolated, 0U);
  }
}

TEST(PropertyDesignChart, ThreeAxesAndEveryQuantity) {
  constexpr std::uint64_t seed = 903;
  SCOPED_TRACE(seed);
  SeededDraws draws(seed);
  Places places;
  const Grid grid{.drive = drive_of({.backlash = 0.3}),
                  .axes = {damping_axis(15), inertia_axis(16), friction_axis(17)}};
  for (const Quantity quantity : closed_form_quantities) {
    if (quantity == Quantity::residual) continue;  // rounding alone
    SCOPED_TRACE(name_of(quantity));
    expect_within_stated_error(DesignChart(grid, quantity, {.tolerance = 1e-2}), draws, places);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(places.interpolated, places.all / 3);
  EXPECT_EQ(places.beyond, 0U);
}

TEST(OracleDesignChart, TheThesissChart) {
  const Grid grid{.drive = drive_of({.damping = 0.1, .backlash = 0.3}),
                  .axes = {inertia_axis(100), friction_axis(100)}};
  const DesignChart chart(grid, Quantity::amplitude);
  EXPECT_EQ(chart.accuracy().solved_share, 0.0);
  // Of 97 intervals two parts, of the first and the last four; the corners are not compared.
  EXPECT_EQ(chart.accuracy().checked_points, 301U * 301U - 4U * 99U * 99U);
  EXPECT_LT(chart.accuracy().stated_error, 2e-5);
  EXPECT_LT(chart.accuracy().largest_error, 6e-6);
  EXPECT_LT(chart.accuracy().typical_error, 3e-8);
  // In forty digits: tests/closed_form/lanes/cycle_batch_test.cpp.
  const ChartAnswer answer = chart.look_up({0.25, 0.2});
  EXPECT_EQ(answer.source, ChartSource::interpolated);
  EXPECT_EQ(answer.verdict, Verdict::hunts);
  EXPECT_NEAR(answer.value.value(), 0.791450654824151, answer.error.value() * 0.79);
}

TEST(DesignChart, GivesTheValuesOfItsGrid) {
  const Grid grid = grid_of_two(12);
  const Table table = worked_out(grid);
  for (const Quantity quantity : {Quantity::amplitude, Quantity::growth_at_rest}) {
    const DesignChart chart(grid, quantity);
    for (std::size_t i = 0; i < grid.size(); ++i) {
      const NormalizedServo servo = servo_of(grid.at(i));
      const ChartAnswer answer = chart.look_up({servo.damping, servo.inertia_ratio});
      ASSERT_EQ(answer.verdict, table.verdict(i));
      const double exact = of_motion(table, quantity, i);
      ASSERT_EQ(!answer.value, std::isnan(exact));
      if (!answer.value) continue;
      ASSERT_NEAR(*answer.value, exact, 1e-13 * exact);
    }
  }
}

TEST(DesignChart, ServosThatCannotHuntHaveAVerdictAndNoValue) {
  const DesignChart chart(grid_of_two(40), Quantity::amplitude);
  const ChartAnswer quiet = chart.look_up({0.65, 1.05});
  EXPECT_EQ(quiet.source, ChartSource::interpolated);
  EXPECT_EQ(quiet.verdict, Verdict::cannot_hunt);
  EXPECT_FALSE(quiet.value);
  EXPECT_EQ(quiet.error, 0.0);
}

TEST(DesignChart, TheVerdictIsRightNextToTheEndOfHunting) {
  const Grid grid = grid_of_two(25);
  for (const Quantity quantity : {Quantity::amplitude, Quantity::growth_at_rest}) {
    const DesignChart chart(grid, quantity);
    for (const double inertia_ratio : {0.2, 0.5, 1.0, 3.0}) {
      const double end = hunting_end(
          [&](double damping) {
            return servo_there(grid, {damping, inertia_ratio});
          },
          0.05, 0.7);
      for (const double distance : {1e-6, 1e-4, 1e-2}) {
        const ChartAnswer hunting = chart.look_up({end * (1.0 - distance), inertia_ratio});
        const ChartAnswer quiet = chart.look_up({end * (1.0 + distance), inertia_ratio});
        EXPECT_EQ(hunting.verdict, Verdict::hunts);
        EXPECT_EQ(quiet.verdict, Verdict::cannot_hunt);
        EXPECT_EQ(hunting.source, ChartSource::solved);
        EXPECT_EQ(hunting.error, 0.0);
        EXPECT_TRUE(hunting.value);
      }
    }
  }
}

/// With equal frictions the boundary is symmetric in the logarithm of the inertia ratio, so that it
/// turns at 1: here it enters a chart across its border and leaves it again before it comes to the
/// next point that was solved.
TEST(DesignChart, TheVerdictIsRightWhereHuntingEndsBetweenThePointsOfACell) {
  Grid grid{.drive = drive_of({.friction_ratio = 0.5, .backlash = 0.3}),
            .axes = {{"servo.damping", {}}, {"servo.inertia_ratio", {}, true}}};
  const auto growth = [&](double damping, double inertia_ratio) {
    return growth_at_rest(servo_dynamics(servo_there(grid, {damping, inertia_ratio})));
  };
  const auto end = [&](double inertia_ratio) {
    return hunting_end(
        [&](double damping) {
          return servo_there(grid, {damping, inertia_ratio});
        },
        0.01, 0.9);
  };
  for (const double quarters : {-9.0, -5.0, -1.0, 3.0, 7.0}) {  // of an interval of logarithms
    grid.axes[1].values.push_back(std::exp(0.25 * quarters));
  }
  const double turn = end(1.0);
  const double border = 0.5 * (turn + end(std::exp(0.25)));
  const double towards_turn = turn > border ? 0.01 : -0.01;
  for (const double steps : {0.0, 1.0, 2.0, 3.0}) {
    grid.axes[0].values.push_back(border + towards_turn * steps);
  }
  std::sort(grid.axes[0].values.begin(), grid.axes[0].values.end());
  const double within = 0.5 * (turn + border);
  const bool hunts = growth(within, 1.0) > 1.0;
  for (const double logarithm : {-0.25, 0.25, 0.75}) {  // all that was solved has the other verdict
    ASSERT_NE(growth(border, std::exp(logarithm)) > 1.0, hunts);
    ASSERT_NE(growth(border + towards_turn, std::exp(logarithm)) > 1.0, hunts);
  }
  const DesignChart chart(grid, Quantity::growth_at_rest, {.tolerance = 1.0});
  EXPECT_EQ(chart.look_up({within, 1.0}).verdict, hunts ? Verdict::hunts : Verdict::cannot_hunt);
}

TEST(DesignChart, WithoutToleranceEveryServoIsSolved) {
  const Grid grid = grid_of_two(10);
  const DesignChart chart(grid, Quantity::amplitude, {.tolerance = 0.0});
  EXPECT_EQ(chart.accuracy().checked_points, 0U);
  SeededDraws draws(904);
  for (int i = 0; i < 100; ++i) {
    const std::vector<double> place = any_place(draws, grid);
    const ChartAnswer answer = chart.look_up(place);
    if (answer.source == ChartSource::interpolated) {
      EXPECT_EQ(answer.verdict, Verdict::cannot_hunt);  // there is no value to be wrong
      continue;
    }
    const NormalizedServo servo = servo_there(grid, place);
    Table exact = table_of(1);
    find_limit_cycles({&servo, 1}, columns_of(exact));
    EXPECT_EQ(answer.verdict, exact.verdict(0));
    if (answer.verdict != Verdict::hunts) continue;
    EXPECT_EQ(answer.value, exact[Quantity::amplitude].front());
  }
}

TEST(DesignChart, AFinerGridIsSolvedInFewerCells) {
  double share = 1.0;
  for (const std::size_t count : {20U, 60U, 180U}) {
    const DesignChart chart(grid_of_two(count), Quantity::amplitude);
    EXPECT_LT(chart.accuracy().solved_share, 0.7 * share);
    share = chart.accuracy().solved_share;
  }
}

TEST(PropertyDesignChart, ThreadsGiveTheSameAnswers) {
  constexpr std::uint64_t seed = 905;
  SCOPED_TRACE(seed);
  const Grid grid = grid_of_two(30);
  const DesignChart one(grid, Quantity::period, {.threads = 1});
  for (const std::size_t threads : {2U, 7U}) {
    const DesignChart several(grid, Quantity::period, {.threads = threads});
    EXPECT_EQ(several.accuracy(), one.accuracy());
    SeededDraws draws(seed);
    for (int i = 0; i < 1'000; ++i) {
      const std::vector<double> place = any_place(draws, grid);
      ASSERT_EQ(several.look_up(place), one.look_up(place));
    }
  }
}

TEST(EdgeDesignChart, NothingIsExtrapolated) {
  const DesignChart chart(grid_of_two(10), Quantity::amplitude);
  for (const std::vector<double>& place : {std::vector{std::nextafter(0.05, 0.0), 1.0},
                                           {std::nextafter(0.7, 1.0), 1.0},
                                           {0.1, 0.1},
                                           {0.1, 9.1},
                                           {not_known, 1.0},
                                           {0.1, not_known},
                                           {infinity, 1.0},
                                           {-infinity, 1.0}}) {
    const ChartAnswer answer = chart.look_up(place);
    EXPECT_EQ(answer.source, ChartSource::outside);
    EXPECT_EQ(answer.verdict, Verdict::undecided);
    EXPECT_FALSE(answer.value);
    EXPECT_FALSE(answer.error);
  }
  EXPECT_NE(chart.look_up({0.05, 1.0 / 9.0}).source, ChartSource::outside);
  EXPECT_NE(chart.look_up({0.7, 9.0}).source, ChartSource::outside);
}

TEST(EdgeDesignChart, APlaceHasAValueForEachAxis) {
  const DesignChart chart(grid_of_two(10), Quantity::amplitude);
  EXPECT_THAT([&] { (void)chart.look_up({0.1}); },
              testing::ThrowsMessage<InvalidInput>(
                  HasSubstr("place = 1 values: must be 2, one for each axis")));
}

std::string fault_of(const Grid& grid, double tolerance = 1e-3) {
  try {
    const DesignChart chart(grid, Quantity::amplitude, {.tolerance = tolerance});
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "none";
}

TEST(EdgeDesignChart, FaultsAreToldAtOnce) {
  const std::string faults =
      fault_of({.drive = drive_of({.damping = 0.1, .backlash = -1.0}),
                .axes = {{"servo.friction_ratio", {0.1, 0.2, 0.3}},
                         {"servo.inertia_ratio", {1.0, 2.0, 3.0, infinity}}}},
               1.5);
  EXPECT_THAT(faults, HasSubstr("backlash = -1: must be"));
  EXPECT_THAT(faults, HasSubstr("axis 1 = 3 values: must be at least 4"));
  EXPECT_THAT(faults, HasSubstr("axis 2 = inf: must be finite"));
  EXPECT_THAT(faults, HasSubstr("tolerance = 1.5: must be from 0 to 1"));
  EXPECT_THAT(fault_of(grid_of_two(10), not_known), HasSubstr("tolerance = nan: must be"));
  EXPECT_EQ(fault_of({.drive = drive_of({.backlash = 0.3}), .axes = {}}),
            "axes = none: must be at least one");
  EXPECT_THAT(fault_of({drive_of({.backlash = 0.3}), {{"servo.damping", {0.4, 0.3, 0.2, 0.1}}}}),
              HasSubstr("axis 1 = 0.4 before 0.3: must rise"));
  EXPECT_THAT(
      fault_of({drive_of({.backlash = 0.3}), {{"servo.damping", {0.0, 0.1, 0.2, 0.3}, true}}}),
      HasSubstr("axis 1 = 0: must be positive on a logarithmic axis"));
  EXPECT_THAT(fault_of({drive_of({.backlash = 0.3}), {{"servo.damping", {0.0, 1e-15, 0.2, 0.3}}}}),
              HasSubstr("axis 1 = 2.5e-16 and 2 more: servo.damping must be"));
  EXPECT_THAT(fault_of(grid_of_two(6'000)), HasSubstr("points = 144072009: must be at most"));
}

TEST(EdgeDesignChart, GrowthMayBeInfinite) {
  const Grid grid{.drive = drive_of({.damping = 0.3, .backlash = 0.3}),
                  .axes = {{"servo.friction_ratio", {0.0, 0.02, 0.04, 0.06, 0.08, 0.1}}}};
  const DesignChart chart(grid, Quantity::growth_at_rest, {.tolerance = 1e-2});
  EXPECT_EQ(chart.look_up({0.0}).value, infinity);
  for (const double friction_ratio : {1e-6, 0.05}) {
    const ChartAnswer answer = chart.look_up({friction_ratio});
    // Next to the infinite one, which is interpolated as 0, no error can be told relative to it.
    EXPECT_EQ(answer.source,
              friction_ratio < 0.02 ? ChartSource::solved : ChartSource::interpolated);
    const double exact = analyse_limit_cycles(servo_there(grid, {friction_ratio})).growth_at_rest;
    EXPECT_NEAR(answer.value.value(), exact, answer.error.value() * exact);
  }
}

TEST(EdgeDesignChart, NoBacklashIsUnlikeAnyBacklash) {
  const Grid grid{.drive = drive_of({.damping = 0.2}),
                  .axes = {{"servo.backlash", {0.0, 0.1, 0.2, 0.3, 0.4}}}};
  const DesignChart chart(grid, Quantity::growth_at_rest);
  EXPECT_EQ(chart.look_up({0.0}).verdict, Verdict::cannot_hunt);
  EXPECT_EQ(chart.look_up({1e-6}).verdict, Verdict::hunts);
  EXPECT_EQ(chart.look_up({1e-6}).source, ChartSource::solved);
  EXPECT_EQ(chart.look_up({0.35}).source, ChartSource::interpolated);
}

TEST(EdgeDesignChart, CombinationsThatAreNoServoAreOutside) {
  const Grid grid{.drive = drive_of({.damping = 0.2, .backlash = 0.3}),
                  .axes = {{"servo.inertia_ratio", {0.0, 0.1, 0.2, 0.3}},
                           {"servo.friction_ratio", {0.0, 0.1, 0.2, 0.3}}}};
  const DesignChart chart(grid, Quantity::amplitude);
  EXPECT_EQ(chart.look_up({0.0, 0.0}).source, ChartSource::outside);
  EXPECT_EQ(chart.look_up({0.01, 0.01}).verdict, Verdict::hunts);
}

TEST(DesignChart, WithRestitutionUnlikeCellsAreSolved) {
  const Grid grid{
      .drive =
          drive_of({.damping = 0.19, .inertia_ratio = 2.0, .friction_ratio = 0.1, .backlash = 0.3}),
      .axes = {{"contact.restitution", {0.1, 0.15, 0.2, 0.25}}}};
  for (const double damping : {0.19, 0.6}) {
    Grid of_damping = grid;
    of_damping.drive.servo->damping = damping;
    const DesignChart chart(of_damping, Quantity::amplitude, {.tolerance = 1e-2});
    for (const double restitution : {0.12, 0.17}) {
      const LimitCycleAnalysis exact = analyse_limit_cycles(servo_there(of_damping, {restitution}));
      const LimitCycle* cycle = largest_stable(exact);
      const ChartAnswer answer = chart.look_up({restitution});
      EXPECT_EQ(answer.verdict, exact.verdict);
      ASSERT_EQ(!answer.value, cycle == nullptr);
      if (cycle == nullptr) continue;
      EXPECT_NEAR(*answer.value, cycle->amplitude, answer.error.value() * cycle->amplitude);
    }
  }
}

}  // namespace
}  // namespace gearlash::design_chart_test
