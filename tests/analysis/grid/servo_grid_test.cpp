// Axes and grids of servos, on one core and on several.
#include "analysis/grid/servo_grid.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/same_bits.hpp"

namespace gearlash {
namespace {

using testing::HasSubstr;

constexpr double infinity = std::numeric_limits<double>::infinity();

ServoGrid grid_of_three() {
  return {.servo = {.restitution = 0.0},
          .axes = {spaced_axis("x", Input::damping, 0.05, 0.65, 13, Spacing::linear),
                   spaced_axis("y", Input::inertia_ratio, 1e-3, 1e3, 25, Spacing::logarithmic),
                   spaced_axis("z", Input::friction_ratio, 0.0, 1.0, 41, Spacing::linear)}};
}

CycleTable worked_out(ServoGrid grid, std::size_t threads, VectorUnit unit) {
  grid.servo.backlash = 0.3;
  CycleTable table(grid.size());
  const GridCount count =
      evaluate(grid, 0, grid.size(), table.columns(), {.threads = threads, .unit = unit});
  EXPECT_FALSE(count.stopped);
  EXPECT_EQ(count.solved.side_by_side + count.solved.one_by_one + count.refused, grid.size());
  return table;
}

TEST(Axis, IsSpacedBetweenItsEndsExactly) {
  const Axis linear = spaced_axis("x", Input::damping, 0.1, 0.7, 4, Spacing::linear);
  EXPECT_THAT(linear.values, testing::Pointwise(testing::DoubleEq(), {0.1, 0.3, 0.5, 0.7}));
  EXPECT_EQ(linear.values.back(), 0.7);
  const Axis log = spaced_axis("x", Input::inertia_ratio, 1e-3, 1e3, 7, Spacing::logarithmic);
  EXPECT_EQ(log.values.front(), 1e-3);
  EXPECT_EQ(log.values.back(), 1e3);
  EXPECT_NEAR(log.values[3], 1.0, 1e-15);
  EXPECT_TRUE(log.logarithmic);
  EXPECT_EQ(spaced_axis("x", Input::damping, 0.1, 0.1, 1, Spacing::linear).values.size(), 1U);
}

TEST(Axis, MeetsWholePowersOfTen) {
  const Axis axis = spaced_axis("x", Input::inertia_ratio, 1e-9, 1e9, 37, Spacing::logarithmic);
  for (int power = -9; power <= 9; ++power) {
    const auto index = static_cast<std::size_t>(2 * (power + 9));
    EXPECT_EQ(axis.values[index], std::stod("1e" + std::to_string(power)));
  }
}

TEST(EdgeAxis, ManyBadValuesAreOneLine) {
  const std::vector<Fault> faults = validate({Input::restitution, {0.5, 1.5, 2.0, 2.5}}, "--x");
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(to_string(faults[0]), "--x = 1.5 and 2 more: restitution must be from 0 to 1");
}

TEST(EdgeGrid, AMasslessSideMayStandBesideAnyAxis) {
  const Axis damping = spaced_axis("x", Input::damping, 0.0, 0.9, 10, Spacing::linear);
  for (const double inertia_ratio : {0.0, infinity}) {
    const ServoGrid grid{.servo = {.inertia_ratio = inertia_ratio, .backlash = 1.0},
                         .axes = {damping}};
    EXPECT_TRUE(validate(grid, {"--x"}).empty());
    CycleTable table(grid.size());
    const GridCount count = evaluate(grid, 0, grid.size(), table.columns());
    EXPECT_EQ(count.refused, 1U);  // no damping: no friction
  }
  const ServoGrid none{.servo = {.inertia_ratio = 0.0, .backlash = 1.0},
                       .axes = {{Input::friction_ratio, {0.0}}}};
  EXPECT_FALSE(validate(none, {"--x"}).empty());
}

TEST(EdgeAxis, EachFaultIsOneLine) {
  const auto fault = [](double from, double to, std::size_t count, Spacing spacing) {
    try {
      spaced_axis("--x", Input::damping, from, to, count, spacing);
    } catch (const InvalidInput& error) {
      return std::string(error.what());
    }
    return std::string("none");
  };
  EXPECT_EQ(fault(0.1, 0.5, 0, Spacing::linear), "--x = 0 values: must be from 1 to 1000000");
  EXPECT_EQ(fault(0.1, 0.5, 1, Spacing::linear),
            "--x = 1 values from 0.1 to 0.5: must be two or more between different ends, or one "
            "where they are the same");
  EXPECT_EQ(fault(0.1, 0.5, 1'000'000'000'000, Spacing::linear),
            "--x = 1000000000000 values: must be from 1 to 1000000");
  EXPECT_EQ(fault(0.5, 0.1, 5, Spacing::linear),
            "--x = 0.5 to 0.1: must rise: the smaller value first");
  EXPECT_EQ(fault(0.0, 0.1, 5, Spacing::logarithmic),
            "--x = 0: must be positive on a logarithmic axis");
  EXPECT_EQ(fault(0.1, infinity, 5, Spacing::linear), "--x = 0.1 to inf: must be finite");
}

TEST(Grid, FallsIntoBoxes) {
  const ServoGrid grid = grid_of_three();  // 13 × 25 × 41
  for (const std::size_t most :
       std::vector<std::size_t>{1, 2, 40, 41, 42, 500, 1025, 3000, 13324, 13325, 100000}) {
    std::size_t first = 0;
    while (first < grid.size()) {
      const std::size_t count = box_length(grid, first, most);
      ASSERT_GE(count, 1U);
      ASSERT_LE(count, most);
      ASSERT_LE(first + count, grid.size());
      // Whole rows of the last axis or part of one; whole planes or part of one.
      for (const std::size_t whole : {std::size_t{41}, std::size_t{25 * 41}}) {
        const bool within_one = first / whole == (first + count - 1) / whole;
        ASSERT_TRUE(within_one || (first % whole == 0 && count % whole == 0))
            << most << ": " << count << " from " << first;
      }
      first += count;
    }
    EXPECT_EQ(first, grid.size());
  }
  EXPECT_EQ(box_length(grid, 0, 13'325), 13'325U);
  EXPECT_EQ(box_length(grid, 0, 3000), 2U * 25U * 41U);
}

TEST(EdgeGrid, FaultsOfAllAxesAreToldAtOnce) {
  const ServoGrid grid{
      .servo = {.backlash = -1.0},
      .axes = {
          {Input::damping, {0.1, -0.2}}, {Input::friction_ratio, {}}, {Input::damping, {0.1}}}};
  std::vector<std::string> lines;
  for (const Fault& fault : validate(grid, {"--x", "--y", "--curves"})) {
    lines.push_back(to_string(fault));
  }
  EXPECT_THAT(lines, testing::ElementsAre(
                         HasSubstr("--x = -0.2: damping must be 0 or from"),
                         HasSubstr("--x = 0.1 before -0.2: must rise"),
                         HasSubstr("--y = no value: must be at least one"),
                         HasSubstr("--curves = damping: must be another input than that of --x"),
                         HasSubstr("backlash = -1: must be")));
  const Axis million{Input::damping, std::vector<double>(1'000'000, 0.1)};
  EXPECT_THAT(to_string(validate(ServoGrid{{}, {million, million}}, {"--x", "--y"}).back()),
              HasSubstr("points = 1e+12: must be at most 1e+10"));
}

TEST(Grid, LastAxisIsFastest) {
  const ServoGrid grid = grid_of_three();
  ASSERT_EQ(grid.size(), 13U * 25U * 41U);
  EXPECT_EQ(grid.at(0).damping, 0.05);
  EXPECT_EQ(grid.at(1).friction_ratio, grid.axes[2].values[1]);
  EXPECT_EQ(grid.at(1).inertia_ratio, 1e-3);
  EXPECT_EQ(grid.at(41).inertia_ratio, grid.axes[1].values[1]);
  EXPECT_EQ(grid.at(grid.size() - 1).damping, 0.65);
}

TEST(PropertyGrid, ThreadsAndVectorUnitsGiveTheSameBits) {
  const CycleTable one = worked_out(grid_of_three(), 1, widest_vector_unit());
  for (const std::size_t threads : {2U, 3U, 7U}) {
    EXPECT_TRUE(same_bits(one, worked_out(grid_of_three(), threads, widest_vector_unit())));
  }
  for (const VectorUnit unit : available_vector_units()) {
    EXPECT_TRUE(same_bits(one, worked_out(grid_of_three(), 2, unit)));
  }
}

TEST(PropertyGrid, PartsAreThoseOfTheWhole) {
  ServoGrid grid = grid_of_three();
  const CycleTable whole = worked_out(grid, 2, widest_vector_unit());
  grid.servo.backlash = 0.3;
  constexpr std::size_t first = 5'000;
  constexpr std::size_t count = 4'321;
  CycleTable part(count);
  evaluate(grid, first, count, part.columns());
  for (std::size_t row = 0; row < count; ++row) {
    ASSERT_TRUE(same_bits(part, whole, row, first + row)) << row;
  }
}

TEST(EdgeGrid, CombinationsThatAreNoServoAreKnownOfNothing) {
  const ServoGrid grid{.servo = {.damping = 0.2, .backlash = 0.3},
                       .axes = {{Input::inertia_ratio, {0.0, 1.0, infinity}},
                                {Input::friction_ratio, {0.0, 0.5, 1.0}}}};
  ASSERT_TRUE(validate(grid, {"x", "y"}).empty());
  CycleTable table(grid.size());
  const GridCount count = evaluate(grid, 0, grid.size(), table.columns());
  EXPECT_EQ(count.refused, 2U);
  EXPECT_EQ(count.solved.side_by_side + count.solved.one_by_one, 7U);
  for (const std::size_t row : {0U, 8U}) {  // no friction on the side without inertia
    EXPECT_EQ(table.verdict[row], Verdict::undecided);
    EXPECT_TRUE(std::isnan(table[CycleQuantity::growth_at_rest][row]));
  }
  EXPECT_EQ(table.verdict[4], Verdict::hunts);
}

TEST(EdgeGrid, StopsWhenAsked) {
  ServoGrid grid = grid_of_three();
  grid.servo.backlash = 0.3;
  CycleTable table(grid.size());
  std::size_t heard = 0;
  const GridCount count = evaluate(grid, 0, grid.size(), table.columns(),
                                   {.threads = 2, .going_on = [&](std::size_t done) {
                                      heard = done;
                                      return false;
                                    }});
  EXPECT_TRUE(count.stopped);
  EXPECT_GT(heard, 0U);
  EXPECT_LT(count.solved.side_by_side + count.solved.one_by_one, grid.size());
}

}  // namespace
}  // namespace gearlash
