// Whether the gap grazes a face was misjudged by 4e-12 of the gap where both shafts ran fast and
// nearly alike: a state held the motor's speed v + u̇ alone, and u̇ was taken from their difference.
#include <gtest/gtest.h>

#include "base/references.hpp"
#include "closed_form/trajectory.hpp"

namespace gearlash::grazing_at_speed_test {
namespace {

// The servo and start as they were found.
struct Start {
  NormalizedServo servo;
  double load_position, load_speed, gap_speed;
};
constexpr Start found{.servo = {.damping = 0.12038,
                                .inertia_ratio = 0.62877,
                                .friction_ratio = 0.34696,
                                .restitution = 0.5},
                      .load_position = 0.588,
                      .load_speed = 164.38,
                      .gap_speed = 0.0030};

ServoState start_in_the_middle() {
  ServoState state{.motor_position = found.load_position,
                   .load_position = found.load_position,
                   .load_speed = found.load_speed};
  state.set_gap_speed(found.gap_speed);
  return state;
}

struct Turning {
  double time;
  Wide height;
};

Turning turning() {
  const References flights("closed_form", "turning_points");
  const Reference& exact = flights.front();
  EXPECT_EQ(exact.input("load_speed"), found.load_speed);
  return {exact.input("first_time"), exact["first_travel"]};
}

/// From the middle of a gap so wide that the turning point is this share of it beyond the face.
Trajectory motion_across(double share, const ServoState& start, const Turning& turning) {
  NormalizedServo servo = found.servo;
  servo.backlash = static_cast<double>(2 * turning.height * (1 - 2 * Wide(share)));
  return simulate(servo, start, {.until = 1.5 * turning.time, .reference = 0.0});
}

TEST(GrazingAtSpeed, IsJudgedByTheGapsOwnSpeed) {
  const Turning top = turning();
  for (const double share : {4e-12, 1e-12, 2e-13}) {
    const ServoState start = start_in_the_middle();
    const Trajectory meets = motion_across(share, start, top);
    ASSERT_EQ(meets.events().size(), 1U) << share;
    EXPECT_EQ(meets.events()[0].face, Face::forward);
    EXPECT_TRUE(meets.touches().empty());
    EXPECT_TRUE(motion_across(-share, start, top).events().empty()) << -share;
  }
}

TEST(GrazingAtSpeed, WasMisjudgedByTheDifferenceOfTwoSpeeds) {
  const Turning top = turning();
  ServoState rounded = start_in_the_middle();
  rounded.motor_speed_remainder = 0.0;
  const double side = rounded.gap_speed() > found.gap_speed ? -1.0 : 1.0;
  EXPECT_EQ(motion_across(side * 1e-12, rounded, top).events().empty(), side > 0.0);
}

TEST(GrazingAtSpeed, IsReportedWhereRoundingDecides) {
  const Turning top = turning();
  for (const double share : {1e-16, -1e-16}) {
    const Trajectory motion = motion_across(share, start_in_the_middle(), top);
    ASSERT_EQ(motion.touches().size(), 1U) << share;
    EXPECT_EQ(motion.touches()[0].face, Face::forward);
    // Where it turns, or where it is said to meet: √(rounding) sooner at most.
    EXPECT_NEAR(motion.touches()[0].time, top.time, 1e-6 * top.time);
  }
}

TEST(GrazingAtSpeed, StatesOfAMotionKeepTheGapsSpeed) {
  const Turning top = turning();
  const Trajectory motion = motion_across(0.1, start_in_the_middle(), top);
  EXPECT_EQ(motion.at(0.0).gap_speed(), found.gap_speed);
  ASSERT_EQ(motion.events().size(), 1U);
  const Event& impact = motion.events()[0];
  EXPECT_EQ(impact.after.gap_speed(), -0.5 * impact.before.gap_speed());
  // The sum alone does not: its last place is 1e-11 of the gap's speed.
  EXPECT_NE(impact.after.motor_speed - impact.after.load_speed, impact.after.gap_speed());
}

}  // namespace
}  // namespace gearlash::grazing_at_speed_test
