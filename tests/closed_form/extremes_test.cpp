// Extremes against dense samples, and in the cases that have a closed form.
#include "closed_form/extremes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/traced_draws.hpp"
#include "random_starts.hpp"

namespace gearlash::extremes_test {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();
constexpr double infinity = std::numeric_limits<double>::infinity();

TEST(PropertyExtremes, NoSampleLiesOutsideAndTheyAreReached) {
  TracedDraws draws(801);
  for (int i = 0; i < 300 && !testing::Test::HasFailure(); ++i) {
    const RandomStart start = random_start(draws, {.massless_sides = true});
    SCOPED_TRACE(describe(start));
    const Trajectory motion =
        simulate(start.servo, start.initial,
                 {.until = 15.0, .reference = start.reference, .event_limit = 500});
    const double from = draws.uniform(0.0, 0.5 * motion.end_time());
    const double to = draws.uniform(from, motion.end_time());
    const Extremes range = extremes(motion, from, to);
    const double scale = start.scale() + std::abs(start.reference);
    const double noise = 64.0 * epsilon * 4.0 * scale;
    double fastest = scale;
    Extremes seen;
    constexpr int samples = 2000;
    for (int k = 0; k <= samples; ++k) {
      const ServoState s = motion.at(from + (to - from) * k / samples);
      seen.load.include(s.load_position);
      seen.motor.include(s.motor_position);
      fastest = std::max({fastest, std::abs(s.load_speed), std::abs(s.motor_speed)});
    }
    ASSERT_LE(range.load.low, seen.load.low + noise);
    ASSERT_GE(range.load.high, seen.load.high - noise);
    ASSERT_LE(range.motor.low, seen.motor.low + noise);
    ASSERT_GE(range.motor.high, seen.motor.high - noise);
    // The nearest sample is half a step away, at no more than the largest speed (doubled, for what
    // the samples may not show of it).
    const double missed = 2.0 * fastest * (to - from) / samples + noise;
    ASSERT_GE(range.load.low, seen.load.low - missed);
    ASSERT_LE(range.load.high, seen.load.high + missed);
    ASSERT_GE(range.motor.low, seen.motor.low - missed);
    ASSERT_LE(range.motor.high, seen.motor.high + missed);
  }
}

/// On the forward face at −1, the loop pressing, and bouncing off so that after the next impact the
/// bounces settle in some 6e-6, within the limit of settling_bounces() for rates up to 1.6; the
/// common motion turns when `share` of that time has passed.
ServoState about_to_turn(const NormalizedServo& servo, double share) {
  const ServoDynamics dynamics = servo_dynamics(servo);
  constexpr double settling = 6e-6;
  const double pressing = 1.0 / dynamics.motor_inertia;  // N/(J_M J_L) at (−1, 0)
  const double rebound = 0.5 * pressing * (1.0 - servo.restitution) * settling;
  const double parting = rebound / servo.restitution;
  const double speed = -(2.0 * parting / pressing + share * settling);  // of the common momentum
  const double motor_speed = speed - dynamics.load_inertia * parting;
  return {-1.0 + 0.5 * servo.backlash, motor_speed, -1.0, motor_speed + parting};
}

TEST(PropertyExtremes, ShaftsThatTurnWhileTheFacesSettle) {
  for (const double restitution : {0.03, 0.1, 0.5, 0.8}) {
    for (const double inertia_ratio : {0.2, 1.0, 5.0}) {
      for (const double share : {0.1, 0.4, 0.7, 0.95}) {
        const NormalizedServo servo{.damping = 0.2,
                                    .inertia_ratio = inertia_ratio,
                                    .friction_ratio = 0.3,
                                    .backlash = 0.3,
                                    .restitution = restitution};
        SCOPED_TRACE(testing::Message() << "restitution " << restitution << " inertia ratio "
                                        << inertia_ratio << " share " << share);
        const Trajectory motion =
            simulate(servo, about_to_turn(servo, share), {.until = 1e-2, .reference = 0.0});
        ASSERT_GE(motion.segments().size(), 2U);
        const Segment& settling = motion.segments()[1];
        ASSERT_EQ(settling.phase.mode, Mode::settling);
        const Extremes range = extremes(motion, settling.start, settling.end);
        constexpr int samples = 4000;
        const double step = (settling.end - settling.start) / samples;
        double load_lowest = infinity;
        double motor_lowest = infinity;
        double fastest = 0.0;
        for (int k = 0; k <= samples; ++k) {
          const ServoState s = motion.at(settling.start + step * k);
          load_lowest = std::min(load_lowest, s.load_position);
          motor_lowest = std::min(motor_lowest, s.motor_position);
          fastest = std::max({fastest, std::abs(s.load_speed), std::abs(s.motor_speed)});
        }
        // Where the speed jumps past zero the nearest sample is half a step away.
        const double missed = fastest * step;
        constexpr double noise = 4.0 * epsilon;
        EXPECT_LE(range.load.low - load_lowest, noise);
        EXPECT_LE(load_lowest - range.load.low, missed + noise);
        EXPECT_LE(range.motor.low - motor_lowest, noise);
        EXPECT_LE(motor_lowest - range.motor.low, missed + noise);
      }
    }
  }
}

TEST(OracleExtremes, OvershootOfTheStepResponse) {
  // 1 + e^{−ζπ/√(1−ζ²)} at its first peak.
  const NormalizedServo servo{.damping = 0.3, .inertia_ratio = 1.0, .friction_ratio = 0.5};
  const Trajectory motion = simulate(servo, {}, {.until = 20.0, .reference = 1.0});
  const Extremes range = extremes(motion, 0.0, 20.0);
  const double peak = 1.0 + std::exp(-0.3 * std::numbers::pi / std::sqrt(0.91));
  EXPECT_NEAR(range.load.high, peak, 8.0 * epsilon);
  EXPECT_EQ(range.load.low, 0.0);
  EXPECT_EQ(range.motor.high, range.load.high);
  EXPECT_NEAR(range.load_amplitude(), 0.5 * peak, 8.0 * epsilon);
}

TEST(EdgeExtremes, EmptyAndClampedStretches) {
  const NormalizedServo servo{
      .damping = 0.3, .inertia_ratio = 1.0, .friction_ratio = 0.5, .backlash = 0.2};
  const Trajectory motion =
      simulate(servo, engaged_start(servo, 0.0, 0.0, 1.0), {.until = 10.0, .reference = 1.0});
  const Extremes point = extremes(motion, 2.0, 2.0);
  EXPECT_EQ(point.load.low, motion.at(2.0).load_position);
  EXPECT_EQ(point.load_amplitude(), 0.0);
  const Extremes whole = extremes(motion, 0.0, 10.0);
  const Extremes beyond = extremes(motion, -5.0, 50.0);
  EXPECT_EQ(whole.load.high, beyond.load.high);
  EXPECT_EQ(whole.motor.low, beyond.motor.low);
}

}  // namespace
}  // namespace gearlash::extremes_test
