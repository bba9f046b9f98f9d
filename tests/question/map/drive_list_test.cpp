// Lists of drives, which need not be on a grid.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "base/same_bits.hpp"
#include "gearlash/analyse.hpp"
#include "gearlash/parameter.hpp"
#include "question/map/servo_grids.hpp"
#include "question/pd_drive.hpp"

namespace gearlash::drive_list_test {
namespace {

using testing::HasSubstr;

constexpr Quantity asked[] = {Quantity::amplitude, Quantity::period, Quantity::growth_at_rest};

TEST(DriveList, HasTheBitsOfTheSameGrid) {
  const Grid grid{.drive = drive_of({.backlash = 0.3}),
                  .axes = {linear("servo.damping", 0.02, 0.9, 60),
                           logarithmic("servo.inertia_ratio", 1e-3, 1e3, 120)}};
  const Table of_grid = evaluate(grid, solved_quantities);
  std::vector<double> dampings;
  std::vector<double> ratios;
  for (std::size_t i = 0; i < grid.size(); ++i) {
    dampings.push_back(grid.axes[0].values[i / 120]);
    ratios.push_back(grid.axes[1].values[i % 120]);
  }
  const Table of_list = evaluate({.drive = grid.drive,
                                  .paths = {"servo.damping", "servo.inertia_ratio"},
                                  .values = {dampings, ratios}},
                                 solved_quantities);
  ASSERT_EQ(of_list.rows(), grid.size());
  EXPECT_TRUE(same_bits(of_list, of_grid));
}

TEST(DriveList, SearchesEachDriveByItself) {
  const Drive drive = pd_drive();
  const std::vector<double> backlashes = {4e-3, 1e-3, 2e-3};
  const Table table =
      evaluate({.drive = drive, .paths = {"gearbox.backlash"}, .values = {backlashes}}, asked);
  for (std::size_t i = 0; i < backlashes.size(); ++i) {
    Drive one = drive;
    set(one, "gearbox.backlash", backlashes[i]);
    const Answer answer = analyse(one, {.proofs = false, .borders = false});
    EXPECT_EQ(table.verdict(i), answer.verdict);
    EXPECT_EQ(table[Quantity::amplitude][i], answer.value(Quantity::amplitude));
  }
}

TEST(DriveList, TakesWordsInAnyOrder) {
  const std::vector<double> places = {1.0, 0.0, 1.0};
  Drive drive = pd_drive();
  set(drive, "controller.proportional", 8.0);
  const Table table =
      evaluate({.drive = drive, .paths = {"sensor.position"}, .values = {places}}, asked);
  EXPECT_EQ(table[Quantity::amplitude][0], table[Quantity::amplitude][2]);
  EXPECT_NE(table[Quantity::amplitude][0], table[Quantity::amplitude][1]);
}

TEST(EdgeDriveList, EveryFaultIsFound) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<double> two = {0.1, nan};
  const std::vector<double> three = {0.1, 0.2, 0.3};
  const std::vector<double> negative = {-1.0, 0.2};
  const Drive drive = drive_of({.backlash = 0.3});
  const auto first = [&](std::vector<std::string> paths,
                         std::vector<std::span<const double>> values) {
    return to_string(faults(DriveList{drive, std::move(paths), std::move(values)}).at(0));
  };
  EXPECT_THAT(first({"servo.damping"}, {two}), HasSubstr("servo.damping[1] = nan"));
  EXPECT_THAT(first({"servo.damping", "servo.backlash"}, {negative, three}),
              HasSubstr("servo.backlash = 3 values"));
  EXPECT_THAT(first({"servo.damping", "servo.backlash"}, {three}), HasSubstr("as many as paths"));
  EXPECT_THAT(first({"servo.damping"}, {negative}), HasSubstr("-1"));
  EXPECT_THAT(first({"servo.nonsense"}, {three}), HasSubstr("servo.nonsense"));
  EXPECT_THROW((void)evaluate(DriveList{drive, {"servo.damping"}, {negative}}, asked),
               InvalidInput);
}

}  // namespace
}  // namespace gearlash::drive_list_test
