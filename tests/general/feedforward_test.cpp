// What a controller adds by its reference's motion, beside closed forms and small steps.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "controllers.hpp"
#include "drives.hpp"

namespace gearlash::drive::feedforward_test {
namespace {

constexpr double stiffness = 4.0;
constexpr double damping = 3.0;

ReducedDrive controlled_motor() {
  ReducedDrive drive = lone_motor({2.0, {.viscous = 0.5}});
  drive.controller = at_load(PID{PIDTerms::PD, stiffness, 0.0, damping});
  return drive;
}

hybrid::Trajectory run(const ReducedDrive& drive, double until) { return moved(drive, {}, until); }

/// With the reference sin t.
double position_by_steps(const Feedforward& forward, double until) {
  constexpr int steps = 200'000;
  const double step = until / steps;
  double position = 0.0, speed = 0.0;
  const auto acceleration = [&](double time, double at, double moving) {
    const double w = std::cos(time);
    const double share =
        forward.speed > 0.0 ? std::clamp(w / forward.speed, -1.0, 1.0) : (w > 0.0 ? 1.0 : -1.0);
    return (stiffness * (std::sin(time) - at) - (damping + 0.5) * moving + forward.torque * share) /
           2.0;
  };
  for (int i = 0; i < steps; ++i) {
    const double time = i * step;
    const double half = 0.5 * step;
    const double a = acceleration(time, position, speed);
    const double b = acceleration(time + half, position + half * speed, speed + half * a);
    position += step * (speed + half * a);
    speed += step * b;
  }
  return position;
}

TEST(OracleFeedforward, OfFrictionHasTheSignOfTheReferencesSpeed) {
  for (const double speed : {0.0, 0.3}) {
    ReducedDrive drive = controlled_motor();
    drive.reference = Sine{0.0, 1.0, 1.0, 0.0};
    drive.feedforward = {.torque = 1.5, .speed = speed};
    const auto motion = run(drive, 13.0);
    EXPECT_NEAR(motion.end().numbers[motor_position], position_by_steps(drive.feedforward, 13.0),
                speed > 0.0 ? 1e-7 : 1e-4)
        << speed;
  }
}

/// A torque that compensates exactly leaves a steady ramp the error of its viscous friction alone.
TEST(OracleFeedforward, OfFrictionLeavesARampNoDryError) {
  for (const bool is_sampled : {false, true}) {
    ReducedDrive drive = controlled_motor();
    drive.motor.friction.coulomb = drive.motor.friction.breakaway = 0.8;
    drive.reference = Ramp{0.0, -0.2, 0.0};
    drive.feedforward.torque = 0.8;
    if (is_sampled) drive.sampling = Sampling{.period = 0.01};
    const auto motion = run(drive, 60.0);
    const double lag = (damping + 0.5) * 0.2 / stiffness;
    EXPECT_NEAR(motion.end().numbers[motor_position], -0.2 * 60.0 + lag, 1e-9) << is_sampled;
  }
}

TEST(OracleFeedforward, OfFrictionEndsWithTheReferencesMotion) {
  for (const double speed : {0.0, 0.1}) {
    ReducedDrive drive = controlled_motor();
    drive.reference = Trapezoid{0.0, 1.0, 0.5, 0.3, 1.0};
    drive.feedforward = {.torque = 0.8, .speed = speed};
    EXPECT_NEAR(run(drive, 60.0).end().numbers[motor_position], 1.0, 1e-12) << speed;
  }
}

/// Half the gap is added in the direction of the last motion, and stays.
TEST(OracleFeedforward, OfTheGapStaysOnTheSideOfTheLastMotion) {
  for (const double time : {0.0, 0.2}) {
    for (const bool is_sampled : {false, true}) {
      ReducedDrive drive = controlled_motor();
      drive.feedforward = {.half_gap = 0.1, .take_up_time = time};
      if (is_sampled) drive.sampling = Sampling{.period = 0.01};
      EXPECT_NEAR(run(drive, 40.0).end().numbers[motor_position], 0.0, 1e-13);  // nothing moved
      drive.reference = Trapezoid{0.0, -1.0, 0.5, 0.3, 1.0};
      EXPECT_NEAR(run(drive, 60.0).end().numbers[motor_position], -1.1, 1e-9) << time;
      drive.reference = Table{{0.0, 1.0, 2.0, 3.0}, {0.0, 1.0, 1.0, 0.7}};
      EXPECT_NEAR(run(drive, 60.0).end().numbers[motor_position], 0.6, 1e-9) << time;
    }
  }
}

/// The first sample is taken at time 0, as the ramp begins: 1.5 N m, not 1.5 · 2/0.5 N m, and half
/// the gap times the gain besides.
TEST(OracleFeedforward, IsWholeAtTheFirstSampleOfARamp) {
  ReducedDrive drive = controlled_motor();
  drive.sampling = Sampling{.period = 0.01};
  drive.reference = Ramp{.value = 0.0, .rate = -2.0, .time = 0.0};
  drive.feedforward = {.torque = 1.5, .speed = 0.5};
  const auto torque_at_first = [&] {
    const DriveSystem built = drive_system(drive);
    const auto motion = simulate(built.system, drive_start(drive, built, {}), {.until = 0.005});
    return built.motor_torque(motion.end().mode).at(motion.end().numbers);
  };
  EXPECT_NEAR(torque_at_first(), -1.5, 1e-12);
  drive.feedforward.speed = 0.0;
  EXPECT_NEAR(torque_at_first(), -1.5, 1e-12);
  drive.feedforward.half_gap = 0.1;
  EXPECT_NEAR(torque_at_first(), -1.5 - stiffness * 0.1, 1e-12);
}

/// The addition changes sides as a lag does.
TEST(OracleFeedforward, OfTheGapIsTakenUpInItsTime) {
  ReducedDrive drive = controlled_motor();
  drive.reference = Sine{0.0, 1.0, 1.0, 0.0};
  drive.feedforward = {.half_gap = 0.1, .take_up_time = 0.2};
  const DriveSystem built = drive_system(drive);
  const auto motion = simulate(built.system, drive_start(drive, built, {}), {.until = 3.0});
  const double turn = 0.5 * std::acos(-1.0);
  const double before = 0.1 * -std::expm1(-turn / 0.2);
  EXPECT_NEAR(motion.at(1.0).numbers[built.at.taken_up], 0.1 * -std::expm1(-5.0), 1e-14);
  EXPECT_NEAR(motion.at(2.0).numbers[built.at.taken_up],
              -0.1 + (before + 0.1) * std::exp(-(2.0 - turn) / 0.2),
              1e-9);  // it turns once its speed is a billionth of the fastest
}

}  // namespace
}  // namespace gearlash::drive::feedforward_test
