// Step responses beside those of a linear second-order system.
#include "question/step_response.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/stopping.hpp"
#include "controllers.hpp"

namespace gearlash::drive::step_response_test {
namespace {

/// The load follows the motor: it weighs nothing, and the gap is none.
ReducedDrive second_order(double damping) {
  ReducedDrive drive;
  drive.motor = {1.0 - 1e-9, {.viscous = 2.0 * damping}};
  drive.load.inertia = 1e-9;
  drive.backlash = 1e-12;
  drive.sensing = {.load_share_of_position = 0.0, .load_share_of_speed = 0.0};
  drive.controller = at_load(PID{.proportional = 1.0});
  return drive;
}

TEST(OracleStepResponse, IsThatOfASecondOrderSystem) {
  constexpr double damping = 0.3;
  const double w = std::sqrt(1.0 - damping * damping);
  for (const double step : {1.0, -2.5}) {
    const StepResponse response =
        step_response(second_order(damping), step, 0.05 * std::abs(step), 40.0);
    ASSERT_TRUE(response.is_whole);
    EXPECT_NEAR(response.overshoot.value(), std::exp(-damping * std::numbers::pi / w), 1e-9);
    const auto position = [&](double t) {
      return 1.0 - std::exp(-damping * t) * (std::cos(w * t) + damping / w * std::sin(w * t));
    };
    // Found by bisection on the closed form.
    const auto passing = [&](double level, double low, double high) {
      for (int i = 0; i < 100; ++i) {
        const double middle = 0.5 * (low + high);
        (position(middle) < level ? low : high) = middle;
      }
      return low;
    };
    EXPECT_NEAR(response.rise_time.value(), passing(0.9, 0.0, 3.0) - passing(0.1, 0.0, 3.0), 1e-8);
    // Turning points k π/w: the last beyond 5 % is the third, above.
    const double third = 3.0 * std::numbers::pi / w;
    const double last_out = passing(0.95, 2.0 * std::numbers::pi / w, third);
    EXPECT_LT(1.0 - position(2.0 * std::numbers::pi / w), 0.15);
    EXPECT_GT(std::abs(position(third) - 1.0), 0.05);
    ASSERT_TRUE(response.settling_time);
    EXPECT_GT(*response.settling_time, last_out);
    EXPECT_NEAR(std::abs(position(*response.settling_time) - 1.0), 0.05, 1e-8);
    EXPECT_LT(std::abs(position(4.0 * std::numbers::pi / w) - 1.0), 0.05);
    EXPECT_NEAR(response.final_error / step, 0.0, 1e-4);
  }
}

/// A constant torque pushes the load back by half the step, which a slow integral takes away.
TEST(StepResponse, IsFollowedUntilTheLoadHasArrived) {
  ReducedDrive drive = second_order(0.5);
  drive.controller = at_load(PID{.terms = PIDTerms::PID, .proportional = 1.0, .integral = 2e-3});
  drive.load_torque = -0.5;
  const double usual = usual_step_time(drive);
  ASSERT_FALSE(step_response(drive, 1.0, 0.01, usual).settling_time);
  const StepResponse response = step_response_to_end(drive, 1.0, 0.01, no_progress());
  // 0.5 exp(−0.002 t) = 0.01, but for the short beginning.
  EXPECT_NEAR(response.settling_time.value(), 500.0 * std::log(50.0), 10.0);
  EXPECT_LT(std::abs(response.final_error), 0.01);
}

TEST(StepResponse, SaysWhatDoesNotComeAbout) {
  ReducedDrive drive = second_order(0.3);
  drive.motor.friction.coulomb = drive.motor.friction.breakaway = 2.0;  // more than the step asks
  const StepResponse response = step_response(drive, 1.0, 0.05, 10.0);
  EXPECT_FALSE(response.rise_time);
  EXPECT_FALSE(response.settling_time);
  EXPECT_EQ(response.overshoot, 0.0);
  EXPECT_NEAR(response.final_error, 1.0, 1e-9);
  EXPECT_THROW(step_response(drive, 0.0, 0.05, 10.0), InvalidInput);
  EXPECT_THROW(step_response(drive, 1.0, 0.05, 0.0), InvalidInput);
}

/// It stays in its band from 4 s on, and so would any part of the motion; only the whole shows it.
TEST(StepResponse, IsThatOfTheMotionByThenWhereItIsStopped) {
  test::Stopping impatient(3);
  const ReducedDrive drive = second_order(0.5);
  const StepResponse response = step_response(drive, 1.0, 0.05, 1e6, impatient);
  EXPECT_EQ(impatient.asked, 3);
  EXPECT_FALSE(response.is_whole);
  EXPECT_GT(response.until, 10.0);
  EXPECT_LT(response.until, 1e5);
  EXPECT_TRUE(response.rise_time);
  EXPECT_FALSE(response.settling_time);
  EXPECT_FALSE(response.overshoot);
  EXPECT_TRUE(step_response(drive, 1.0, 0.05, response.until).settling_time);
}

/// Wherever in its swing the motion is when it is no longer watched.
TEST(StepResponse, WhatHuntsBeyondTheBandDoesNotSettle) {
  ReducedDrive drive;
  drive.motor = {1.0 / 3.0, {.viscous = 0.342}};
  drive.load = {2.0 / 3.0, {.viscous = 0.038}};
  drive.backlash = 0.3;
  drive.controller = at_load(PID{.proportional = 1.0});
  for (double until = 60.0; until < 66.5; until += 0.5) {
    const StepResponse response = step_response(drive, 3.0, 0.15, until);
    EXPECT_NEAR(response.ripple, 0.2416, 1e-3);  // of which the band has 0.15
    EXPECT_FALSE(response.settling_time) << until;
  }
}

}  // namespace
}  // namespace gearlash::drive::step_response_test
