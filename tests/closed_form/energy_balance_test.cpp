// Servos that no restitution can make hunt: the test is exact, and what it says is so.
#include "closed_form/energy_balance.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/traced_draws.hpp"
#include "closed_form/growth_at_rest.hpp"
#include "closed_form/limit_cycle.hpp"

namespace gearlash::energy_balance_test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

NormalizedServo servo_of(double damping, double inertia_ratio, double friction_ratio,
                         double restitution = 0.0) {
  return {.damping = damping,
          .inertia_ratio = inertia_ratio,
          .friction_ratio = friction_ratio,
          .backlash = 0.3,
          .restitution = restitution};
}

TEST(EdgeEnergyBalance, IsDecidedExactlyOnItsBoundary) {
  // ζ = 1, no load inertia: f ≤ 4f(1 − f) ends at f = 3/4, by symmetry at 1/4 without motor
  // inertia.
  const double above = std::nextafter(0.75, 1.0);
  EXPECT_TRUE(is_dissipative(servo_of(1.0, 0.0, 0.75)));
  EXPECT_FALSE(is_dissipative(servo_of(1.0, 0.0, above)));
  EXPECT_TRUE(is_dissipative(servo_of(1.0, infinity, 0.25)));
  EXPECT_FALSE(is_dissipative(servo_of(1.0, infinity, std::nextafter(0.25, 0.0))));
  EXPECT_FALSE(is_dissipative(servo_of(std::nextafter(1.0, 0.0), 0.0, 0.75)));
  // f (1 − f) = 1/4 at f = 1/2: (1 + r)/2 ≤ ζ²(1 + r), whatever r is.
  for (const double ratio : {1e-9, 0.3, 1.0, 7.0, 1e9}) {
    const double root = std::sqrt(0.5);
    EXPECT_EQ(is_dissipative(servo_of(root, ratio, 0.5)),
              root * root >= 0.5 && std::fma(root, root, -0.5) >= 0.0);
    EXPECT_TRUE(is_dissipative(servo_of(std::nextafter(root, 1.0), ratio, 0.5)));
    EXPECT_FALSE(is_dissipative(servo_of(std::nextafter(root, 0.0), ratio, 0.5)));
  }
}

TEST(EdgeEnergyBalance, DecimalsAreTakenAsWritten) {
  // No load inertia: f ends at 1 − 1/4ζ², which is 0.9975 for ζ = 10; its double is
  // above that.
  const double decimal = 0.9975;
  EXPECT_TRUE(is_dissipative(servo_of(10.0, 0.0, decimal), Reading::decimal));
  EXPECT_FALSE(is_dissipative(servo_of(10.0, 0.0, decimal), Reading::exact));
  EXPECT_FALSE(is_dissipative(servo_of(10.0, 0.0, std::nextafter(decimal, 1.0)), Reading::decimal));
}

/// In extended precision: no draw is as near to the boundary as its rounding.
TEST(OracleEnergyBalance, AgreesWithTheSignOfTheInequality) {
  TracedDraws draws(1821);
  int inside = 0;
  for (int i = 0; i < 5000; ++i) {
    const double damping = draws.log_uniform(0.1, 1000.0);
    const double ratio = draws.log_uniform(1e-6, 1e6);
    const double friction =
        draws.happens(0.5) ? draws.uniform(0.0, 1.0) : 1.0 - draws.log_uniform(1e-15, 0.5);
    const long double z = damping, r = ratio, f = friction;
    const bool expected = f + (1 - f) * r <= 4 * z * z * f * (1 - f) * (1 + r);
    ASSERT_EQ(is_dissipative(servo_of(damping, ratio, friction)), expected);
    inside += expected;
    // A box of the servo says no more.
    if (is_dissipative(box_of(servo_of(damping, ratio, friction), Reading::exact))) {
      ASSERT_TRUE(expected);
    }
  }
  EXPECT_GT(inside, 500);
}

TEST(PropertyEnergyBalance, WithPlasticContactItLiesWhereNothingHunts) {
  SeededDraws draws(1822);
  int inside = 0;
  int resting = 0;
  for (int i = 0; i < 20000; ++i) {
    const NormalizedServo servo = servo_of(draws.log_uniform(0.05, 100.0),
                                           draws.log_uniform(1e-4, 1e4), draws.uniform(0.0, 1.0));
    const bool rests = growth_at_rest(servo_dynamics(servo)) <= 1.0;
    resting += rests;
    if (!is_dissipative(servo)) continue;
    ++inside;
    ASSERT_TRUE(rests) << servo.damping << " " << servo.inertia_ratio << " "
                       << servo.friction_ratio;
  }
  EXPECT_GT(inside, 3000);
  EXPECT_LT(inside, resting);
}

TEST(PropertyEnergyBalance, ItIsAProofForEveryRestitution) {
  SeededDraws draws(1823);
  for (int i = 0; i < 200; ++i) {
    const NormalizedServo servo =
        servo_of(draws.uniform(0.7, 5.0), draws.log_uniform(0.01, 100.0), draws.uniform(0.0, 1.0),
                 draws.one_of({0.1, 0.5, 0.9, 1.0}));
    if (!is_dissipative(servo)) continue;
    const LimitCycleAnalysis analysis = analyse_limit_cycles(servo);
    ASSERT_EQ(analysis.verdict, Verdict::cannot_hunt);
    ASSERT_EQ(analysis.certainty, Certainty::theorem);
    ASSERT_TRUE(analysis.is_dissipative);
    ASSERT_TRUE(analysis.cycles.empty());
  }
}

}  // namespace
}  // namespace gearlash::energy_balance_test
