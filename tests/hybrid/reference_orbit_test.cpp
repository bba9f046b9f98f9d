// Orbits of systems with references: numbers that nothing acts on.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "hybrid/periodic_orbit.hpp"

namespace gearlash::hybrid::reference_orbit_test {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

/// x″ = −x up to x = 0, where x is thrown back to −0.1 and v to (v + 1)/2; and a reference r′ = b −
/// kr that acts on nothing.
HybridSystem kicked_oscillator(double decay, double offset) {
  const Matrix flow{{0.0, 1.0, 0.0}, {-1.0, 0.0, 0.0}, {0.0, 0.0, -decay}};
  const Matrix kick{{1.0, 0.0, 0.0}, {0.0, 0.5, 0.0}, {0.0, 0.0, 1.0}};
  return {.state_names = {"position", "speed", "reference"},
          .modes = {{.name = "swings",
                     .flow = {flow, Vector{{0.0, 0.0, offset}}},
                     .transitions = {{.name = "kick",
                                      .guard = {Vector{{1.0, 0.0, 0.0}}, 0.0},
                                      .direction = Direction::rising,
                                      .reset = {kick, Vector{{-0.1, 0.5, 0.0}}, {}}}}}}};
}

std::optional<PeriodicOrbit> orbit_with(double decay, double offset, double reference) {
  const HybridSystem system = kicked_oscillator(decay, offset);
  const State start{0, Vector{{-0.1, 0.5, reference}}};
  return closing_orbit(system, simulate(system, start, {.until = 10.0}));
}

TEST(OracleReferenceOrbit, AReferenceAtRestIsOfNoMatter) {
  // From the kick to the next v² grows by 0.01: v = √(v² + 0.01)/2 + 1/2.
  const double speed = 2.0 / 3.0 + std::sqrt(4.0 / 9.0 - (0.25 - 0.0025) / 0.75);
  for (const auto& [decay, offset, reference] :
       {std::array{0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}, {1.0, 0.0, 0.0}, {1.0, 1.0, 1.0}}) {
    SCOPED_TRACE(testing::Message() << decay << " " << offset << " " << reference);
    const auto orbit = orbit_with(decay, offset, reference);
    ASSERT_TRUE(orbit);
    EXPECT_NEAR(orbit->events.at(0).after[1], speed, 1e-13);
    EXPECT_NEAR(orbit->period, std::atan(0.1 / speed), 1e-13);
  }
}

TEST(EdgeReferenceOrbit, AReferenceThatNeverComesBackIsNoFault) {
  // A number that counts time.
  EXPECT_NO_THROW(orbit_with(0.0, 1.0, 0.0));
  EXPECT_NO_THROW(orbit_with(0.0, 1.0, 1000.0));
}

/// x″ + 0.1x′ + x = r − centre, a stop at x = 1, r an oscillation of rate 1 about the centre.
HybridSystem impact_oscillator(double centre) {
  const Matrix flow{
      {0.0, 1.0, 0.0, 0.0}, {-1.0, -0.1, 1.0, 0.0}, {0.0, 0.0, 0.0, 1.0}, {0.0, 0.0, -1.0, 0.0}};
  Matrix bounce = Matrix::Identity(4, 4);
  bounce(1, 1) = -0.8;
  return {.state_names = {"position", "speed", "reference", "reference's rate"},
          .modes = {{.name = "free",
                     .flow = {flow, Vector{{0.0, -centre, 0.0, centre}}},
                     .transitions = {{.name = "stop",
                                      .guard = {Vector{{1.0, 0.0, 0.0, 0.0}}, -1.0},
                                      .direction = Direction::rising,
                                      .reset = {.matrix = bounce}}}}}};
}

TEST(OracleReferenceOrbit, ItsCentreIsOfNoMatter) {
  for (const double centre : {0.0, 0.5, 3.0, -20.0}) {
    SCOPED_TRACE(centre);
    const HybridSystem system = impact_oscillator(centre);
    const State start{0, Vector{{0.0, 0.0, 1.0 + centre, 0.0}}};
    for (const double until : {80.0, 200.0}) {
      const auto orbit = closing_orbit(system, simulate(system, start, {.until = until}));
      ASSERT_TRUE(orbit);
      const Vector& after = orbit->events.at(0).after;
      EXPECT_NEAR(after[1], -1.35658635, 5e-9);  // published
      // What rounding of the centre adds up to in the motion.
      const double rounding = 256.0 * epsilon * (1.0 + std::abs(centre));
      EXPECT_NEAR(std::hypot(after[2] - centre, after[3]), 1.0, rounding);
      EXPECT_NEAR(orbit->period, 2.0 * std::numbers::pi, rounding);
    }
  }
}

}  // namespace
}  // namespace gearlash::hybrid::reference_orbit_test
