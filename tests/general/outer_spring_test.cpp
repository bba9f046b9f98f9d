// Springs without a gap, and the stiffness of gravity, beside their equations.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "controllers.hpp"
#include "drives.hpp"
#include "general/assemble/time_scale.hpp"
#include "general/attractors/attractors.hpp"

namespace gearlash::drive::outer_spring_test {
namespace {

ReducedDrive two_shafts() {
  ReducedDrive drive;
  drive.motor = {0.3, {.viscous = 0.02}};
  drive.load = {0.7, {.viscous = 0.05}};
  drive.backlash = 0.01;
  drive.controller = at_load(PID{.proportional = 9.0});
  return drive;
}

hybrid::State state_at(const ReducedDrive& drive, const ShaftStates& start, double time) {
  return moved(drive, start, time).at(time);
}

using Numbers = std::array<double, 4>;  // motor, its speed, load, its speed

TEST(OracleJoined, TheSpringPullsBothWaysByEitherLaw) {
  for (const ContactDamping law : {ContactDamping::limited, ContactDamping::full}) {
    ReducedDrive drive = two_shafts();
    drive.backlash = 0.0;
    drive.contact = CompliantContact{.stiffness = 200.0, .damping = 0.6, .law = law};
    const auto slope = [](const Numbers& x) {
      const double mesh = 200.0 * (x[0] - x[2]) + 0.6 * (x[1] - x[3]);
      return Numbers{x[1], (-9.0 * x[2] - 0.02 * x[1] - mesh) / 0.3, x[3],
                     (mesh - 0.05 * x[3]) / 0.7};
    };
    const ShaftStates start{.motor_position = 0.03, .load_position = -0.02, .load_speed = 0.4};
    const Numbers expected = integrated(Numbers{0.03, 0.0, -0.02, 0.4}, 2.0, 20000, slope);
    const hybrid::State found = state_at(drive, start, 2.0);
    for (Eigen::Index i = 0; i < 4; ++i) {
      EXPECT_NEAR(found.numbers[i], expected[static_cast<std::size_t>(i)], 1e-11);
    }
  }
}

TEST(PropertyJoined, AVerySmallGapOfUndampedFacesIsNone) {
  ReducedDrive drive = two_shafts();
  drive.contact = CompliantContact{.stiffness = 200.0};
  const ShaftStates start{.motor_position = 0.03, .load_position = 0.02, .load_speed = 0.4};
  drive.backlash = 0.0;
  const hybrid::State without = state_at(drive, start, 1.0);
  drive.backlash = 1e-9;
  const hybrid::State with = state_at(drive, start, 1.0);
  EXPECT_LT((with.numbers - without.numbers).cwiseAbs().maxCoeff(), 1e-6);
}

TEST(Joined, HasNoEventsOfContactAndComesToRest) {
  ReducedDrive drive = two_shafts();
  drive.backlash = 0.0;
  drive.contact = CompliantContact{.stiffness = 200.0, .damping = 2.0};
  EXPECT_EQ(drive_system(drive).modes.count(), 1U);
  drive.motor.friction.viscous = 4.0;  // the load's sensor needs damping of the motor
  const AttractorSearch search = find_attractors(drive);
  EXPECT_EQ(search.count(MotionEnd::rest), search.outcomes.size());
}

/// A load that hangs free within a wide gap.
TEST(OracleGravity, AHangingLoadSwingsAsAPendulum) {
  ReducedDrive drive = two_shafts();
  drive.backlash = 100.0;
  drive.load.friction = {};
  drive.gravity = {.stiffness = 5.0, .angle = 0.2};
  const double rate = std::sqrt(5.0 / 0.7);
  for (const double time : {0.3, 1.7, 4.0}) {
    const hybrid::State found = state_at(drive, {.load_position = 0.5}, time);
    EXPECT_NEAR(found.numbers[load_position], 0.2 + 0.3 * std::cos(rate * time), 1e-13);
    EXPECT_NEAR(found.numbers[load_speed], -0.3 * rate * std::sin(rate * time), 1e-13);
  }
}

/// Engaged shafts swing with the stiffnesses of loop and gravity; an upright load takes from it.
TEST(OracleGravity, AddsToTheStiffnessOfTheLoop) {
  for (const double stiffness : {5.0, -5.0}) {
    ReducedDrive drive = two_shafts();
    drive.gravity = {.stiffness = stiffness};
    EXPECT_NEAR(time_scales(drive).swing, 2.0 * std::numbers::pi / std::sqrt(9.0 + stiffness),
                1e-12);
    const double decay = 0.07 / 2.0;
    const double rate = std::sqrt(9.0 + stiffness - decay * decay);
    constexpr double time = 0.2;  // the faces stay together, drawn towards the reference
    const hybrid::State found =
        state_at(drive, {.motor_position = 0.1 - 0.005, .load_position = 0.1}, time);
    const double expected = 0.1 * std::exp(-decay * time) *
                            (std::cos(rate * time) + decay / rate * std::sin(rate * time));
    EXPECT_NEAR(found.numbers[load_position], expected, 1e-13);
  }
}

/// With the load held by dry friction, gravity breaks it away where it exceeds the breakaway
/// torque.
TEST(OracleGravity, BreaksAHeldLoadAway) {
  ReducedDrive drive = two_shafts();
  drive.backlash = 100.0;
  drive.load.friction = {.viscous = 0.05, .coulomb = 1.0, .breakaway = 1.0};
  drive.gravity = {.stiffness = 5.0};
  EXPECT_EQ(state_at(drive, {.load_position = 0.199}, 1.0).numbers[load_position], 0.199);
  EXPECT_NE(state_at(drive, {.load_position = 0.201}, 1.0).numbers[load_position], 0.201);
}

}  // namespace
}  // namespace gearlash::drive::outer_spring_test
