// A winding whose current lags behind its voltage, beside its equations and its limit.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "controllers.hpp"
#include "drives.hpp"
#include "general/assemble/time_scale.hpp"

namespace gearlash::drive::winding_test {
namespace {

constexpr double stiffness = 40.0;
constexpr double reference = 0.3;

/// Position control of the motor; the gap is so wide that the faces never meet.
ReducedDrive free_motor(double time_constant) {
  ReducedDrive drive;
  drive.motor = {0.02, {.viscous = 0.05}};
  drive.load = {1.0, {.viscous = 0.1}};
  drive.backlash = 100.0;
  drive.sensing = {.load_share_of_position = 0.0};
  drive.controller = at_load(PID{.proportional = stiffness});
  drive.winding = {.time_constant = time_constant, .back_emf = 0.4};
  drive.reference = reference;
  return drive;
}

using Numbers = std::array<double, 3>;  // position, speed, torque

Numbers slope_of(const ReducedDrive& drive, const Numbers& now) {
  const double asked = stiffness * (reference - now[0]);
  return {now[1], (now[2] - drive.motor.friction.viscous * now[1]) / drive.motor.inertia,
          (asked - drive.winding.back_emf * now[1] - now[2]) / drive.winding.time_constant};
}

TEST(OracleWinding, MovesAsItsEquationsSay) {
  const ReducedDrive drive = free_motor(3e-3);
  const DriveSystem built = drive_system(drive);
  constexpr double until = 0.2;
  const auto motion = simulate(built.system, drive_start(drive, built, {}), {.until = until});
  const hybrid::State end = motion.at(until);
  const Numbers expected =
      integrated(Numbers{}, until, 20000, [&](const Numbers& now) { return slope_of(drive, now); });
  EXPECT_NEAR(end.numbers[motor_position], expected[0], 1e-11);
  EXPECT_NEAR(end.numbers[motor_speed], expected[1], 1e-10);
  EXPECT_NEAR(end.numbers[built.at.winding], expected[2], 1e-9);
  const hybrid::AffineForm& torque = built.motor_torque(end.mode);
  EXPECT_EQ(torque.normal.dot(end.numbers) + torque.offset, end.numbers[built.at.winding]);
}

/// The loop with the gap closed has the roots of (T s + 1)(J s² + F s) + E s + K.
TEST(OracleWinding, LoopHasItsCharacteristicRoots) {
  ReducedDrive drive = free_motor(3e-3);
  const TimeScales found = time_scales(drive);
  const double inertia = drive.motor.inertia + drive.load.inertia;
  const double friction = drive.motor.friction.viscous + drive.load.friction.viscous;
  const auto residual = [&](std::complex<double> s) {
    return (drive.winding.time_constant * s + 1.0) * (inertia * s * s + friction * s) +
           drive.winding.back_emf * s + stiffness;
  };
  // Its pair of slow roots by Newton's method.
  std::complex<double> root(0.0, std::sqrt(stiffness / inertia));
  for (int i = 0; i < 50; ++i) {
    const std::complex<double> step = 1e-7;
    root -= residual(root) * step / (residual(root + step) - residual(root));
  }
  EXPECT_NEAR(found.swing, 2.0 * std::acos(-1.0) / std::abs(root), 1e-9);
  EXPECT_NEAR(found.settling, -1.0 / root.real(), 1e-6);
}

TEST(PropertyWinding, AVeryFastOneIsViscousFriction) {
  ReducedDrive at_once = free_motor(0.0);
  at_once.motor.friction.viscous += at_once.winding.back_emf;
  at_once.winding = {};
  const ReducedDrive fast = free_motor(1e-8);
  const auto position = [](const ReducedDrive& drive) {
    return moved(drive, {}, 0.2).end().numbers[motor_position];
  };
  EXPECT_NEAR(position(fast), position(at_once), 1e-6);
}

/// A motor by itself that is turned up to speed: its current is at the limit until the back-EMF
/// leaves no more than that of the voltage.
TEST(OracleCurrentLimit, HoldsTheTorqueUntilTheBackEmfTakesTheRest) {
  constexpr double back_emf = 0.4;
  constexpr double voltage_torque = 12.0;  // the torque of the voltage at standstill
  constexpr double limit = 3.0;
  for (const double way : {1.0, -1.0}) {
    ReducedDrive drive = free_motor(0.0);
    drive.motor.friction.viscous = back_emf;
    drive.winding.torque_limit = limit;
    drive.controller = at_load(PID{.proportional = 1.0});
    drive.torque_limit = voltage_torque;
    drive.reference = way * 1e4;
    const DriveSystem built = drive_system(drive);
    const auto motion = simulate(built.system, drive_start(drive, built, {}), {.until = 1.0});
    const double rate = limit / 0.02;
    const double leaves = (voltage_torque - limit) / back_emf / rate;
    const auto speed = [&](double time) {
      const double last = voltage_torque / back_emf;
      return time < leaves
                 ? rate * time
                 : last + (rate * leaves - last) * std::exp(-back_emf / 0.02 * (time - leaves));
    };
    for (const double time : {0.5 * leaves, leaves, 1.3 * leaves, 1.0}) {
      EXPECT_NEAR(motion.at(time).numbers[motor_speed], way * speed(time), 1e-11) << time;
    }
    EXPECT_EQ(built.modes.mode(motion.at(0.5 * leaves).mode).current,
              way > 0.0 ? Branch::forward : Branch::backward);
    EXPECT_EQ(built.modes.mode(motion.end().mode).current, Branch::inner);
  }
}

/// With a lag the torque rises to the limit, stays there, and leaves it as the voltage does.
TEST(OracleCurrentLimit, HoldsTheTorqueOfAWindingThatLags) {
  ReducedDrive drive = free_motor(3e-3);
  drive.winding.torque_limit = 4.0;
  const DriveSystem built = drive_system(drive);
  constexpr double until = 0.5;
  const auto motion = simulate(built.system, drive_start(drive, built, {}), {.until = until});
  constexpr int steps = 500'000;
  constexpr double step = until / steps;
  Numbers now{};
  double highest = 0.0;
  for (int i = 0; i < steps; ++i) {
    const Numbers slope = slope_of(drive, now);
    Numbers middle = now;
    for (std::size_t k = 0; k < 3; ++k) middle[k] += 0.5 * step * slope[k];
    middle[2] = std::clamp(middle[2], -4.0, 4.0);
    const Numbers later = slope_of(drive, middle);
    for (std::size_t k = 0; k < 3; ++k) now[k] += step * later[k];
    now[2] = std::clamp(now[2], -4.0, 4.0);
    highest = std::max(highest, now[2]);
    if (i % 50'000 == 0) {
      const hybrid::Vector found = motion.at((i + 1) * step).numbers;
      EXPECT_NEAR(found[motor_position], now[0], 1e-7) << i;
      EXPECT_NEAR(found[built.at.winding], now[2], 1e-4) << i;
    }
  }
  EXPECT_EQ(highest, 4.0);
  EXPECT_GE(motion.events().size(), 4U);
}

}  // namespace
}  // namespace gearlash::drive::winding_test
