// Orbits of the servo against its closed form, of forced and of sampled systems.
#include "gearlash/hybrid/periodic_orbit.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "../servo/seeded_draws.hpp"
#include "gearlash/cycle/limit_cycle.hpp"
#include "gearlash/servo/range_check.hpp"
#include "servo_system.hpp"

namespace gearlash {
namespace {

using hybrid::Matrix;
using hybrid::Vector;

/// The servo's, with an event wherever the load turns.
hybrid::HybridSystem turning_servo_system(const NormalizedServo& servo) {
  hybrid::HybridSystem system = servo_system(servo);
  for (std::size_t mode = 0; mode < system.modes.size(); ++mode) {
    hybrid::Transition turns;
    turns.name = "load turns";
    turns.guard = {Vector::Unit(4, 3), 0.0};
    turns.direction = hybrid::Direction::either;
    turns.target = mode;
    system.modes[mode].transitions.push_back(turns);
  }
  return system;
}

/// Half of the peak-to-peak of the load.
double size_of(const hybrid::PeriodicOrbit& orbit) {
  double lowest = orbit.start.numbers[2];
  double highest = lowest;
  for (const hybrid::Event& event : orbit.events) {
    lowest = std::min(lowest, event.before[2]);
    highest = std::max(highest, event.before[2]);
  }
  return 0.5 * (highest - lowest);
}

TEST(OraclePeriodicOrbit, OfServosIsTheClosedFormsCycle) {
  constexpr std::uint64_t seed = 6101;
  SCOPED_TRACE(seed);
  SeededDraws draws(seed);
  int compared = 0;
  double worst_period = 0.0;
  double worst_multiplier = 0.0;
  double worst_size = 0.0;
  while (compared < 1000) {
    const NormalizedServo servo{.damping = draws.log_uniform(0.02, 0.8),
                                .inertia_ratio = draws.log_uniform(0.05, 20.0),
                                .friction_ratio = draws.uniform(0.02, 0.98),
                                .backlash = 0.3};
    const LimitCycleAnalysis analysis = analyse_limit_cycles(servo);
    // Where disturbances die away slowly the motion is long in coming near.
    if (analysis.cycles.empty() || analysis.cycles[0].multiplier > 0.7) continue;
    ++compared;
    SCOPED_TRACE("damping " + exact_text(servo.damping) + " inertia_ratio " +
                 exact_text(servo.inertia_ratio) + " friction_ratio " +
                 exact_text(servo.friction_ratio));
    const LimitCycle& exact = analysis.cycles[0];
    const hybrid::HybridSystem system = turning_servo_system(servo);
    const hybrid::State start{engaged_forward,
                              (Vector(4) << exact.start.motor_position, exact.start.motor_speed,
                               exact.start.load_position, exact.start.load_speed)
                                      .finished() *
                                  1.02};
    const hybrid::Trajectory motion =
        simulate(system, {separated, start.numbers}, {.until = 20.0 * exact.period});
    const auto orbit = closing_orbit(system, motion);
    ASSERT_TRUE(orbit);
    // Two impacts, two partings; the load turns between them, or at the impacts.
    EXPECT_TRUE(orbit->events.size() == 6U || orbit->events.size() == 4U);
    EXPECT_TRUE(orbit->is_stable());
    worst_period = std::max(worst_period, std::abs(orbit->period / exact.period - 1.0));
    worst_size = std::max(worst_size, std::abs(size_of(*orbit) / exact.size - 1.0));
    worst_multiplier =
        std::max(worst_multiplier, std::abs(std::abs(orbit->multipliers.at(0)) - exact.multiplier));
  }
  EXPECT_LT(worst_period, 1e-12);
  EXPECT_LT(worst_size, 1e-10);
  EXPECT_LT(worst_multiplier, 1e-8);
  RecordProperty("worst_period", exact_text(worst_period));
  RecordProperty("worst_size", exact_text(worst_size));
  RecordProperty("worst_multiplier", exact_text(worst_multiplier));
}

}  // namespace
}  // namespace gearlash
