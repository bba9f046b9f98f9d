// Version 0.1 called some statements proved that were false, or rested on a comparison of two
// doubles. Each counterexample that an audit found, with the right answer (sixty digits).
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "closed_form/growth_at_rest.hpp"
#include "closed_form/limit_cycle.hpp"
#include "closed_form/trajectory.hpp"
#include "model/reduced_drive.hpp"
#include "question/change/drives.hpp"
#include "question/change/target.hpp"
#include "question/change/values.hpp"

namespace gearlash::what_is_called_proved_test {
namespace {

NormalizedServo servo_of(double damping, double inertia_ratio, double friction_ratio,
                         double backlash = 0.3) {
  return {.damping = damping,
          .inertia_ratio = inertia_ratio,
          .friction_ratio = friction_ratio,
          .backlash = backlash};
}

// "The load never comes to rest" of servos that rest with the faces together on the backward face.
TEST(RegressionProved, OverdampedServosThatHuntAlsoRest) {
  for (const NormalizedServo& servo :
       {servo_of(3.0, 1.0, 0.002), servo_of(1.5, 1.0, 0.0, 0.1), servo_of(1.1, 1.0, 0.01, 0.1)}) {
    const LimitCycleAnalysis analysis = enclose_limit_cycles(servo, Reading::decimal);
    EXPECT_EQ(analysis.verdict, Verdict::hunts);
    EXPECT_TRUE(analysis.is_proved());
    EXPECT_TRUE(analysis.rests_engaged);
  }
  const NormalizedServo servo = servo_of(3.0, 1.0, 0.002);
  const Trajectory step =
      simulate(servo, engaged_start(servo, 0.0, 0.0, 1.0), {.until = 500.0, .reference = 1.0});
  ASSERT_EQ(step.events().size(), 2U);
  EXPECT_NEAR(step.events()[0].time, 0.649, 1e-3);
  EXPECT_NEAR(step.events()[1].time, 6.06, 1e-2);
  EXPECT_EQ(step.events()[1].face, Face::backward);
  EXPECT_NEAR(step.at(500.0).load_position, 1.0, 1e-9);
}

// Bounds of the growth at rest that did not hold it: rounding to nearest, and 1e-12 for all of it.
TEST(RegressionProved, BoundsHoldOfStronglyDampedServos) {
  const NormalizedServo servo =
      servo_of(662.1907560443809, 1.5655166617629133e-5, .9999994345814354);
  const double exact = 0.008317086772357897;  // of the doubles, in sixty digits
  const double unknown = std::numeric_limits<double>::quiet_NaN();
  const Bounds bounds = bound_cycles(box_of(servo, Reading::exact), unknown).growth_at_rest;
  EXPECT_LT(bounds.low, exact + 1e-17);
  EXPECT_GT(bounds.high, exact - 1e-17);
  EXPECT_LT(bounds.high - bounds.low, 1e-12);  // 1 − f is 5.7e-7
  EXPECT_NEAR(growth_at_rest(servo_dynamics(servo)), exact, 1e-15);
}

TEST(RegressionProved, DesignLeavesOpenWhatTheDataLeaveOpen) {
  const Drive drive =
      drive_of(servo_of(662.1907560443809, 1.5655166617629133e-5, .9999994345814354));
  const auto values_below = [&](double growth) {
    Target target;
    target.require(Quantity::growth_at_rest, {0.0, growth});
    return values(drive, "backlash", target);
  };
  // Version 0.1 called it proved that no backlash does it. The growth is .0083170867724 of the
  // doubles and .0083170868353 of the decimals: 1 − f has seven digits less than f.
  const FeasibleValues between = values_below(0.0083170868);
  ASSERT_EQ(between.undecided.size(), 1U);
  EXPECT_TRUE(between.undecided[0].contains(between.present));
  EXPECT_GT(between.undecided[0].high, 0.99 * between.searched.high);
  const FeasibleValues above = values_below(0.00831709);
  ASSERT_EQ(above.intervals.size(), 1U);
  EXPECT_EQ(above.intervals[0], above.searched);
  EXPECT_TRUE(above.undecided.empty());
  const FeasibleValues below = values_below(0.00831708);
  EXPECT_TRUE(below.intervals.empty());
  EXPECT_TRUE(below.undecided.empty());
}

// The drive that a normal form stands for has the friction of its decimals, 1 − .9999994345814354.
TEST(RegressionProved, APhysicalFormHasTheComplementOfTheDecimal) {
  const Drive drive = physical_form(normal_form(0.5, 2.0, .9999994345814354));
  EXPECT_DOUBLE_EQ(drive.motor.friction.viscous, 5.654185646e-7);
  EXPECT_NE(1.0 - .9999994345814354, 5.654185646e-7);
}

// "At present not met" and "any value meets", both as proved.
TEST(RegressionProved, DesignDoesNotContradictItself) {
  const NormalizedServo servo =
      servo_of(67.15170913401705, .07958454908395947, 2.043082623864931e-06);
  const Drive drive = drive_of(servo);
  const FeasibleValues values = gearlash::values(drive, "backlash", always_at_rest());
  const Judgement at_present = judge(
      always_at_rest(),
      bounds_of(box_of(drive, *settled_servo(drive)), std::numeric_limits<double>::quiet_NaN()));
  // Growth at rest has nothing to do with the backlash: the whole range is as the present value is.
  if (at_present == Judgement::some) {
    ASSERT_EQ(values.undecided.size(), 1U);
    EXPECT_TRUE(values.undecided[0].contains(values.present));
    EXPECT_GT(values.undecided[0].high, 0.99 * values.searched.high);
  } else {
    EXPECT_TRUE(values.undecided.empty());
    EXPECT_EQ(values.contains(values.present), at_present == Judgement::all);
  }
}

// "Cannot hunt, proved" of servos whose growth at rest exceeds 1 by up to 4e-13.
TEST(RegressionProved, NothingIsProvedWhereTheEnclosureTouchesOne) {
  double damping = 67.15170913401705;
  int undecided = 0;
  int proved_quiet = 0;
  int proved_hunting = 0;
  // Through the boundary in steps of a few units in the last place: quiet, undecided, hunting, and
  // no other order.
  double lowest = damping * (1.0 - 1e-9);
  double highest = damping * (1.0 + 1e-9);
  const auto certainty_of = [&](double value) {
    const NormalizedServo servo = servo_of(value, .07958454908395947, 2.043082623864931e-06);
    const LimitCycleAnalysis analysis = enclose_limit_cycles(servo, Reading::exact);
    const Bounds& growth = analysis.bounds->growth_at_rest;
    if (analysis.verdict == Verdict::undecided) {
      EXPECT_FALSE(analysis.is_proved());
      EXPECT_TRUE(growth.contains(1.0));
      return 0;
    }
    EXPECT_TRUE(analysis.is_proved());
    EXPECT_FALSE(growth.low <= 1.0 && growth.high > 1.0);
    return analysis.verdict == Verdict::hunts ? 1 : -1;
  };
  constexpr int steps = 400;
  for (int i = 0; i <= steps; ++i) {
    const int side = certainty_of(lowest + (highest - lowest) * i / steps);
    (side == 0 ? undecided : side > 0 ? proved_hunting : proved_quiet) += 1;
  }
  EXPECT_GT(proved_quiet + proved_hunting, 0);
  EXPECT_LT(undecided, steps);
}

}  // namespace
}  // namespace gearlash::what_is_called_proved_test
