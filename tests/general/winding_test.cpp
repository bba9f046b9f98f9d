// A winding whose current lags behind its voltage, beside its equations and its limit.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "general/assemble/drive_system.hpp"
#include "general/assemble/time_scale.hpp"

namespace gearlash::drive {
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
  drive.controller = ProportionalDerivative{.proportional = stiffness};
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

/// Runge and Kutta's method of order 4.
Numbers integrated(const ReducedDrive& drive, double until, int steps) {
  const double step = until / steps;
  const auto moved = [](Numbers from, const Numbers& along, double by) {
    for (std::size_t i = 0; i < from.size(); ++i) from[i] += by * along[i];
    return from;
  };
  Numbers now{};
  for (int i = 0; i < steps; ++i) {
    const Numbers a = slope_of(drive, now);
    const Numbers b = slope_of(drive, moved(now, a, 0.5 * step));
    const Numbers c = slope_of(drive, moved(now, b, 0.5 * step));
    const Numbers d = slope_of(drive, moved(now, c, step));
    for (std::size_t k = 0; k < now.size(); ++k) {
      now[k] += step / 6.0 * (a[k] + 2.0 * b[k] + 2.0 * c[k] + d[k]);
    }
  }
  return now;
}

TEST(OracleWinding, MovesAsItsEquationsSay) {
  const ReducedDrive drive = free_motor(3e-3);
  const DriveSystem built = drive_system(drive);
  constexpr double until = 0.2;
  const auto motion = simulate(built.system, drive_start(drive, built, {}), {.until = until});
  const hybrid::State end = motion.at(until);
  const Numbers expected = integrated(drive, until, 20000);
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
    const DriveSystem built = drive_system(drive);
    return simulate(built.system, drive_start(drive, built, {}), {.until = 0.2})
        .at(0.2)
        .numbers[motor_position];
  };
  EXPECT_NEAR(position(fast), position(at_once), 1e-6);
}

}  // namespace
}  // namespace gearlash::drive
