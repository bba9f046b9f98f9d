// Derivatives of periodic orbits by a parameter: a relay with hysteresis before a lag, in closed
// form.
#include "hybrid/orbit_slopes.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "hybrid/hybrid_trajectory.hpp"

namespace gearlash::hybrid::orbit_slopes_test {
namespace {

/// x′ = −x/lag ± 1/lag, switched at ±threshold. Another number is the integral of x: its extremes
/// lie between the events, those of x at them. Period: 2 lag ln((1 + threshold)/(1 − threshold)).
HybridSystem relay(double threshold, double lag) {
  HybridSystem system;
  system.state_names = {"x", "integral"};
  for (const double sign : {1.0, -1.0}) {
    AffineMode mode;
    mode.name = sign > 0.0 ? "up" : "down";
    mode.flow.matrix = (Matrix(2, 2) << -1.0 / lag, 0.0, 1.0, 0.0).finished();
    mode.flow.offset = (Vector(2) << sign / lag, 0.0).finished();
    Transition turns;
    turns.name = "turns";
    turns.guard = {Vector::Unit(2, 0), -sign * threshold};
    turns.direction = sign > 0.0 ? Direction::rising : Direction::falling;
    turns.target = sign > 0.0 ? 1 : 0;
    mode.transitions.push_back(turns);
    system.modes.push_back(mode);
  }
  return system;
}

double period_of(double threshold, double lag) {
  return 2.0 * lag * std::log((1.0 + threshold) / (1.0 - threshold));
}

/// From x = 0 in "up" on: the integral's start does not matter, so it is a family. Without it.
HybridSystem without_integral(HybridSystem system) {
  system.state_names.pop_back();
  for (AffineMode& mode : system.modes) {
    mode.flow.matrix = Matrix(mode.flow.matrix.topLeftCorner(1, 1));
    mode.flow.offset = Vector(mode.flow.offset.head(1));
    mode.transitions[0].guard.normal = Vector::Ones(1);
  }
  return system;
}

PeriodicOrbit orbit_of(const PreparedSystem& system) {
  const Trajectory motion =
      simulate(system, {0, Vector::Zero(system.system().size())}, {.until = 40.0});
  return closing_orbit(system, motion).value();
}

TEST(OrbitSlopes, OfARelayWithALagAreThoseOfItsClosedForm) {
  const double threshold = 0.6;
  const double lag = 1.7;
  const PreparedSystem system(without_integral(relay(threshold, lag)));
  const PeriodicOrbit orbit = orbit_of(system);
  ASSERT_NEAR(orbit.period, period_of(threshold, lag), 1e-12);
  const SystemSlopes by_threshold([&](double value) { return without_integral(relay(value, lag)); },
                                  threshold, 1e-3);
  const auto along = orbit_slopes(system, orbit, by_threshold);
  ASSERT_TRUE(along);
  EXPECT_NEAR(along->period, 4.0 * lag / (1.0 - threshold * threshold), 1e-10);
  const SystemSlopes by_lag([&](double value) { return without_integral(relay(threshold, value)); },
                            lag, 1e-3 * lag);
  const auto along_lag = orbit_slopes(system, orbit, by_lag);
  ASSERT_TRUE(along_lag);
  EXPECT_NEAR(along_lag->period, orbit.period / lag, 1e-10);
  // x turns at its events: there it follows the threshold one for one, and the lag not at all.
  const AffineForm x{Vector::Ones(1), 0.0};
  for (const Event& event : orbit.events) {
    const double sign = event.mode == 0 ? 1.0 : -1.0;
    EXPECT_NEAR(slope_of(x, event.time, system, orbit, by_threshold, *along), sign, 1e-10);
    EXPECT_NEAR(slope_of(x, event.time, system, orbit, by_lag, *along_lag), 0.0, 1e-10);
  }
}

TEST(EdgeOrbitSlopes, WithAMultiplierOfOneThereAreNone) {
  const PreparedSystem system(relay(0.6, 1.7));
  const PeriodicOrbit orbit = orbit_of(system);
  const SystemSlopes slopes([](double value) { return relay(value, 1.7); }, 0.6, 1e-3);
  // The integral may start anywhere, but comes back to it for every threshold: the equations agree.
  EXPECT_TRUE(orbit_slopes(system, orbit, slopes));
  // With a share of the threshold added it does not.
  const SystemSlopes drifting(
      [](double value) {
        HybridSystem changed = relay(0.6, 1.7);
        for (AffineMode& mode : changed.modes) mode.flow.offset[1] += value - 0.6;
        return changed;
      },
      0.6, 1e-3);
  EXPECT_FALSE(orbit_slopes(system, orbit, drifting));
}

TEST(EdgeOrbitSlopes, WhereTheParameterChangesTheShapeThereAreNone) {
  const PreparedSystem system(without_integral(relay(0.6, 1.7)));
  const PeriodicOrbit orbit = orbit_of(system);
  const SystemSlopes slopes(
      [](double value) {
        HybridSystem changed = without_integral(relay(value, 1.7));
        if (value > 0.6) changed.modes[0].transitions.push_back(changed.modes[0].transitions[0]);
        return changed;
      },
      0.6, 1e-3);
  EXPECT_EQ(slopes.mode(0), nullptr);
  EXPECT_NE(slopes.mode(1), nullptr);
  EXPECT_FALSE(orbit_slopes(system, orbit, slopes));
}

}  // namespace
}  // namespace gearlash::hybrid::orbit_slopes_test
