// Ceilings beside ∫|g|, and gain margins, in many digits, of transfer functions that are written
// down by hand.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "base/references.hpp"
#include "controllers.hpp"
#include "model/reduced_drive.hpp"
#include "question/loop/ceiling/ceiling.hpp"
#include "question/loop/linear_loop.hpp"

namespace gearlash::loop_norm_test {
namespace {

using drive::ReducedDrive;

drive::LinearController law_of(const Reference& loop) {
  const auto number = [&](const char* name) { return loop.input(name); };
  if (loop.kind() == "pid") {
    return at_load(PID{.terms = PIDTerms::PID,
                       .proportional = number("a"),
                       .integral = number("c"),
                       .derivative = number("b"),
                       .filter = number("d")});
  }
  if (loop.kind() == "cascade") {
    return at_load(CascadeController{
        .position = number("a"), .speed = number("b"), .speed_integral = number("c")});
  }
  return at_load(LeadLagController{.gain = number("a"), .zero = number("b"), .pole = number("c")});
}

ReducedDrive drive_of(const Reference& loop) {
  const auto number = [&](const char* name) { return loop.input(name); };
  ReducedDrive drive;
  drive.motor = {number("motor_inertia"), {.viscous = number("motor_viscous")}};
  drive.load = {number("load_inertia"), {.viscous = number("load_viscous")}};
  drive.backlash = 2.0;
  drive.sensing = {.load_share_of_position = number("position_of_load"),
                   .load_share_of_speed = number("speed_of_load")};
  drive.winding = {.time_constant = number("winding"), .back_emf = number("back_emf")};
  drive.gravity.stiffness = number("stiffness");
  drive.controller = law_of(loop);
  return drive;
}

/// PD and PID with a filtered derivative, cascades and lead-lag elements; windings and weights.
TEST(OracleCeiling, IsTheNormInManyDigitsOfRandomLoops) {
  int proved = 0;
  double loosest = 1.0;
  for (const Reference& loop : References("question", "ceilings")) {
    SCOPED_TRACE(testing::Message() << loop.kind() << " " << loop["motor_inertia"]);
    const Ceiling ceiling = ceiling_of(drive_of(loop));
    ASSERT_EQ(ceiling.load.has_value(), loop["decays"] == 1);
    if (!ceiling.load) continue;
    ++proved;
    const double load = loop.input("load");
    const double motor = loop.input("motor");
    EXPECT_GE(*ceiling.load, load * (1.0 - 1e-12));
    EXPECT_GE(*ceiling.motor, motor * (1.0 - 1e-12));
    EXPECT_LE(*ceiling.load, load * 1.0001);
    EXPECT_LE(*ceiling.motor, motor * 1.0001);
    loosest = std::max({loosest, *ceiling.load / load, *ceiling.motor / motor});
  }
  RecordProperty("largest excess over the norm", std::to_string(loosest - 1.0));
  EXPECT_GT(proved, 35);
}

TEST(OracleGainMargin, IsThatInManyDigitsOfRandomLoops) {
  int with = 0;
  int without = 0;
  for (const Reference& loop : References("question", "ceilings")) {
    SCOPED_TRACE(testing::Message() << loop.kind() << " " << loop["motor_inertia"]);
    const std::optional<LinearLoop> figures = drive::loop_figures(drive_of(loop));
    ASSERT_TRUE(figures);
    const double margin = loop.input("margin");
    ASSERT_EQ(figures->gain_margin.has_value(), !std::isnan(margin));
    ++(figures->gain_margin ? with : without);
    if (!figures->gain_margin) continue;
    const double frequency = loop.input("frequency") / (2.0 * std::numbers::pi);
    EXPECT_NEAR(*figures->gain_margin, margin, 1e-9 * margin);
    EXPECT_NEAR(*figures->phase_crossover, frequency, 1e-9 * frequency);
  }
  EXPECT_GT(with, 15);
  EXPECT_GT(without, 15);
}

/// The sample servo of the thesis, and three of its neighbours: to four digits.
TEST(OracleCeiling, OfTheSampleServoAndItsNeighboursInBacklashes) {
  struct Known {
    double damping, inertia_ratio, friction_ratio, ceiling;
  };
  for (const Known& known :
       {Known{0.18861093889995897, 1.992976605137472, 0.07710100231303006, 0.8674},
        Known{0.19, 2.0, 0.1, 0.8542}, Known{0.1, 1.0, 0.2, 1.8597},
        Known{0.4, 4.0, 0.2, 0.5466}}) {
    EXPECT_NEAR(
        *ceiling_of(reduce(normal_form(known.damping, known.inertia_ratio, known.friction_ratio)))
             .load,
        known.ceiling, 6e-5);
  }
}

}  // namespace
}  // namespace gearlash::loop_norm_test
