// Extremes against dense samples, and in the cases that have a closed form.
#include "gearlash/motion/extremes.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <numbers>

#include "random_starts.hpp"

namespace gearlash {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

TEST(PropertyExtremes, NoSampleLiesOutsideAndTheyAreReached) {
  constexpr std::uint64_t seed = 801;
  SCOPED_TRACE(seed);
  SeededDraws draws(seed);
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
    Extremes seen{1e300, -1e300, 1e300, -1e300};
    constexpr int samples = 2000;
    for (int k = 0; k <= samples; ++k) {
      const ServoState s = motion.at(from + (to - from) * k / samples);
      seen = {std::min(seen.load_lowest, s.load_position),
              std::max(seen.load_highest, s.load_position),
              std::min(seen.motor_lowest, s.motor_position),
              std::max(seen.motor_highest, s.motor_position)};
      fastest = std::max({fastest, std::abs(s.load_speed), std::abs(s.motor_speed)});
    }
    ASSERT_LE(range.load_lowest, seen.load_lowest + noise);
    ASSERT_GE(range.load_highest, seen.load_highest - noise);
    ASSERT_LE(range.motor_lowest, seen.motor_lowest + noise);
    ASSERT_GE(range.motor_highest, seen.motor_highest - noise);
    // The nearest sample is half a step away, at no more than the largest speed (doubled, for what
    // the samples may not show of it).
    const double missed = 2.0 * fastest * (to - from) / samples + noise;
    ASSERT_GE(range.load_lowest, seen.load_lowest - missed);
    ASSERT_LE(range.load_highest, seen.load_highest + missed);
    ASSERT_GE(range.motor_lowest, seen.motor_lowest - missed);
    ASSERT_LE(range.motor_highest, seen.motor_highest + missed);
  }
}

TEST(OracleExtremes, OvershootOfTheStepResponse) {
  // 1 + e^{−ζπ/√(1−ζ²)} at its first peak.
  const NormalizedServo servo{.damping = 0.3, .inertia_ratio = 1.0, .friction_ratio = 0.5};
  const Trajectory motion = simulate(servo, {}, {.until = 20.0, .reference = 1.0});
  const Extremes range = extremes(motion, 0.0, 20.0);
  const double peak = 1.0 + std::exp(-0.3 * std::numbers::pi / std::sqrt(0.91));
  EXPECT_NEAR(range.load_highest, peak, 8.0 * epsilon);
  EXPECT_EQ(range.load_lowest, 0.0);
  EXPECT_EQ(range.motor_highest, range.load_highest);
  EXPECT_NEAR(range.load_size(), 0.5 * peak, 8.0 * epsilon);
}

TEST(EdgeExtremes, EmptyAndClampedStretches) {
  const NormalizedServo servo{
      .damping = 0.3, .inertia_ratio = 1.0, .friction_ratio = 0.5, .backlash = 0.2};
  const Trajectory motion =
      simulate(servo, engaged_start(servo, 0.0, 0.0, 1.0), {.until = 10.0, .reference = 1.0});
  const Extremes point = extremes(motion, 2.0, 2.0);
  EXPECT_EQ(point.load_lowest, motion.at(2.0).load_position);
  EXPECT_EQ(point.load_size(), 0.0);
  const Extremes whole = extremes(motion, 0.0, 10.0);
  const Extremes beyond = extremes(motion, -5.0, 50.0);
  EXPECT_EQ(whole.load_highest, beyond.load_highest);
  EXPECT_EQ(whole.motor_lowest, beyond.motor_lowest);
}

}  // namespace
}  // namespace gearlash
