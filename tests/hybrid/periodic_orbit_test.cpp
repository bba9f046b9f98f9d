// Orbits of the servo against its closed form, of forced and of sampled systems.
#include "hybrid/periodic_orbit.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/range_check.hpp"
#include "base/traced_draws.hpp"
#include "closed_form/limit_cycle.hpp"
#include "servo_system.hpp"

namespace gearlash::periodic_orbit_test {
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
double amplitude_of(const hybrid::PeriodicOrbit& orbit) {
  double lowest = orbit.start.numbers[2];
  double highest = lowest;
  for (const hybrid::Event& event : orbit.events) {
    lowest = std::min(lowest, event.before[2]);
    highest = std::max(highest, event.before[2]);
  }
  return 0.5 * (highest - lowest);
}

TEST(OraclePeriodicOrbit, OfServosIsTheClosedFormsCycle) {
  TracedDraws draws(6101);
  int compared = 0;
  double worst_period = 0.0;
  double worst_multiplier = 0.0;
  double worst_amplitude = 0.0;
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
    worst_amplitude =
        std::max(worst_amplitude, std::abs(amplitude_of(*orbit) / exact.amplitude - 1.0));
    worst_multiplier =
        std::max(worst_multiplier, std::abs(std::abs(orbit->multipliers.at(0)) - exact.multiplier));
  }
  EXPECT_LT(worst_period, 1e-12);
  EXPECT_LT(worst_amplitude, 1e-10);
  EXPECT_LT(worst_multiplier, 1e-8);
  RecordProperty("worst_period", exact_text(worst_period));
  RecordProperty("worst_amplitude", exact_text(worst_amplitude));
  RecordProperty("worst_multiplier", exact_text(worst_multiplier));
}

// ---- sampled ------------------------------------------------------------------------------------

/// One number that a tick throws across its rest at 1, nearly as far as it was.
hybrid::HybridSystem alternating() {
  return {.state_names = {"x"},
          .modes = {{.name = "waits",
                     .flow = {Matrix::Zero(1, 1), Vector::Zero(1)},
                     .timed = {{.name = "sample",
                                .clock = 0,
                                .reset = {Matrix{{-0.99}}, Vector{{1.99}}, {}}}}}},
          .clocks = {{.name = "sampler", .period = 1.0}}};
}

/// A number that each second halves and pushes to either side in turn, beside a sine of 62,832 s,
/// which 2 s move by 2e-4 of it.
TEST(EdgePeriodicOrbit, UnderASineIsNoneThatTheSineDoesNotClose) {
  constexpr double rate = 1e-4;
  hybrid::HybridSystem system{.state_names = {"pushed", "sine", "cosine"},
                              .clocks = {{.name = "sampler", .first = 0.5, .period = 1.0}}};
  for (const double push : {1.0, -1.0}) {
    hybrid::AffineMode mode{.flow = {Matrix::Zero(3, 3), Vector::Zero(3)}};
    mode.flow.matrix(1, 2) = rate;
    mode.flow.matrix(2, 1) = -rate;
    mode.timed = {{.name = "sample",
                   .reset = {Vector{{0.5, 1.0, 1.0}}.asDiagonal(), push * Vector::Unit(3, 0), {}},
                   .target = push > 0.0 ? 1U : 0U}};
    system.modes.push_back(mode);
  }
  const auto closed = [&](double sine) {
    const hybrid::State start{0, Vector::Unit(3, 1) * sine};
    return closing_orbit(system, simulate(system, start, {.until = 40.0}), {.nearness = 1e-3});
  };
  const auto without = closed(0.0);
  ASSERT_TRUE(without);
  EXPECT_NEAR(without->period, 2.0, 1e-12);
  EXPECT_FALSE(closed(1.0));
}

TEST(EdgePeriodicOrbit, APeriodIsGoneAroundOnce) {
  // Where one tick is too far from the next one but one, only two together nearly close.
  const hybrid::HybridSystem system = alternating();
  const auto motion = simulate(system, {0, Vector{{1.05}}}, {.until = 10.0});
  const auto orbit = closing_orbit(system, motion);
  ASSERT_TRUE(orbit);
  EXPECT_EQ(orbit->events.size(), 1U);
  EXPECT_NEAR(orbit->period, 1.0, 1e-14);
  EXPECT_NEAR(orbit->start.numbers[0], 1.0, 1e-13);
  ASSERT_EQ(orbit->multipliers.size(), 1U);
  EXPECT_NEAR(orbit->multipliers[0].real(), -0.99, 1e-13);
}

TEST(OraclePeriodicOrbit, AQuantizedReadingHuntsAboutWhatItCannotRead) {
  // x′ = z − x; each second z falls by a quarter of the reading's excess over 1/2, which whole
  // numbers cannot equal: readings of 0 and 1 take turns.
  constexpr double gain = 0.25;
  const hybrid::HybridSystem system{
      .state_names = {"x", "z"},
      .modes = {{.name = "follows",
                 .flow = {Matrix{{-1.0, 1.0}, {0.0, 0.0}}, Vector::Zero(2)},
                 .timed = {{.name = "sample",
                            .clock = 0,
                            .reset = {{},
                                      Vector{{0.0, 0.5 * gain}},
                                      {{.measured = {Vector{{1.0, 0.0}}, 0.0},
                                        .step = 1.0,
                                        .gain = Vector{{0.0, -gain}}}}}}}}},
      .clocks = {{.name = "sampler", .period = 1.0}}};
  const auto motion = simulate(system, {0, Vector{{0.0, 0.0}}}, {.until = 200.0});
  const auto orbit = closing_orbit(system, motion);
  ASSERT_TRUE(orbit);
  EXPECT_LT(orbit->residual, 1e-10);
  const double ticks = std::round(orbit->period);
  EXPECT_NEAR(orbit->period, ticks, 1e-12);
  EXPECT_EQ(orbit->events.size(), static_cast<std::size_t>(ticks));
  // As often above as below.
  double sum = 0.0;
  for (const hybrid::Event& event : orbit->events) sum += std::round(event.before[0]);
  EXPECT_EQ(2.0 * sum, ticks);
  // Between switchings of the reading z is only added to, and x forgets.
  ASSERT_EQ(orbit->multipliers.size(), 2U);
  EXPECT_NEAR(orbit->multipliers[0].real(), 1.0, 1e-12);
  EXPECT_NEAR(orbit->multipliers[1].real(), std::exp(-ticks), 1e-12);
}

/// x″ = a − x′, a′ = 1/2 − c − a, where c counts x to whole numbers: a relay about x = 1/2.
hybrid::HybridSystem counting() {
  const auto counts = [](double way) {
    return hybrid::Transition{
        .name = way > 0.0 ? "up" : "down",
        .guard = {Vector{{1.0, 0.0, 0.0, -1.0}}, -0.5 * way},
        .direction = way > 0.0 ? hybrid::Direction::rising : hybrid::Direction::falling,
        .reset = {{}, Vector{{0.0, 0.0, 0.0, way}}, {}}};
  };
  return {.state_names = {"x", "v", "a", "c"},
          .modes = {{.name = "moves",
                     .flow = {Matrix{{0.0, 1.0, 0.0, 0.0},
                                     {0.0, -1.0, 1.0, 0.0},
                                     {0.0, 0.0, -1.0, -1.0},
                                     {0.0, 0.0, 0.0, 0.0}},
                              Vector{{0.0, 0.0, 0.5, 0.0}}},
                     .transitions = {counts(1.0), counts(-1.0)}}}};
}

/// Half the period of its cycle: the time h over which x returns, if v and a turn their signs.
double half_period_of_counting() {
  const auto way = [](double h) {
    const double fallen = std::exp(-h);
    const double a = 0.5 * std::tanh(0.5 * h);  // at the start, where a′ = −1/2 − a
    const double v = (0.5 * (1.0 - fallen) - (a + 0.5) * h * fallen) / (1.0 + fallen);
    return -0.5 * h + (a + 0.5) * (1.0 - (1.0 + h) * fallen) + (v + 0.5) * (1.0 - fallen);
  };
  double low = 1.0;
  double high = 20.0;
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    ((way(middle) > 0.0) == (way(low) > 0.0) ? low : high) = middle;
  }
  return low;
}

/// Counts off the whole numbers would have cycles of their own, whose relay is biased.
TEST(OraclePeriodicOrbit, ACountStaysOnItsGrid) {
  const hybrid::HybridSystem system = counting();
  const auto motion = simulate(system, {0, Vector{{0.2, 0.0, 0.3, 0.0}}}, {.until = 50.0});
  const auto orbit = closing_orbit(system, motion, {.nearness = 0.1});
  ASSERT_TRUE(orbit);
  EXPECT_EQ(orbit->events.size(), 2U);
  EXPECT_EQ(orbit->start.numbers[3], std::round(orbit->start.numbers[3]));
  EXPECT_NEAR(orbit->period, 2.0 * half_period_of_counting(), 1e-12);
  EXPECT_EQ(orbit->multipliers.size(), 2U);  // of three numbers, without a shift in time
  EXPECT_TRUE(orbit->is_stable());
}

TEST(EdgePeriodicOrbit, WhereNothingActsOnAnyNumberThereAreNoMultipliers) {
  const hybrid::HybridSystem system{
      .state_names = {"x", "v"},
      .modes = {{.name = "swings",
                 .flow = {Matrix{{0.0, 1.0}, {-1.0, 0.0}}, Vector::Zero(2)},
                 .transitions = {{.name = "passes",
                                  .guard = {Vector{{1.0, 0.0}}, 0.0},
                                  .direction = hybrid::Direction::either}}}}};
  const auto orbit =
      closing_orbit(system, simulate(system, {0, Vector{{1.0, 0.0}}}, {.until = 50.0}));
  ASSERT_TRUE(orbit);
  EXPECT_NEAR(orbit->period, 2.0 * std::acos(-1.0), 1e-12);
  EXPECT_TRUE(orbit->multipliers.empty());
}

}  // namespace
}  // namespace gearlash::periodic_orbit_test
