// A sound servo of light damping and nearly elastic contact was refused by its own analysis: a
// motion that grew for long was handed to simulate() beyond the range of its starts.
#include <gtest/gtest.h>

#include "closed_form/limit_cycle.hpp"

namespace gearlash::sound_servo_is_never_refused_test {
namespace {

TEST(RegressionLimitCycle, ASoundServoIsNeverRefused) {
  const NormalizedServo servo{.damping = 7.9736962637908334e-05,
                              .inertia_ratio = 37.412700866734241,
                              .friction_ratio = 0.75625613728762442,
                              .backlash = 0.3,
                              .restitution = 0.99994110834930883};
  ASSERT_TRUE(faults(servo).empty());
  EXPECT_NO_THROW(analyse_limit_cycles(servo));
}

/// Newton's method had reached a cycle whose period is some 1e14, next to the boundary of hunting.
TEST(RegressionLimitCycle, NorOneOnTheBoundaryOfHunting) {
  const NormalizedServo servo{.damping = 0.4128341770004393,
                              .inertia_ratio = 0.4724670411963044,
                              .friction_ratio = 0.5405594067837346,
                              .backlash = 0.1,
                              .restitution = 0.29205037164501846};
  ASSERT_TRUE(faults(servo).empty());
  EXPECT_NO_THROW(analyse_limit_cycles(servo));
}

}  // namespace
}  // namespace gearlash::sound_servo_is_never_refused_test
