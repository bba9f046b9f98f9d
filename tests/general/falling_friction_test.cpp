// Dry friction that falls with speed, beside closed forms and small steps.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "controllers.hpp"
#include "drives.hpp"

namespace gearlash::drive::falling_friction_test {
namespace {

double dry_torque(const ShaftFriction& friction, double speed) {
  const double share = std::max(0.0, 1.0 - std::abs(speed) / friction.stribeck_speed);
  return friction.coulomb + (friction.breakaway - friction.coulomb) * share;
}

/// A load by itself under a constant torque: its speed grows as e^{at} while friction falls, and
/// tends to a limit beyond.
TEST(OracleFallingFriction, AShaftThatBreaksAwayIsTheClosedForm) {
  constexpr double torque = 0.6;
  ReducedDrive drive;
  drive.motor.inertia = 1.0;
  drive.load = {2.0, {.viscous = 0.05, .coulomb = 0.3, .breakaway = 0.5, .stribeck_speed = 0.4}};
  drive.backlash = 1e6;
  drive.load_torque = torque;
  const auto motion = moved(drive, {}, 40.0);
  const double rate = (0.2 / 0.4 - 0.05) / 2.0;
  const double passes = std::log(1.0 + rate * 0.4 * 2.0 / (torque - 0.5)) / rate;
  const auto speed_at = [&](double time) {
    return time < passes ? (torque - 0.5) / 2.0 / rate * std::expm1(rate * time)
                         : 6.0 - (6.0 - 0.4) * std::exp(-0.025 * (time - passes));
  };
  for (const double time : {1.0, 0.9 * passes, passes, 1.5 * passes, 40.0}) {
    EXPECT_NEAR(motion.at(time).numbers[load_speed], speed_at(time), 1e-13) << time;
  }
  ASSERT_EQ(motion.events().size(), 2U);
  EXPECT_NEAR(motion.events()[1].time, passes, 1e-13);
}

/// A mass drawn at a steady speed through a spring: by a shaft whose faces stay together.
ReducedDrive drawn_load() {
  ReducedDrive drive;
  drive.motor.inertia = 0.9;
  drive.load = {0.1, {.viscous = 0.02, .coulomb = 0.3, .breakaway = 0.5, .stribeck_speed = 0.3}};
  drive.backlash = 0.1;
  drive.controller = at_load(PID{.proportional = 1.0});
  drive.reference = Ramp{0.0, 0.1, 0.0};
  return drive;
}

/// Times at which the drawn mass breaks away, by small steps.
std::vector<double> breakaways_by_steps(const ReducedDrive& drive, double until, double step) {
  const ShaftFriction& friction = drive.load.friction;
  const auto acceleration = [&](double time, double position, double speed) {
    return 0.1 * time - position - friction.viscous * speed - dry_torque(friction, speed);
  };
  std::vector<double> times;
  double time = 0.0, position = 0.0, speed = 0.0;
  while (time < until) {
    if (speed == 0.0) {  // held until the spring pulls hard enough
      time = std::max(time, (position + friction.breakaway) / 0.1);
      times.push_back(time);
      speed = 1e-12;
    }
    const double half = 0.5 * step;
    const double a = acceleration(time, position, speed);
    const double b = acceleration(time + half, position + half * speed, speed + half * a);
    const double c =
        acceleration(time + half, position + half * (speed + half * a), speed + half * b);
    const double d =
        acceleration(time + step, position + step * (speed + half * b), speed + step * c);
    const double next = speed + step / 6.0 * (a + 2.0 * b + 2.0 * c + d);
    const double share = next <= 0.0 && time > times.back() + step ? speed / (speed - next) : 1.0;
    position += share * step * (speed + step / 6.0 * (a + b + c) * share);
    time += share * step;
    speed = share < 1.0 ? 0.0 : next;
  }
  return times;
}

TEST(OracleFallingFriction, StickSlipIsThatOfSmallSteps) {
  const ReducedDrive drive = drawn_load();
  const DriveSystem built = drive_system(drive);
  const auto motion = simulate(
      built.system, drive_start(drive, built, {.motor_position = 0.05, .load_position = 0.0}),
      {.until = 80.0});
  std::vector<double> breakaways;
  for (const hybrid::Event& event : motion.events()) {
    if (event.kind != hybrid::EventKind::transition) continue;
    const std::string& name = built.system.mode(event.mode).transitions[event.transition].name;
    if (name == "both break away forward") breakaways.push_back(event.time);
  }
  const std::vector<double> expected = breakaways_by_steps(drive, 80.0, 1e-4);
  ASSERT_GE(expected.size(), 4U);
  ASSERT_EQ(breakaways.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_NEAR(breakaways[i], expected[i], 2e-4) << i;
  }
}

/// After an impact each shaft has the friction of its speed.
TEST(FallingFriction, FollowsTheSpeedAfterAnImpact) {
  ReducedDrive drive;
  drive.motor = {1.0, {.coulomb = 0.05, .breakaway = 0.2, .stribeck_speed = 0.5}};
  drive.load = {1.0, {.coulomb = 0.1, .breakaway = 0.2, .stribeck_speed = 0.5}};
  drive.backlash = 0.2;
  const DriveSystem built = drive_system(drive);
  const auto motion =
      simulate(built.system, drive_start(drive, built, {.motor_speed = 3.0}), {.until = 1.0});
  const DriveMode met = built.modes.mode(motion.at(0.05).mode);
  EXPECT_EQ(met.contact, ContactState::forward);
  EXPECT_EQ(met.motor, FrictionState::forward);
  EXPECT_EQ(met.load, FrictionState::forward);
  const double at = motion.at(0.05).numbers[load_speed];
  EXPECT_NEAR(motion.at(0.15).numbers[load_speed], at - 0.1 * 0.5 * 0.15, 1e-14);
}

}  // namespace
}  // namespace gearlash::drive::falling_friction_test
