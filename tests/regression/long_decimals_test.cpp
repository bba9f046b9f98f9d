// A long decimal was taken for the short one of its double, and what holds of that on a boundary
// was called a theorem.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "closed_form/drive_box.hpp"
#include "gearlash/analyse.hpp"
#include "gearlash/grid.hpp"
#include "gearlash/input.hpp"

namespace gearlash::long_decimals_test {
namespace {

Answer answer_of(const std::string& damping, const std::string& ratio, const std::string& friction,
                 const std::string& restitution = "0") {
  return analyse(parse_drive(
      "[servo]\ndamping = " + damping + "\ninertia_ratio = " + ratio + "\nfriction_ratio = " +
      friction + "\nbacklash = '0.3 rad'\n[contact]\nrestitution = " + restitution + "\n"));
}

// ζ = 1, r = 2.75, f = 0.2: f + (1 − f) r = 2.4 = 4ζ² f (1 − f)(1 + r).
TEST(RegressionLongDecimals, OnTheBoundaryOfEnergyTheNumbersOfTheFileDecide) {
  const Answer on_it = answer_of("1", "2.75", "0.2", "0.5");
  EXPECT_EQ(on_it.certainty, Certainty::theorem);
  EXPECT_EQ(on_it.verdict, Verdict::cannot_hunt);
  EXPECT_TRUE(on_it.is_dissipative);
  // The double is 1 and the number is below it, where energy proves nothing. The doubles of the
  // others are the same as before too.
  for (const Answer& beside : {answer_of("0.99999999999999999999", "2.75", "0.2", "0.5"),
                               answer_of("1", "2.75000000000000000000001", "0.2", "0.5"),
                               answer_of("1", "2.75", "0.19999999999999999999999", "0.5")}) {
    EXPECT_LT(beside.certainty, Certainty::enclosed);
    EXPECT_FALSE(beside.is_dissipative);
  }
  // Far from the boundary nothing is lost.
  EXPECT_TRUE(answer_of("1.10000000000000000000001", "2.75", "0.2", "0.5").is_dissipative);
}

// Without motor friction μ₀ is infinite, a theorem. There is some if the friction ratio is below 1.
TEST(RegressionLongDecimals, AShaftWithLittleFrictionIsNotOneWithout) {
  EXPECT_EQ(answer_of("0.5", "2", "1").certainty, Certainty::theorem);
  EXPECT_LT(answer_of("0.5", "2", "0.99999999999999999999").certainty, Certainty::theorem);
}

// From critical damping on some motions end with the faces together.
TEST(RegressionLongDecimals, CriticalDampingIsLeftOpenByRoundedOnes) {
  EXPECT_TRUE(answer_of("1", "1", "0").rests_engaged);
  EXPECT_TRUE(answer_of("0.99999999999999999999", "1", "0").rests_engaged);
  EXPECT_TRUE(answer_of("0.99999999999999988897769753748", "1", "0").rests_engaged);
  EXPECT_FALSE(answer_of("0.9999999999999999", "1", "0").rests_engaged);
  EXPECT_FALSE(answer_of("0.9999999999999000000000001", "1", "0").rests_engaged);
}

TEST(RegressionLongDecimals, ABoxKnowsTheFrictionThatRoundingHides) {
  Drive drive = normal_form(0.5, 2.0, 1.0);
  EXPECT_EQ(box_of(drive, *settled_servo(drive)).servo.motor_rate, (Bounds{0.0, 0.0}));
  drive.is_rounded = true;
  const Bounds rate = box_of(drive, *settled_servo(drive)).servo.motor_rate;
  EXPECT_EQ(rate.low, 0.0);
  EXPECT_GT(rate.high, 0x1p-53);
}

// The bounds hold the cycles of all numbers that round to the same double.
TEST(RegressionLongDecimals, ProvedBoundsHoldTheNeighbours) {
  const Answer rounded = answer_of("0.19000000000000000000001", "2", "0.1");
  ASSERT_TRUE(rounded.bounds);
  EXPECT_EQ(rounded.verdict, Verdict::hunts);
  EXPECT_EQ(rounded.certainty, Certainty::enclosed);
  for (const double damping : {std::nextafter(0.19, 0.0), 0.19, std::nextafter(0.19, 1.0)}) {
    const Answer near = analyse(normal_form(damping, 2.0, 0.1, 0.3));
    EXPECT_LE(rounded.bounds->amplitude.low, near.bounds->amplitude.low);
    EXPECT_GE(rounded.bounds->amplitude.high, near.bounds->amplitude.high);
  }
  bool is_noted = false;
  for (const Note& note : rounded.notes) is_noted |= note.code == "rounded-numbers";
  EXPECT_TRUE(is_noted);
}

// A backlash with a unit is a product of two rounded numbers, not a decimal.
TEST(RegressionLongDecimals, AnglesWithUnitsAreNotDecimals) {
  const auto bounds_of = [](const std::string& backlash) {
    const Drive drive = parse_drive(
        "[servo]\ndamping = 0.19\ninertia_ratio = 2\nfriction_ratio = 0.1\nbacklash = '" +
        backlash + "'\n");
    return analyse(drive).bounds->amplitude;
  };
  const Bounds one = bounds_of("1 arcmin");
  const Bounds ten = bounds_of("10 arcmin");
  // Ten times one is the other, whatever rounding makes of each.
  EXPECT_LT(10.0 * one.low, ten.low * (1.0 + 1e-13));
  EXPECT_LT(ten.high - ten.low, 1e-12 * ten.high);
  constexpr long double arcminute = 3.14159265358979323846264338327950288L / 180 / 60;
  const Bounds unit = bounds_of("1 rad");
  EXPECT_LE(static_cast<long double>(ten.low), 10 * arcminute * unit.low);
  EXPECT_GE(static_cast<long double>(ten.high), 10 * arcminute * unit.high);
}

// "Proved" of grids was of the servo's doubles. Of a data sheet they are rounded from its data.
TEST(RegressionLongDecimals, GridsProveTheirData) {
  const Drive servo = normal_form(0.5, 1.0, 0.5);
  Drive rounded = servo;
  rounded.is_rounded = true;
  for (const Drive& drive : {servo, rounded}) {
    const Grid grid{.drive = drive, .axes = {linear("servo.damping", 0.1, 0.6, 6)}, .proved = true};
    const Table table = evaluate(grid, {Quantity::growth_at_rest});
    EXPECT_EQ(table.verdict(0), Verdict::hunts);
    EXPECT_EQ(table.verdict(5), Verdict::cannot_hunt);
  }
}

}  // namespace
}  // namespace gearlash::long_decimals_test
