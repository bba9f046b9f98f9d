// What the motion tends to as a parameter tends to the end of its range is the motion there.
#include <gtest/gtest.h>

#include <complex>
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

constexpr NormalizedServo sample{
    .damping = 0.19, .inertia_ratio = 2.0, .friction_ratio = 0.1, .backlash = 0.3};

/// A number of the sample, or of another servo, at a value from which it departs one way.
struct Limit {
  double NormalizedServo::*number;
  double value;
  double way = 1.0;
  NormalizedServo servo = sample;

  /// About infinity, 1/distance.
  NormalizedServo at(double distance) const {
    NormalizedServo near = servo;
    near.*number = std::isfinite(value) ? value + way * distance
                   : distance > 0.0     ? 1.0 / distance
                                        : value;
    return near;
  }
};

/// The motions nearby tend to that of the limit, in proportion to the distance or faster.
void expect_convergence(const Limit& limit, const std::vector<double>& distances,
                        double constant = 100.0) {
  for (const double side : {1.0, -1.0}) {
    SCOPED_TRACE(testing::Message() << limit.value << " to the side of " << limit.way);
    const SimulationOptions options{.until = 8.0, .reference = side};
    const ServoState start = engaged_start(limit.at(0.0), 0.0, 0.0, side);
    const Trajectory there = simulate(limit.at(0.0), start, options);
    for (const double distance : distances) {
      EXPECT_LE(apart(simulate(limit.at(distance), start, options), there),
                constant * distance + 1e-13)
          << "at a distance of " << distance;
    }
  }
}

TEST(PropertyLimits, LightShaftsTendToMasslessOnes) {
  for (const double restitution : {0.0, 0.5}) {
    const NormalizedServo servo{
        .damping = 0.3, .friction_ratio = 0.4, .backlash = 0.2, .restitution = restitution};
    for (const double massless : {0.0, infinity}) {
      expect_convergence({&NormalizedServo::inertia_ratio, massless, 1.0, servo},
                         {1e-4, 1e-6, 1e-8});
    }
  }
}

/// The kinds of contact, critical damping, equal rates (D = c at an inertia ratio of 2), and no
/// friction on either side or both.
TEST(PropertyLimits, ThroughWhereTheFormulasChange) {
  for (const Limit& limit :
       {Limit{&NormalizedServo::restitution, 0.0}, Limit{&NormalizedServo::damping, 1.0},
        Limit{&NormalizedServo::damping, 1.0, -1.0},
        Limit{&NormalizedServo::friction_ratio, 2.0 / 3.0},
        Limit{&NormalizedServo::friction_ratio, 2.0 / 3.0, -1.0},
        Limit{&NormalizedServo::friction_ratio, 0.0},
        Limit{&NormalizedServo::friction_ratio, 1.0, -1.0},
        Limit{&NormalizedServo::damping, 0.0}}) {
    expect_convergence(limit, {1e-2, 1e-4, 1e-6, 1e-9, 1e-12, 1e-15});
  }
  expect_convergence({&NormalizedServo::restitution, 1.0, -1.0}, {1e-4, 1e-6, 1e-9, 1e-12, 1e-15},
                     1e3);
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

}  // namespace
}  // namespace gearlash::trajectory_limit_test
