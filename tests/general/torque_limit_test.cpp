// The limit of a continuous controller's torque, beside motions under constant torque.
#include <gtest/gtest.h>

#include <cmath>

#include "controllers.hpp"
#include "drives.hpp"

namespace gearlash::drive::torque_limit_test {
namespace {

/// J = 2 kg m², K = 8 N m/rad, limit 2 N m, from rest: 1 rad/s² until 0.25 rad are left, then a
/// swing of 2 rad/s, then −1 rad/s² to rest at 2 rad, and all the way back.
TEST(OracleTorqueLimit, BothEndsAreReachedAndLeft) {
  ReducedDrive drive = lone_motor({2.0});
  drive.reference = 1.0;
  drive.controller = at_load(PID{.proportional = 8.0});
  drive.torque_limit = 2.0;
  const double accelerated = std::sqrt(1.5);  // 0.75 rad, and the speed there
  const double swinging = std::atan(2.0 * 0.25 / accelerated);
  const double there = 2.0 * accelerated + swinging;
  const auto motion = moved(drive, {}, 3.0 * there);
  const auto expect = [&](double time, double position, double speed) {
    const hybrid::Vector numbers = motion.at(time).numbers;
    EXPECT_NEAR(numbers[motor_position], position, 1e-13) << time;
    EXPECT_NEAR(numbers[motor_speed], speed, 1e-13) << time;
  };
  expect(0.5, 0.125, 0.5);
  expect(accelerated, 0.75, accelerated);
  expect(accelerated + 0.5 * swinging, 1.0, std::sqrt(1.5 + 0.25));
  expect(accelerated + swinging, 1.25, accelerated);
  expect(there - 0.5, 2.0 - 0.125, 0.5);
  expect(there, 2.0, 0.0);
  expect(2.0 * there, 0.0, 0.0);
  expect(3.0 * there, 2.0, 0.0);
}

/// A motor that nothing moves, 1 rad from its reference, asks for u = P + x while it is given L:
/// u′ = I + (L − u)/T, so that u tends to L + I T and the integral is drawn back.
TEST(OracleTorqueLimit, AntiWindupDrawsTheIntegralBack) {
  constexpr double proportional = 4.0;
  constexpr double integral = 3.0;
  constexpr double tracking_time = 0.5;
  constexpr double limit = 1.0;
  for (const double side : {1.0, -1.0}) {
    ReducedDrive drive = lone_motor({1e15});
    drive.reference = side;
    drive.controller = at_load(PID{.terms = PIDTerms::PID,
                                   .proportional = proportional,
                                   .integral = integral,
                                   .tracking_time = tracking_time});
    drive.torque_limit = limit;
    const auto motion = moved(drive, {}, 3.0);
    constexpr double end = limit + integral * tracking_time;
    for (const double time : {0.1, 0.5, 3.0}) {
      const double asked = end + (proportional - end) * std::exp(-time / tracking_time);
      EXPECT_NEAR(motion.at(time).numbers[controller_states], side * (asked - proportional), 1e-12)
          << time;
    }
  }
}

}  // namespace
}  // namespace gearlash::drive::torque_limit_test
