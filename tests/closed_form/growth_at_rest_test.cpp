// μ₀ against engaged motion in many digits, and against a simulated disturbance.
#include "closed_form/growth_at_rest.hpp"

#include <gtest/gtest.h>

#include <optional>

#include "base/references.hpp"
#include "base/special_numbers.hpp"
#include "base/traced_draws.hpp"
#include "closed_form/trajectory.hpp"

namespace gearlash::growth_at_rest_test {
namespace {

/// What an epsilon in the ratios does to μ₀: c² − 2ζc + 1 may cancel, and ζt₁ is an exponent.
double condition_of(const NormalizedServo& servo) {
  const ServoDynamics d = servo_dynamics(servo);
  const auto cancellation = [&](double rate) {
    const double form = rate * rate - 2.0 * servo.damping * rate + 1.0;
    return (rate * rate + 2.0 * servo.damping * rate + 1.0) / form;
  };
  const double w = std::sqrt((1.0 - servo.damping) * (1.0 + servo.damping));
  return cancellation(d.motor_rate) + cancellation(d.load_rate) + servo.damping * 6.3 / w +
         1.0 / (1.0 - servo.friction_ratio);
}

NormalizedServo random_servo(SeededDraws& draws, double largest_damping) {
  return {.damping = draws.uniform(0.01, largest_damping),
          .inertia_ratio = draws.log_uniform(1e-3, 1e3),
          .friction_ratio = draws.uniform(0.01, 0.99),
          .backlash = 0.3};
}

TEST(OracleGrowthAtRest, KeepsItsDigits) {
  for (const Reference& exact : References("closed_form", "plastic_cycles")) {
    const NormalizedServo servo{.damping = exact.input("damping"),
                                .inertia_ratio = exact.input("inertia_ratio"),
                                .friction_ratio = exact.input("friction_ratio"),
                                .backlash = 0.3};
    const double growth = growth_at_rest(servo_dynamics(servo));
    if (exact["growth"] < std::numeric_limits<double>::min()) {
      EXPECT_LE(growth, std::numeric_limits<double>::min());
      continue;
    }
    double tolerance = 8.0 * condition_of(servo);
    if (servo.damping > 0.97) {
      // Overdamped servos may part after long times: what is left of the amplitude is e^{−t₁/(2ζ)},
      // whose exponent carries its own epsilons.
      const ServoDynamics d = servo_dynamics(servo);
      const auto cancellation = [&](double rate) {
        return (rate * rate + 2.0 * servo.damping * rate + 1.0) /
               std::abs(rate * rate - 2.0 * servo.damping * rate + 1.0);
      };
      const double condition = cancellation(d.motor_rate) + cancellation(d.load_rate) +
                               std::abs(static_cast<double>(std::log(exact["growth"]))) +
                               1.0 / (1.0 - servo.friction_ratio);
      tolerance = 16.0 * condition * condition;
    }
    EXPECT_LE(epsilons_off(growth, exact["growth"]), tolerance)
        << servo.damping << " " << servo.inertia_ratio << " " << servo.friction_ratio;
  }
}

/// The load at rest at −a in the gap, the motor creeping into the forward face at a/F_M; where the
/// load stands when the motor has crept across the gap, which must take it so long that the load
/// has come to rest: a is chosen for that. Nothing where the bounces are too many to follow.
std::optional<double> simulated_growth(const NormalizedServo& servo, double expected) {
  const double amplitude = 1e-8 / std::max(expected, 1e-3);
  const ServoDynamics d = servo_dynamics(servo);
  const ServoState start{-amplitude + 0.5 * servo.backlash, amplitude / d.motor_friction,
                         -amplitude, 0.0};
  const Trajectory motion =
      simulate(servo, start, {.until = 1e9, .reference = 0.0, .event_limit = 2000});
  for (const Event& event : motion.events()) {
    if (event.kind == EventKind::impact && event.face == Face::backward) {
      return std::abs(event.before.load_position) / amplitude;
    }
  }
  if (motion.stop_reason() == StopReason::event_limit) return std::nullopt;
  return 0.0;
}

TEST(OracleGrowthAtRest, ASimulatedSmallDisturbanceGrowsByIt) {
  TracedDraws draws(504);
  int compared = 0;
  for (int i = 0; i < 400; ++i) {
    NormalizedServo servo = random_servo(draws, 0.9);
    servo.friction_ratio = draws.uniform(0.1, 0.9);
    servo.inertia_ratio = draws.log_uniform(0.05, 20.0);
    if (i % 2 == 1) servo.restitution = draws.uniform(0.0, 0.9);
    const double growth = growth_at_rest(servo_dynamics(servo));
    const std::optional<double> seen = simulated_growth(servo, growth);
    if (!seen) continue;
    ++compared;
    // The gap is kept in its own coordinate and snapped to the face, so small positions beside a
    // wide gap cost nothing; what is left is the condition of some ten bounces and one parting.
    ASSERT_NEAR(*seen, growth, 1e-10 * (growth + 1.0))
        << servo.damping << " " << servo.inertia_ratio << " " << servo.friction_ratio << " "
        << servo.restitution;
  }
  EXPECT_GT(compared, 350);
}

TEST(EdgeGrowthAtRest, InfiniteWithoutFrictionOnOneSide) {
  for (const double restitution : {0.0, 0.5}) {
    for (const double share : {0.0, 1.0}) {
      EXPECT_EQ(growth_at_rest(servo_dynamics({.damping = 0.3,
                                               .inertia_ratio = 2.0,
                                               .friction_ratio = share,
                                               .backlash = 0.3,
                                               .restitution = restitution})),
                infinity);
    }
    EXPECT_EQ(growth_at_rest(servo_dynamics({.damping = 0.0,
                                             .inertia_ratio = 2.0,
                                             .friction_ratio = 0.5,
                                             .backlash = 0.3,
                                             .restitution = restitution})),
              infinity);
  }
}

TEST(EdgeGrowthAtRest, ZeroBetweenTheOverdampedRates) {
  // λ₁ ≤ D ≤ λ₂: the faces never part again.
  for (const double damping : {1.01, 1.5, 3.0, 100.0}) {
    const double root = std::sqrt(damping * damping - 1.0);
    for (const double share : {0.01, 0.5, 0.99}) {
      const double rate = damping - root + 2.0 * root * share;
      // D = 2ζ f (1 + r)/r = rate, at f = 1/2: r = ζ/(rate − ζ) needs rate > ζ.
      const double friction_ratio = rate > 1.05 * damping ? 0.5 : 0.3 * rate / damping;
      const double inertia_ratio =
          2.0 * damping * friction_ratio / (rate - 2.0 * damping * friction_ratio);
      if (!(inertia_ratio > 0.0)) continue;
      const ServoDynamics d = servo_dynamics({.damping = damping,
                                              .inertia_ratio = inertia_ratio,
                                              .friction_ratio = friction_ratio,
                                              .backlash = 0.3});
      ASSERT_NEAR(d.load_rate, rate, 1e-12 * rate);
      EXPECT_EQ(growth_at_rest(d), 0.0) << damping << " " << share;
    }
  }
}

TEST(EdgeGrowthAtRest, MasslessSidesAreLimits) {
  for (const double restitution : {0.0, 0.5}) {
    NormalizedServo servo{.damping = 0.3,
                          .inertia_ratio = 0.0,
                          .friction_ratio = 0.2,
                          .backlash = 0.3,
                          .restitution = restitution};
    const double massless_load = growth_at_rest(servo_dynamics(servo));
    servo.inertia_ratio = 1e-8;
    EXPECT_NEAR(growth_at_rest(servo_dynamics(servo)), massless_load, 1e-6 * massless_load);
    servo.inertia_ratio = infinity;
    const double massless_motor = growth_at_rest(servo_dynamics(servo));
    servo.inertia_ratio = 1e8;
    EXPECT_NEAR(growth_at_rest(servo_dynamics(servo)), massless_motor, 1e-6 * massless_motor);
  }
}

}  // namespace
}  // namespace gearlash::growth_at_rest_test
