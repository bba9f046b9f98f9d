// Cycles of relays within the gap, as answers, beside closed forms.
#include <gtest/gtest.h>

#include <cmath>

#include "gearlash/analyse.hpp"

namespace gearlash::relay_test {
namespace {

constexpr double inertia = 2.0;
constexpr double level = 0.7;

/// The motor is measured; dry friction holds the load.
Drive motor_in_gap(RelayInput input, double hysteresis, double friction) {
  Drive drive;
  drive.motor = {.kind = TorqueControl{}, .inertia = inertia, .friction = {.viscous = friction}};
  drive.gearbox = {.ratio = 1.0, .backlash = 1.5};
  drive.load = {.inertia = 1.0, .friction = {.viscous = 0.1, .coulomb = 0.2}};
  drive.sensor.position = SensorPlace::motor;
  drive.controller.law = RelayController{.level = level, .input = input};
  drive.controller.dead_band.hysteresis = hysteresis;
  return drive;
}

const Cycle& only_cycle(const Answer& answer) {
  EXPECT_EQ(answer.verdict, Verdict::hunts);
  EXPECT_EQ(answer.cycles.size(), 1U);
  return answer.cycles.at(0);
}

/// The speed is a triangle between ±β: period 4 J β/M, position ±J β²/(2 M). Ruderman, Yamada and
/// Fujimoto (arXiv 1802.06246) find backlash by such a cycle.
TEST(OracleRelayAnswer, OfTheSpeedHuntsWithinTheGap) {
  const Answer answer = analyse(motor_in_gap(RelayInput::speed, 0.4, 0.0));
  const Cycle& cycle = only_cycle(answer);
  EXPECT_NEAR(cycle.period, 4.0 * inertia * 0.4 / level, 1e-12);
  EXPECT_NEAR(cycle.motor_amplitude, 0.5 * inertia * 0.16 / level, 1e-12);
  EXPECT_EQ(cycle.amplitude, 0.0);
}

/// Half a period T of J x″ + F x′ = ±M between x = −h and h (Tsypkin): with E = e^{−F T/J},
/// M T/F − 2 (M J/F²) (1 − E)/(1 + E) = 2 h.
TEST(OracleRelayAnswer, OfThePositionHuntsWithTsypkinsPeriod) {
  constexpr double friction = 0.3;
  constexpr double hysteresis = 0.05;
  const Answer answer = analyse(motor_in_gap(RelayInput::error, hysteresis, friction));
  const Cycle& cycle = only_cycle(answer);
  const double half = 0.5 * cycle.period;
  const double decay = std::exp(-friction * half / inertia);
  const double way = level * half / friction -
                     2.0 * level * inertia / (friction * friction) * (1.0 - decay) / (1.0 + decay);
  EXPECT_NEAR(way, 2.0 * hysteresis, 1e-12);
}

}  // namespace
}  // namespace gearlash::relay_test
