// What the motion tends to as a parameter tends to the end of its range is the motion there.
#include <gtest/gtest.h>

#include <complex>
#include <cstdint>
#include <vector>

#include "closed_form/trajectory.hpp"
#include "random_starts.hpp"

namespace gearlash::trajectory_limit_test {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();
constexpr double infinity = std::numeric_limits<double>::infinity();

TEST(OracleNoBacklash, IsTheSecondOrderStepResponse) {
  for (const double damping : {0.0, 0.1, 0.7, 1.0, 1.0 + 1e-9, 2.5}) {
    const NormalizedServo servo{.damping = damping, .inertia_ratio = 3.0, .friction_ratio = 0.3};
    const Trajectory motion = simulate(servo, {}, {.until = 30.0, .reference = 1.0});
    EXPECT_TRUE(motion.events().empty());
    EXPECT_EQ(motion.mode_at(3.0), Mode::no_gap);
    for (const double time : {0.0, 0.1, 1.0, 5.0, 30.0}) {
      // 1 − Re(e^{λt} (…)) by complex roots; the double root by its own form.
      using Complex = std::complex<long double>;
      const long double zeta = damping;
      const long double t = time;
      Complex response;
      if (damping == 1.0) {
        response = (1.0L + t) * std::exp(-t);
      } else {
        const Complex root = std::sqrt(Complex(zeta * zeta - 1.0L));
        const Complex slow = -zeta + root;
        const Complex fast = -zeta - root;
        response = (slow * std::exp(fast * t) - fast * std::exp(slow * t)) / (slow - fast);
      }
      const double expected = static_cast<double>(1.0L - response.real());
      const ServoState state = motion.at(time);
      // Near ζ = 1 the roots of the reference itself are 1e-5 apart: its long double loses five of
      // nineteen digits; elsewhere the angle or exponent carries 1 + t epsilons.
      EXPECT_NEAR(state.load_position, expected, 16.0 * epsilon * (1.0 + time)) << damping;
      EXPECT_EQ(state.motor_position, state.load_position);
      EXPECT_EQ(state.motor_speed, state.load_speed);
    }
  }
}

TEST(EdgeNoBacklash, UnequalSpeedsAreSharedAtOnce) {
  const NormalizedServo servo{.damping = 0.1, .inertia_ratio = 3.0, .friction_ratio = 0.3};
  const Trajectory motion = simulate(servo, {0.0, 1.0, 0.0, 0.0}, {.until = 1.0, .reference = 0.0});
  EXPECT_DOUBLE_EQ(motion.at(0.0).load_speed, 0.25);
  EXPECT_DOUBLE_EQ(motion.at(0.0).motor_speed, 0.25);
}

/// Largest difference of the load's and motor's positions at times between 0.5 and 8.
double apart(const Trajectory& a, const Trajectory& b) {
  double largest = 0.0;
  for (int k = 1; k <= 16; ++k) {
    const ServoState x = a.at(0.5 * k);
    const ServoState y = b.at(0.5 * k);
    largest = std::max({largest, std::abs(x.load_position - y.load_position),
                        std::abs(x.motor_position - y.motor_position)});
  }
  return largest;
}

struct Limit {
  NormalizedServo near;
  double small;  ///< the distance from the limit
};

/// The motions of `near` tend to that of `limit` at least as fast as small^order.
void expect_convergence(const NormalizedServo& limit, const std::vector<Limit>& approach,
                        double order, double constant) {
  for (const double side : {1.0, -1.0}) {
    const SimulationOptions options{.until = 8.0, .reference = side};
    const ServoState start = engaged_start(limit, 0.0, 0.0, side);
    const Trajectory there = simulate(limit, start, options);
    for (const Limit& step : approach) {
      const double difference = apart(simulate(step.near, start, options), there);
      EXPECT_LE(difference, constant * std::pow(step.small, order) + 1e-13)
          << "at a distance of " << step.small;
    }
  }
}

TEST(PropertyLimits, LightLoadsTendToTheMasslessLoad) {
  for (const double restitution : {0.0, 0.5}) {
    NormalizedServo limit{.damping = 0.3,
                          .inertia_ratio = 0.0,
                          .friction_ratio = 0.4,
                          .backlash = 0.2,
                          .restitution = restitution};
    std::vector<Limit> approach;
    for (const double light : {1e-4, 1e-6, 1e-8}) {
      NormalizedServo near = limit;
      near.inertia_ratio = light;
      approach.push_back({near, light});
    }
    expect_convergence(limit, approach, 1.0, 100.0);
  }
}

TEST(PropertyLimits, LightMotorsTendToTheMasslessMotor) {
  for (const double restitution : {0.0, 0.5}) {
    NormalizedServo limit{.damping = 0.3,
                          .inertia_ratio = infinity,
                          .friction_ratio = 0.4,
                          .backlash = 0.2,
                          .restitution = restitution};
    std::vector<Limit> approach;
    for (const double light : {1e-4, 1e-6, 1e-8}) {
      NormalizedServo near = limit;
      near.inertia_ratio = 1.0 / light;
      approach.push_back({near, light});
    }
    expect_convergence(limit, approach, 1.0, 100.0);
  }
}

template <class Change>
void expect_continuous(const NormalizedServo& limit, const Change& change,
                       const std::vector<double>& distances, double order, double constant) {
  std::vector<Limit> approach;
  for (const double distance : distances) {
    NormalizedServo near = limit;
    change(near, distance);
    approach.push_back({near, distance});
  }
  expect_convergence(limit, approach, order, constant);
}

const std::vector<double> shrinking{1e-2, 1e-4, 1e-6, 1e-9, 1e-12, 1e-15};
const NormalizedServo sample{
    .damping = 0.19, .inertia_ratio = 2.0, .friction_ratio = 0.1, .backlash = 0.3};

TEST(PropertyLimits, NearlyPlasticTendsToPlastic) {
  expect_continuous(
      sample, [](NormalizedServo& s, double small) { s.restitution = small; }, shrinking, 1.0,
      100.0);
}

TEST(PropertyLimits, NearlyElasticTendsToElastic) {
  NormalizedServo limit = sample;
  limit.restitution = 1.0;
  expect_continuous(
      limit, [](NormalizedServo& s, double small) { s.restitution = 1.0 - small; },
      {1e-4, 1e-6, 1e-9, 1e-12, 1e-15}, 1.0, 1e3);
}

TEST(PropertyLimits, ThroughCriticalDamping) {
  NormalizedServo limit = sample;
  limit.damping = 1.0;
  for (const double side : {-1.0, 1.0}) {
    expect_continuous(
        limit, [&](NormalizedServo& s, double small) { s.damping = 1.0 + side * small; }, shrinking,
        1.0, 100.0);
  }
}

TEST(PropertyLimits, ThroughEqualRates) {
  NormalizedServo limit = sample;
  limit.friction_ratio = 2.0 / 3.0;  // D = c at an inertia ratio of 2
  for (const double side : {-1.0, 1.0}) {
    expect_continuous(
        limit,
        [&](NormalizedServo& s, double small) { s.friction_ratio = 2.0 / 3.0 + side * small; },
        shrinking, 1.0, 100.0);
  }
}

TEST(PropertyLimits, FrictionVanishingOnEitherSideOrBoth) {
  NormalizedServo no_load_friction = sample;
  no_load_friction.friction_ratio = 0.0;
  expect_continuous(
      no_load_friction, [](NormalizedServo& s, double small) { s.friction_ratio = small; },
      shrinking, 1.0, 100.0);
  NormalizedServo no_motor_friction = sample;
  no_motor_friction.friction_ratio = 1.0;
  expect_continuous(
      no_motor_friction, [](NormalizedServo& s, double small) { s.friction_ratio = 1.0 - small; },
      shrinking, 1.0, 100.0);
  NormalizedServo none = sample;
  none.damping = 0.0;
  expect_continuous(
      none, [](NormalizedServo& s, double small) { s.damping = small; }, shrinking, 1.0, 100.0);
}

TEST(PropertyLimits, VanishingBacklashTendsToNone) {
  NormalizedServo limit = sample;
  limit.backlash = 0.0;
  const SimulationOptions options{.until = 8.0, .reference = 1.0};
  const Trajectory there = simulate(limit, {}, options);
  for (const double small : {1e-3, 1e-6, 1e-9, 1e-12}) {
    NormalizedServo near = sample;
    near.backlash = small;
    const Trajectory motion = simulate(near, engaged_start(near, 0.0, 0.0, 1.0), options);
    EXPECT_EQ(motion.stop_reason(), StopReason::reached_end);
    EXPECT_LE(apart(motion, there), 100.0 * small + 1e-13);
  }
}

TEST(EdgeLimits, FrictionlessMotionGrowsAndKeepsItsEnergyBooks) {
  // ζ = 0, plastic: the gap feeds energy in at every crossing and nothing but impacts takes it out.
  const NormalizedServo servo{
      .damping = 0.0, .inertia_ratio = 1.0, .friction_ratio = 0.5, .backlash = 0.3};
  const Trajectory motion =
      simulate(servo, engaged_start(servo, -0.5, 0.0, 0.0), {.until = 500.0, .reference = 0.0});
  EXPECT_GT(motion.energy_at(500.0).stored(), 4.0 * motion.energy_at(0.0).stored());
}

}  // namespace
}  // namespace gearlash::trajectory_limit_test
