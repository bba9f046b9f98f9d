// μ₀ against its closed form in complex numbers, against engaged motion in fifty digits, and
// against a simulated disturbance.
#include "closed_form/growth_at_rest.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <optional>

#include "base/fifty_digits.hpp"
#include "base/seeded_draws.hpp"
#include "closed_form/engaged_flow.hpp"
#include "closed_form/trajectory.hpp"

namespace gearlash::growth_at_rest_test {
namespace {

/// The servo's coefficients from its ratios, in fifty digits.
struct WideServo {
  explicit WideServo(const NormalizedServo& servo)
      : damping(servo.damping),
        motor_inertia(1 / (1 + Wide(servo.inertia_ratio))),
        load_inertia(1 - motor_inertia),
        motor_friction(2 * damping * (1 - Wide(servo.friction_ratio))),
        load_friction(2 * damping * servo.friction_ratio),
        motor_rate(motor_friction / motor_inertia),
        load_rate(load_friction / load_inertia) {}
  Wide damping, motor_inertia, load_inertia, motor_friction, load_friction, motor_rate, load_rate;
};

struct WideComplex {
  Wide real;
  Wide imaginary;
};

Wide argument(const WideComplex& z) { return atan2(z.imaginary, z.real); }

/// The closed form of growth_at_rest.hpp, ζ < 1.
Wide closed_form(const WideServo& s) {
  const Wide pi = boost::math::constants::pi<Wide>();
  const Wide w = sqrt(1 - s.damping * s.damping);
  const auto shifted = [&](const Wide& rate) {  // rate·λ̄ − 1
    return WideComplex{rate * s.damping - 1, -rate * w};
  };
  Wide angle = argument(shifted(s.motor_rate)) + argument(shifted(s.load_rate)) +
               2 * argument({s.damping, w}) - pi;
  while (angle <= 0) angle += 2 * pi;
  while (angle > 2 * pi) angle -= 2 * pi;
  const auto form = [&](const Wide& rate) { return rate * rate - 2 * s.damping * rate + 1; };
  return sqrt(form(s.motor_rate) * form(s.load_rate)) / (s.motor_rate * s.load_rate) *
         exp(-s.damping * angle / w);
}

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

TEST(OracleGrowthAtRest, ClosedFormInComplexNumbers) {
  constexpr std::uint64_t seed = 501;
  SCOPED_TRACE(seed);
  SeededDraws draws(seed);
  for (int i = 0; i < 3000; ++i) {
    const NormalizedServo servo = random_servo(draws, 0.97);
    const double growth = growth_at_rest(servo_dynamics(servo));
    ASSERT_LE(epsilons_off(growth, closed_form(WideServo(servo))), 8.0 * condition_of(servo))
        << servo.damping << " " << servo.inertia_ratio << " " << servo.friction_ratio;
  }
}

/// The engaged motion from the creeping contact followed in fifty digits: any damping.
Wide followed(const NormalizedServo& servo) {
  const WideServo s(servo);
  const ServoDynamics d = servo_dynamics(servo);
  const double contact_speed = d.motor_inertia / d.motor_friction;
  Wide time = first_zero(servo.damping, mesh_torque(d, -1.0, contact_speed),
                         mesh_torque_rate(d, -1.0, contact_speed));
  const Wide per_speed = s.load_friction * s.motor_inertia - s.motor_friction * s.load_inertia;
  Wide position;
  Wide speed;
  for (int k = 0; k < 6; ++k) {
    const WideMatrix<2> m = exponential<2>({{{0, time}, {-time, -2 * s.damping * time}}});
    const Wide start_speed = s.motor_inertia / s.motor_friction;
    position = -m[0][0] + m[0][1] * start_speed;
    speed = -m[1][0] + m[1][1] * start_speed;
    const Wide torque = per_speed * speed - s.load_inertia * position;
    const Wide rate = -per_speed * (2 * s.damping * speed + position) - s.load_inertia * speed;
    time -= torque / rate;
  }
  return abs(position + speed / s.load_rate);
}

TEST(OracleGrowthAtRest, EngagedMotionFollowedInFiftyDigits) {
  constexpr std::uint64_t seed = 502;
  SCOPED_TRACE(seed);
  SeededDraws draws(seed);
  int compared = 0;
  for (int i = 0; i < 600; ++i) {
    NormalizedServo servo = random_servo(draws, 3.0);
    if (draws.happens(0.1)) servo.damping = 1.0;
    const double growth = growth_at_rest(servo_dynamics(servo));
    if (growth == 0.0) continue;
    ++compared;
    const Wide exact = followed(servo);
    // Overdamped servos may part after long times: what is left of the amplitude is e^{−t₁/(2ζ)},
    // whose exponent carries its own epsilons.
    const double exponent = std::abs(static_cast<double>(log(exact)));
    const ServoDynamics d = servo_dynamics(servo);
    const auto cancellation = [&](double rate) {
      return (rate * rate + 2.0 * servo.damping * rate + 1.0) /
             std::abs(rate * rate - 2.0 * servo.damping * rate + 1.0);
    };
    const double condition = cancellation(d.motor_rate) + cancellation(d.load_rate) + exponent +
                             1.0 / (1.0 - servo.friction_ratio);
    ASSERT_LE(epsilons_off(growth, exact), 16.0 * condition * condition)
        << servo.damping << " " << servo.inertia_ratio << " " << servo.friction_ratio;
  }
  EXPECT_GT(compared, 200);  // the faces of many an overdamped servo never part again
}

TEST(PropertyGrowthAtRest, UnchangedWhenTheRatesChangePlaces) {
  constexpr std::uint64_t seed = 503;
  SCOPED_TRACE(seed);
  SeededDraws draws(seed);
  for (int i = 0; i < 5000; ++i) {
    const NormalizedServo servo = random_servo(draws, 0.97);
    NormalizedServo exchanged = servo;
    exchanged.friction_ratio = 1.0 - servo.friction_ratio;
    exchanged.inertia_ratio = 1.0 / servo.inertia_ratio;
    const double one = growth_at_rest(servo_dynamics(servo));
    const double other = growth_at_rest(servo_dynamics(exchanged));
    const double condition = condition_of(servo) + 1.0 / servo.friction_ratio;
    ASSERT_NEAR(one, other, 16.0 * epsilon * condition * one);
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
  constexpr std::uint64_t seed = 504;
  SCOPED_TRACE(seed);
  SeededDraws draws(seed);
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
