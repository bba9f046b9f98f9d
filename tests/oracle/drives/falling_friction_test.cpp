// Motions of sampled drives with dry friction that falls with speed, beside small steps.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include "gearlash/motion.hpp"
#include "mechanism.hpp"
#include "random_drive.hpp"

namespace gearlash::oracle::falling_friction_test {
namespace {

/// A random drive, without encoder steps, whose shafts have a Stribeck speed within the speeds of
/// its motion.
Drive drive_of(std::uint64_t seed) {
  Drive drive = random_drive(seed);
  const double ratio = drive.gearbox.ratio;
  for (const auto& [friction, speed] :
       {std::pair{&drive.motor.friction, 0.02 * ratio}, std::pair{&drive.load.friction, 0.03}}) {
    friction->breakaway = 1.6 * friction->coulomb;
    friction->stribeck_speed = speed;
  }
  drive.sensor.encoder = {};
  drive.sensor.speed_encoder = {};
  return drive;
}

/// The load's position at samples, by steps of some microseconds.
std::vector<double> by_steps(const Drive& drive, double start, int samples) {
  const PlainDrive plain = plain_drive(drive);
  const ShaftReadings shafts{.motor_position = start, .load_position = start};
  Mechanism mechanism(plain, shafts);
  Computer computer(plain, shafts);
  std::vector<double> positions;
  const auto advance = [&](double time) {
    constexpr int steps = 200;
    for (int i = 0; i < steps; ++i) mechanism.advance(time / steps, {computer.torque()});
  };
  for (int i = 0; i < samples; ++i) {
    computer.sample(mechanism.shafts());
    if (computer.gives_out_later()) {
      advance(plain.delay);
      computer.give_out();
      advance(plain.period - plain.delay);
    } else {
      advance(plain.period);
    }
    positions.push_back(mechanism.shafts().load_position);
  }
  return positions;
}

TEST(PropertyFallingFriction, MovesAsSmallStepsDo) {
  int affected = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Drive drive = drive_of(seed);
    constexpr double start = 0.01;
    constexpr int samples = 300;
    const double period = drive.sampling->period;
    const Span span{.until = samples * period, .start = Start{.load_position = start, .gap = 0.0}};
    const Motion motion = simulate(drive, span);
    drive.motor.friction.stribeck_speed = drive.load.friction.stribeck_speed = 0.0;
    const Motion at_once = simulate(drive, span);
    const std::vector<double> expected = by_steps(drive_of(seed), start, samples);
    double worst = 0.0;
    double change = 0.0;
    for (int i = 0; i < samples; ++i) {
      const double found = motion.at((i + 1) * period).shafts.load_position;
      worst = std::max(worst, std::abs(found - expected[static_cast<std::size_t>(i)]));
      change =
          std::max(change, std::abs(found - at_once.at((i + 1) * period).shafts.load_position));
    }
    // Nearly all agree to 1e-9; chains of bounces are cut at a hundredth of a step.
    EXPECT_LT(worst, 1e-6);
    if (change > 1e-5) ++affected;
  }
  EXPECT_GT(affected, 10);
}

}  // namespace
}  // namespace gearlash::oracle::falling_friction_test
