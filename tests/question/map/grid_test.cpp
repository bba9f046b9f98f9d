// Axes and grids of servos, on one core and on several.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "base/same_bits.hpp"
#include "base/stopping.hpp"
#include "gearlash/analyse.hpp"
#include "gearlash/parameter.hpp"
#include "question/family/evaluation.hpp"
#include "question/map/grid_pieces.hpp"
#include "question/map/servo_grids.hpp"

namespace gearlash::grid_test {
namespace {

using testing::HasSubstr;

constexpr double infinity = std::numeric_limits<double>::infinity();

Grid grid_of_three() {
  return {.drive = drive_of({.backlash = 0.3}),
          .axes = {spaced_axis("x", "servo.damping", 0.05, 0.65, 13, Spacing::linear),
                   spaced_axis("y", "servo.inertia_ratio", 1e-3, 1e3, 25, Spacing::logarithmic),
                   spaced_axis("z", "servo.friction_ratio", 0.0, 1.0, 41, Spacing::linear)}};
}

TEST(Axis, IsSpacedBetweenItsEndsExactly) {
  const Axis linear = spaced_axis("x", "servo.damping", 0.1, 0.7, 4, Spacing::linear);
  EXPECT_THAT(linear.values, testing::Pointwise(testing::DoubleEq(), {0.1, 0.3, 0.5, 0.7}));
  EXPECT_EQ(linear.values.back(), 0.7);
  const Axis log = spaced_axis("x", "servo.inertia_ratio", 1e-3, 1e3, 7, Spacing::logarithmic);
  EXPECT_EQ(log.values.front(), 1e-3);
  EXPECT_EQ(log.values.back(), 1e3);
  EXPECT_NEAR(log.values[3], 1.0, 1e-15);
  EXPECT_TRUE(log.logarithmic);
  EXPECT_EQ(spaced_axis("x", "servo.damping", 0.1, 0.1, 1, Spacing::linear).values.size(), 1U);
}

TEST(Axis, MeetsWholePowersOfTen) {
  const Axis axis = spaced_axis("x", "servo.inertia_ratio", 1e-9, 1e9, 37, Spacing::logarithmic);
  for (int power = -9; power <= 9; ++power) {
    const auto index = static_cast<std::size_t>(2 * (power + 9));
    EXPECT_EQ(axis.values[index], std::stod("1e" + std::to_string(power)));
  }
}

TEST(EdgeAxis, ManyBadValuesAreOneLine) {
  const std::vector<Fault> faults =
      faults_of_axis({"contact.restitution", {0.5, 1.5, 2.0, 2.5}}, drive_of({}), "--x");
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(to_string(faults[0]), "--x = 1.5 and 2 more: contact.restitution must be from 0 to 1");
}

TEST(EdgeGrid, AMasslessSideMayStandBesideAnyAxis) {
  const Axis damping = spaced_axis("x", "servo.damping", 0.0, 0.9, 10, Spacing::linear);
  for (const double inertia_ratio : {0.0, infinity}) {
    const Grid grid{.drive = drive_of({.inertia_ratio = inertia_ratio, .backlash = 1.0}),
                    .axes = {damping}};
    EXPECT_TRUE(faults(grid, {"--x"}).empty());
    Table table = table_of(grid.size());
    const RowCount count = work_out(grid, 0, table);
    EXPECT_EQ(count.refused, 1U);  // no damping: no friction
  }
  const Grid none{.drive = drive_of({.inertia_ratio = 0.0, .backlash = 1.0}),
                  .axes = {{"servo.friction_ratio", {0.0}}}};
  EXPECT_FALSE(faults(none, {"--x"}).empty());
}

TEST(EdgeAxis, EachFaultIsOneLine) {
  const auto fault = [](double from, double to, std::size_t count, Spacing spacing) {
    try {
      spaced_axis("--x", "servo.damping", from, to, count, spacing);
    } catch (const InvalidInput& error) {
      return std::string(error.what());
    }
    return std::string("none");
  };
  EXPECT_EQ(fault(0.1, 0.5, 0, Spacing::linear), "--x = 0 values: must be from 1 to 1000000");
  EXPECT_EQ(fault(0.1, 0.5, 1, Spacing::linear),
            "--x = 1 value from 0.1 to 0.5: must be two or more between different ends, or one "
            "where they are the same");
  EXPECT_EQ(fault(0.1, 0.5, 1'000'000'000'000, Spacing::linear),
            "--x = 1000000000000 values: must be from 1 to 1000000");
  EXPECT_EQ(fault(0.5, 0.1, 5, Spacing::linear),
            "--x = 0.5 to 0.1: must rise: the smaller value first");
  EXPECT_EQ(fault(0.0, 0.1, 5, Spacing::logarithmic),
            "--x = 0: must be positive on a logarithmic axis");
  EXPECT_EQ(fault(0.1, infinity, 5, Spacing::linear), "--x = 0.1 to inf: must be finite");
}

TEST(Grid, FallsIntoPiecesOfWholeLines) {
  const Grid grid = grid_of_three();  // 13 × 25 × 41
  constexpr std::size_t line = 41;
  for (const std::size_t most :
       std::vector<std::size_t>{1, 2, 40, 41, 42, 500, 1025, 3000, 13324, 13325, 100000}) {
    std::size_t first = 0;
    while (first < grid.size()) {
      const std::size_t count = piece_length(grid, first, most);
      ASSERT_GE(count, 1U);
      ASSERT_LE(count, most);
      ASSERT_LE(first + count, grid.size());
      const bool within_one = first / line == (first + count - 1) / line;
      ASSERT_TRUE(within_one || (first + count) % line == 0)
          << most << ": " << count << " from " << first;
      first += count;
    }
    EXPECT_EQ(first, grid.size());
  }
  EXPECT_EQ(piece_length(grid, 0, 13'325), 13'325U);
  EXPECT_EQ(piece_length(grid, 0, 3000), 73U * line);
  EXPECT_EQ(piece_length(grid, 32, 3000), 9U + 72U * line);
}

TEST(EdgeGrid, FaultsOfAllAxesAreToldAtOnce) {
  const Grid grid{
      .drive = drive_of({.backlash = -1.0}),
      .axes = {
          {"servo.damping", {0.1, -0.2}}, {"servo.friction_ratio", {}}, {"servo.damping", {0.1}}}};
  std::vector<std::string> lines;
  for (const Fault& fault : faults(grid, {"--x", "--y", "--curves"})) {
    lines.push_back(to_string(fault));
  }
  EXPECT_THAT(
      lines,
      testing::ElementsAre(
          HasSubstr("--x = -0.2: servo.damping must be 0 or from"),
          HasSubstr("--x = 0.1 before -0.2: must rise"),
          HasSubstr("--y = no value: must be at least one"),
          HasSubstr("--curves = servo.damping: must be another parameter than that of --x")));
  const Axis million{"servo.damping", std::vector<double>(1'000'000, 0.1)};
  EXPECT_THAT(to_string(faults(Grid{drive_of({}), {million, million}}, {"--x", "--y"}).back()),
              HasSubstr("points = 1e+12: must be at most 1e+09 on all axes together"));
}

TEST(Grid, LastAxisIsFastest) {
  const Grid grid = grid_of_three();
  ASSERT_EQ(grid.size(), 13U * 25U * 41U);
  EXPECT_EQ(grid.at(0).servo->damping, 0.05);
  EXPECT_EQ(grid.at(1).servo->friction_ratio, grid.axes[2].values[1]);
  EXPECT_EQ(grid.at(1).servo->inertia_ratio, 1e-3);
  EXPECT_EQ(grid.at(41).servo->inertia_ratio, grid.axes[1].values[1]);
  EXPECT_EQ(grid.at(grid.size() - 1).servo->damping, 0.65);
}

TEST(PropertyGrid, ThreadsAndVectorUnitsGiveTheSameBits) {
  const Table one = worked_out(grid_of_three(), {.threads = 1});
  for (const std::size_t threads : {2U, 3U, 7U}) {
    EXPECT_TRUE(same_bits(one, worked_out(grid_of_three(), {.threads = threads})));
  }
  for (const VectorUnit unit : available_vector_units()) {
    EXPECT_TRUE(same_bits(one, worked_out(grid_of_three(), {.threads = 2, .unit = unit})));
  }
}

TEST(EdgeGrid, CombinationsThatAreNoServoAreKnownOfNothing) {
  const Grid grid{.drive = drive_of({.damping = 0.2, .backlash = 0.3}),
                  .axes = {{"servo.inertia_ratio", {0.0, 1.0, infinity}},
                           {"servo.friction_ratio", {0.0, 0.5, 1.0}}}};
  ASSERT_TRUE(faults(grid, {"x", "y"}).empty());
  Table table = table_of(grid.size());
  const RowCount count = work_out(grid, 0, table);
  EXPECT_EQ(count.refused, 2U);
  EXPECT_EQ(count.solved.side_by_side + count.solved.one_by_one, 7U);
  for (const std::size_t row : {0U, 8U}) {  // no friction on the side without inertia
    EXPECT_EQ(table.verdict(row), Verdict::undecided);
    EXPECT_TRUE(std::isnan(table[Quantity::growth_at_rest][row]));
  }
  EXPECT_EQ(table.verdict(4), Verdict::hunts);
}

TEST(EdgeGrid, StopsWhenAsked) {
  const Grid grid = grid_of_three();
  Table table = table_of(grid.size());
  test::Stopping progress;
  const RowCount count = work_out(grid, 0, table, {.threads = 2}, progress);
  EXPECT_TRUE(count.stopped);
  EXPECT_GT(progress.heard, 0.0);
  EXPECT_LT(count.points(), grid.size());
}

// ---- any drive ----------------------------------------------------------------------------------

/// A joint with proportional control of the load's position: the servo of 1960 in units.
Drive joint() {
  Drive drive;
  drive.motor = {.inertia = 2e-4, .friction = {.viscous = 1e-3}};
  drive.gearbox = {.ratio = 20.0, .backlash = 0.01};
  drive.load = {.inertia = 0.05, .friction = {.viscous = 0.05}};
  drive.controller.law = PID{.terms = PIDTerms::P, .proportional = 1.0};
  return drive;
}

/// Whether a row says what the answer to the drive says.
void expect_answer(const Table& table, std::size_t row, const Answer& answer) {
  EXPECT_EQ(table.verdict(row), answer.verdict);
  for (const QuantityInfo& info : quantities()) {
    if (!table.has(info.quantity)) continue;
    const std::optional<double> value = answer.value(info.quantity);
    const double found = table[info.quantity][row];
    ASSERT_EQ(value.has_value(), !std::isnan(found)) << info.name;
    // As the header of the lanes says; residuals are rounding alone.
    const bool is_rounding = info.quantity == Quantity::residual;
    const double tolerance = is_rounding ? 1e-11 : 5e-11 * std::abs(value.value_or(0.0));
    if (value) {
      EXPECT_NEAR(found, *value, tolerance) << info.name;
    }
  }
}

TEST(Grid, APlantsPointsAreItsAnswersInSI) {
  const Grid grid{.drive = joint(),
                  .axes = {logarithmic("gearbox.ratio", 5.0, 80.0, 5),
                           linear("gearbox.backlash", 0.001, 0.03, 3)}};
  const Table table = evaluate(
      grid, {Quantity::verdict, Quantity::growth_at_rest, Quantity::amplitude, Quantity::period,
             Quantity::frequency, Quantity::impact_speed, Quantity::load_friction_loss});
  ASSERT_EQ(table.rows(), 15U);
  std::size_t hunting = 0;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    SCOPED_TRACE(row);
    expect_answer(table, row, analyse(grid.at(row)));
    hunting += table.verdict(row) == Verdict::hunts ? 1U : 0U;
  }
  EXPECT_GT(hunting, 3U);
}

TEST(Grid, ANormalFormWithANaturalFrequencyIsInSecondsAndHasNoEnergies) {
  Drive drive = normal_form(0.19, 2.0, 0.1, 0.3);
  drive.servo->natural_frequency = 10.0;
  const Grid grid{.drive = drive, .axes = {linear("servo.damping", 0.1, 0.3, 3)}};
  const Table table = worked_out(grid);
  for (std::size_t row = 0; row < table.rows(); ++row) {
    expect_answer(table, row, analyse(grid.at(row)));
  }
  EXPECT_NEAR(
      table[Quantity::period][1] * 10.0,
      evaluate({normal_form(0.2, 2.0, 0.1, 0.3), {}}, {Quantity::period})[Quantity::period][0],
      1e-12);
}

/// The sensor's place is a word; on the motor there is no closed form.
TEST(Grid, WordsStandOnAxesAndSearchedDrivesBesideServos) {
  Drive drive = joint();
  set(drive, "controller.proportional", 0.3);
  const Grid grid{.drive = drive, .axes = {{"sensor.position", {0.0, 1.0}}}};
  ASSERT_TRUE(faults(grid).empty());
  Table table(2, std::vector{Quantity::amplitude});
  const RowCount count = work_out(grid, 0, table);
  EXPECT_EQ(count.searched, 1U);
  EXPECT_EQ(count.points(), 2U);
  for (const std::size_t row : {0U, 1U}) expect_answer(table, row, analyse(grid.at(row)));
}

TEST(Grid, OptionalPartsAndInverseFormsStandOnAxes) {
  const Grid grid{.drive = joint(), .axes = {{"sampling.frequency", {3000.0, 4000.0}}}};
  EXPECT_TRUE(faults(grid).empty());
  EXPECT_DOUBLE_EQ(grid.at(1).sampling->period, 2.0 * std::numbers::pi / 4000.0);
  const auto fault = [](const char* path, std::vector<double> values) {
    return to_string(faults(Grid{joint(), {{path, std::move(values)}}}, {"--x"}).at(0));
  };
  EXPECT_EQ(fault("gearbox.weight", {1.0}),
            "--x = gearbox.weight: must be a number or a word of the drive");
  EXPECT_EQ(fault("servo.damping", {1.0}),
            "--x = servo.damping: must be a number or a word of the drive");
  EXPECT_EQ(fault("gearbox.ratio", {-1.0, 2.0}),
            "--x = -1: gearbox.ratio must be positive and finite");
  EXPECT_EQ(fault("sensor.position", {1.0, 1.0}),
            "--x = sensor.position: must have each word once");
}

TEST(Table, HasLinesAndTheirLeastValues) {
  const Grid grid{.drive = normal_form(0.2, 1.0, 0.2),
                  .axes = {linear("servo.damping", 0.1, 0.6, 3),
                           logarithmic("servo.inertia_ratio", 0.1, 10.0, 40)}};
  const Table table = evaluate(grid, {Quantity::amplitude});
  EXPECT_EQ(table.line(Quantity::amplitude, 1).data(), &table[Quantity::amplitude][40]);
  const std::size_t least = table.smallest(Quantity::amplitude, 0);
  for (const double value : table.line(Quantity::amplitude, 0)) {
    EXPECT_LE(table.line(Quantity::amplitude, 0)[least], value);
  }
  EXPECT_EQ(table.line(Quantity::amplitude, 2)[table.smallest(Quantity::amplitude, 2)], 0.0);
  EXPECT_THROW((void)table[Quantity::period], InvalidInput);
}

TEST(EdgeGrid, EvaluateRefusesAGridWithFaults) {
  EXPECT_THROW((void)evaluate({normal_form(-1.0, 1.0, 0.2), {}}, {Quantity::amplitude}),
               InvalidInput);
}

}  // namespace
}  // namespace gearlash::grid_test
