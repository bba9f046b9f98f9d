// Derivatives of hybrid motions against finite differences, and multipliers against what is known.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <utility>

#include "base/correct_digits.hpp"
#include "hybrid/passage.hpp"
#include "hybrid/periodic_orbit.hpp"

namespace gearlash::hybrid::saltation_test {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();
/// Of finite differences, as a share: rounding of a motion over the least step, some 1e-14/2e-3,
/// and what extrapolation leaves, of the order of (step × rate of the system)⁸.
constexpr double of_differences = 1e-10;

/// Central differences over h, h/2, h/4 and h/8, extrapolated to h = 0 (Richardson 1911; what is
/// left is of order h⁸).
template <class Map>
Matrix differences(const Map& map, const Vector& at, Eigen::Index columns, double h) {
  Matrix result(map(at).size(), columns);
  for (Eigen::Index i = 0; i < columns; ++i) {
    std::array<Vector, 4> level;
    for (std::size_t k = 0; k < level.size(); ++k) {
      const Vector step = std::ldexp(h, -static_cast<int>(k)) * Vector::Unit(at.size(), i);
      level[k] = (map(at + step) - map(at - step)) / (2.0 * step[i]);
      double power = 1.0;
      for (std::size_t j = k; j-- > 0;) {
        power *= 4.0;
        level[j] = level[j + 1] + (level[j + 1] - level[j]) / (power - 1.0);
      }
    }
    result.col(i) = level[0];
  }
  return result;
}

// ---- two flows that take turns ------------------------------------------------------------------

constexpr double to_second = 2.75;
constexpr double to_first = 0.36;

/// u′ = A₁u until u₂ = 2.75u₁, then u′ = A₂u until u₂ = 0.36u₁, and so on. From (0, 1) all switches
/// come in the third quadrant, where u₂ − 2.75u₁ falls through 0 and u₂ − 0.36u₁ rises.
/// Source: Hiskens & Pai, Trajectory sensitivity analysis of hybrid systems, IEEE Trans. Circuits
/// Syst. I 47 (2000); PETSc, src/ts/tutorials/hybrid/ex1fd.c.
HybridSystem switched_flows() {
  return {.state_names = {"u1", "u2"},
          .modes = {{.name = "first",
                     .flow = {Matrix{{1.0, -100.0}, {10.0, 1.0}}, Vector::Zero(2)},
                     .transitions = {{.name = "to second",
                                      .guard = {Vector{{-to_second, 1.0}}, 0.0},
                                      .direction = Direction::falling,
                                      .target = 1}}},
                    {.name = "second",
                     .flow = {Matrix{{1.0, 10.0}, {-100.0, 1.0}}, Vector::Zero(2)},
                     .transitions = {{.name = "to first",
                                      .guard = {Vector{{-to_first, 1.0}}, 0.0},
                                      .direction = Direction::rising,
                                      .target = 0}}}}};
}

TEST(OracleSaltation, SwitchedFlowsSwitchWhereTheirEllipsesMeetTheLines) {
  const Trajectory motion = simulate(switched_flows(), {0, Vector{{0.0, 1.0}}}, {.until = 0.125});
  ASSERT_EQ(motion.events().size(), 2U);
  // e⁻ᵗu goes round ellipses of half axes in the ratio √10 at the rate √1000: at first
  // (−√10 sin, cos), then back, of the angle (√10u₁, u₂).
  const double rate = std::sqrt(1000.0);
  const double root = std::sqrt(10.0);
  const double first = (std::numbers::pi - std::atan(1.0 / (to_second * root))) / rate;
  const double second = first + (std::atan(to_second / root) - std::atan(to_first / root)) / rate;
  expect_digits("first_switch", motion.events()[0].time, first, 15.0);
  expect_digits("second_switch", motion.events()[1].time, second, 15.0);
}

TEST(PropertySaltation, DerivativesOfSwitchedFlowsAreFiniteDifferences) {
  const HybridSystem system = switched_flows();
  const Vector start{{0.0, 1.0}};
  double worst = 0.0;
  for (const auto& [until, switches] : {std::pair{0.11, 1U}, {0.125, 2U}, {0.5, 22U}}) {
    SCOPED_TRACE(until);
    const auto end = [&, time = until](const Vector& from) {
      return simulate(system, {0, from}, {.until = time}).end().numbers;
    };
    const Trajectory motion = simulate(system, {0, start}, {.until = until});
    ASSERT_EQ(motion.events().size(), switches);
    const auto passage =
        pass(PreparedSystem(system), {0, start}, 0.0, switches, {.plane = {}, .time = until});
    ASSERT_TRUE(passage);
    const Matrix& exact = passage->slope_at_time;
    const Matrix found = differences(end, start, 2, 2e-2);
    worst = std::max(worst, (found - exact).norm() / exact.norm());
  }
  expect_digits("derivatives", 1.0 + worst, 1.0, 11.0);
}

TEST(PropertySaltation, DerivativesOnAPlaneAreFiniteDifferences) {
  const HybridSystem system = switched_flows();
  const Vector start{{0.0, 1.0}};
  constexpr double time = 0.125;
  const State there = simulate(system, {0, start}, {.until = time}).end();
  const Vector normal = system.modes[there.mode].flow.matrix * there.numbers;
  const Finish finish{.plane = AffineForm{normal, -normal.dot(there.numbers)}, .time = time};
  const auto passage = pass(PreparedSystem(system), {0, start}, 0.0, 2, finish);
  ASSERT_TRUE(passage);
  EXPECT_NEAR(passage->duration, time, 16.0 * epsilon * time);
  const auto end_and_duration = [&](const Vector& from) {
    const Passage near = pass(PreparedSystem(system), {0, from}, 0.0, 2, finish).value();
    return Vector{{near.end.numbers[0], near.end.numbers[1], near.duration}};
  };
  const Matrix found = differences(end_and_duration, start, 2, 2e-2);
  const double error = (found.topRows(2) - passage->slope).norm() / passage->slope.norm();
  const double error_time =
      (found.row(2).transpose() - passage->duration_slope).norm() / passage->duration_slope.norm();
  EXPECT_LT(error, of_differences);
  EXPECT_LT(error_time, of_differences);
}

// ---- events that others bring about -------------------------------------------------------------

/// An oscillator with a number u that is set, and by which it changes flows: at a tick, or where
/// the position passes 0.5, u becomes what puts a guard on its wrong side at once.
HybridSystem made_not_met(bool by_clock) {
  const Matrix first{{0.0, 1.0, 0.0}, {-1.0, -0.2, 1.0}, {0.0, 0.0, 0.0}};
  const Matrix second{{0.0, 1.0, 0.3}, {-4.0, -0.1, 0.5}, {0.0, 0.0, -1.0}};
  const AffineReset setting{
      Matrix{{1.0, 0.0, 0.0}, {0.0, 0.9, 0.0}, {-1.0, -0.5, 0.0}}, Vector{{0.0, 0.0, -0.4}}, {}};
  const Transition below{
      .name = "u is below 0",
      .guard = {Vector{{0.0, 0.0, 1.0}}, 0.0},
      .direction = Direction::falling,
      .reset = {Matrix{{1.0, 0.0, 0.2}, {0.0, 1.0, -0.3}, {0.0, 0.0, 1.0}}, {}, {}},
      .target = 1};
  HybridSystem system;
  system.state_names = {"position", "speed", "u"};
  system.modes.resize(3);
  for (AffineMode& mode : system.modes) mode.flow = {first, Vector::Zero(3)};
  system.modes[1].flow.matrix = second;
  system.modes[2].transitions = {below};
  if (by_clock) {
    system.clocks = {{.name = "tick", .first = 0.7, .period = 100.0}};
    system.modes[0].timed = {{.name = "sets", .clock = 0, .reset = setting, .target = 2}};
  } else {
    system.modes[0].transitions = {{.name = "passes",
                                    .guard = {Vector{{1.0, 0.0, 0.0}}, -0.5},
                                    .direction = Direction::rising,
                                    .reset = setting,
                                    .target = 2}};
  }
  return system;
}

/// The second event is not met by the motion: nothing of its guard's speed says when it comes.
TEST(PropertySaltation, EventsThatOthersBringAboutAreDelayedWithThem) {
  for (const bool by_clock : {true, false}) {
    SCOPED_TRACE(by_clock);
    const HybridSystem system = made_not_met(by_clock);
    const Vector start{{0.1, 0.8, 0.3}};
    constexpr double until = 1.5;
    const auto end = [&](const Vector& from) {
      return simulate(system, {0, from}, {.until = until}).end().numbers;
    };
    const auto passage =
        pass(PreparedSystem(system), {0, start}, 0.0, 2, {.plane = {}, .time = until});
    ASSERT_TRUE(passage);
    EXPECT_EQ(passage->events[0].time, passage->events[1].time);
    const Matrix found = differences(end, start, 3, 1e-2);
    EXPECT_LT((found - passage->slope_at_time).norm() / found.norm(), of_differences);
  }
}

// ---- an oscillator against a stop ---------------------------------------------------------------

constexpr double friction = 0.1;
constexpr double restitution = 0.8;

/// x″ + 0.1x′ + x = A cos t, a stop at x = 1; the force as an oscillation of its own.
HybridSystem impact_oscillator() {
  const Matrix flow{{0.0, 1.0, 0.0, 0.0},
                    {-1.0, -friction, 1.0, 0.0},
                    {0.0, 0.0, 0.0, 1.0},
                    {0.0, 0.0, -1.0, 0.0}};
  Matrix bounce = Matrix::Identity(4, 4);
  bounce(1, 1) = -restitution;
  return {.state_names = {"position", "speed", "force", "force's rate"},
          .modes = {{.name = "free",
                     .flow = {flow, Vector::Zero(4)},
                     .transitions = {{.name = "stop",
                                      .guard = {Vector{{1.0, 0.0, 0.0, 0.0}}, -1.0},
                                      .direction = Direction::rising,
                                      .reset = {.matrix = bounce}}}}}};
}

TEST(OracleSaltation, TheImpactOscillatorHasItsPublishedOrbit) {
  const HybridSystem system = impact_oscillator();
  const Trajectory motion = simulate(system, {0, Vector{{0.0, 0.0, 1.0, 0.0}}}, {.until = 200.0});
  const auto orbit = closing_orbit(system, motion);
  ASSERT_TRUE(orbit);
  ASSERT_EQ(orbit->events.size(), 1U);
  constexpr double turn = 2.0 * std::numbers::pi;
  EXPECT_NEAR(orbit->period, turn, 16.0 * epsilon * turn);
  const Vector& after = orbit->events[0].after;
  // Published: the speed, and the phase of the force.
  expect_digits("speed_after_impact", after[1], -1.35658635, 10.0);
  expect_digits("phase_of_impact", std::atan2(-after[3], after[2]), 0.075952, 5.6);

  const auto strobe = [&](const Vector& from) -> Vector {
    return simulate(system, {0, from}, {.until = turn}).end().numbers.head(2);
  };
  const Matrix found = differences(strobe, orbit->start.numbers, 2, 1e-2);
  ASSERT_EQ(orbit->multipliers.size(), 2U);
  const std::complex<double> product = orbit->multipliers[0] * orbit->multipliers[1];
  const std::complex<double> sum = orbit->multipliers[0] + orbit->multipliers[1];
  EXPECT_NEAR(sum.real(), found.trace(), of_differences);
  EXPECT_NEAR(product.real(), found.determinant(), of_differences);
  // Liouville: areas shrink by friction, and by e² at an impact.
  EXPECT_NEAR(product.real(), restitution * restitution * std::exp(-friction * turn), 1e-14);
  EXPECT_NEAR(sum.imag(), 0.0, 1e-15);
  EXPECT_TRUE(orbit->is_stable());
}

// ---- a sampled controller -----------------------------------------------------------------------

/// x′ = −x + u, u = gain (reference − x) of the last tick.
HybridSystem sampled_loop(double gain, double reference, double period) {
  return {.state_names = {"output", "drive"},
          .modes = {{.name = "runs",
                     .flow = {Matrix{{-1.0, 1.0}, {0.0, 0.0}}, Vector::Zero(2)},
                     .timed = {{.name = "sample",
                                .reset = {.matrix = Matrix{{1.0, 0.0}, {-gain, 0.0}},
                                          .offset = Vector{{0.0, gain * reference}}}}}}},
          .clocks = {{.name = "sampler", .period = period}}};
}

TEST(OracleSaltation, ASampledLoopsMultiplierIsItsDiscreteEigenvalue) {
  for (const double period : {0.05, 0.5, 2.0}) {
    for (const double gain : {0.5, 2.0, 3.0, 10.0}) {
      SCOPED_TRACE(testing::Message() << "period " << period << " gain " << gain);
      constexpr double reference = 1.0;
      const HybridSystem system = sampled_loop(gain, reference, period);
      // From tick to tick x → e⁻ʰx + (1 − e⁻ʰ) gain (reference − x)
      const double eigenvalue = std::exp(-period) + std::expm1(-period) * gain;
      const double rest = reference * gain / (1.0 + gain);
      // Near enough for gains that drive it away; the orbit is its rest, whose period is the
      // tick's.
      const State start{0, Vector{{rest * (1.0 + 1e-8), 0.0}}};
      const Trajectory motion = simulate(system, start, {.until = 4.5 * period});
      const auto orbit = closing_orbit(system, motion);
      ASSERT_TRUE(orbit);
      EXPECT_NEAR(orbit->period, period, 32.0 * epsilon * period);
      EXPECT_NEAR(orbit->start.numbers[0], rest, 1e-13 * rest);
      EXPECT_NEAR(std::abs(orbit->multipliers.at(0) - eigenvalue), 0.0,
                  16.0 * epsilon * (1.0 + gain));
      EXPECT_NEAR(std::abs(orbit->multipliers.at(1)), 0.0, 16.0 * epsilon);
      EXPECT_EQ(orbit->is_stable(), std::abs(eigenvalue) < 1.0);
    }
  }
}

}  // namespace
}  // namespace gearlash::hybrid::saltation_test
