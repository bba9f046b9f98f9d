// How long motion takes to rest, and whether swings may still decay.
#include "general/attractors/time_to_rest.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "drives.hpp"
#include "general/attractors/irregular_motion.hpp"

namespace gearlash::drive::time_to_rest_test {
namespace {

/// Steps of 3, 0.6, … rad that take 2, 8, … s: 0.02 rad is passed at the fourth.
TEST(TimeToRest, OfShrinkingStepsIsTheSumOfTheirDurations) {
  const ShrinkingSteps steps{.size = 3.0, .ratio = 0.2, .duration = 0.5, .duration_ratio = 4.0};
  EXPECT_NEAR(time_until_within(0.02, steps), 2.0 + 8.0 + 32.0 + 128.0, 1e-9);
  EXPECT_EQ(time_until_within(3.0, steps), 0.0);
  const ShrinkingSteps even{.size = 1.0, .ratio = 0.5, .duration = 2.0};
  EXPECT_NEAR(time_until_within(0.1, even), 4.0 * 2.0, 1e-12);
}

/// Overdamped, with its faces together: y″ + 4y′ + y = 0 from 1 rad.
double closed_form_time(double band) {
  const double root = std::sqrt(3.0);
  const double slow = 2.0 - root;
  const double fast = 2.0 + root;
  const auto place = [&](double t) {
    return (fast * std::exp(-slow * t) - slow * std::exp(-fast * t)) / (fast - slow);
  };
  double low = 0.0;
  double high = 1e3;
  for (int i = 0; i < 200; ++i)
    (place(0.5 * (low + high)) > band ? low : high) = 0.5 * (low + high);
  return low;
}

TEST(TimeToRest, OfAnOverdampedServoIsThatOfItsSlowDecay) {
  ReducedDrive drive = servo_drive(2.0, 0.1, 0.02);
  for (const double band : {0.5, 1e-2, 1e-4}) {
    const AttractorSearch found = find_attractors(
        drive,
        {.starts = {{1.0 - 0.5 * drive.backlash, 0.0, 1.0, 0.0}}, .most_edges = 0, .band = band});
    ASSERT_EQ(found.outcomes.front().end, MotionEnd::rest);
    ASSERT_TRUE(found.outcomes.front().time_to_rest);
    EXPECT_NEAR(*found.outcomes.front().time_to_rest, closed_form_time(band), 1e-6);
  }
}

TEST(TimeToRest, IsNoneOfAStartOnTheEndOfTheBand) {
  const ReducedDrive drive = servo_drive(2.0, 0.1, 0.02);
  constexpr double rounding = 1e-12;
  const AttractorSearch found =
      find_attractors(drive, {.starts = {{1.0 - 0.5 * drive.backlash, 0.0, 1.0, 0.0}},
                              .most_edges = 0,
                              .band = 1.0 - rounding});
  EXPECT_EQ(found.outcomes.front().time_to_rest, 0.0);
}

/// Every rest of drives with dry friction, sampled or not, against the motion itself.
TEST(PropertyTimeToRest, IsThatOfTheMotion) {
  int compared = 0;
  for (const bool is_sampled : {false, true}) {
    for (const double friction : {0.02, 0.05, 0.1}) {
      ReducedDrive drive = servo_drive(0.2, 2.0, 0.3);
      drive.motor.friction.coulomb = drive.motor.friction.breakaway = friction;
      if (is_sampled) drive.sampling = Sampling{.period = 0.01};
      const AttractorSearch found = find_attractors(drive, {.most_edges = 0});
      for (const Outcome& outcome : found.outcomes) {
        if (outcome.end != MotionEnd::rest) continue;
        ASSERT_TRUE(outcome.time_to_rest);
        const double time = *outcome.time_to_rest;
        const SearchSetting setting = search_setting(drive);
        const double until = setting.between_ticks(1.2 * time + 20.0);
        const auto motion =
            simulate(setting.system, setting.start(outcome.start), {.until = until});
        double last = 0.0;
        constexpr double step = 1e-3;
        for (double t = 0.0; t < until; t += step) {
          const double off = setting.load.value.at(motion.at(t).numbers) - outcome.rest->load;
          if (std::abs(off) > found.band) last = t;
        }
        EXPECT_NEAR(time, last, 0.01 * last + 2.0 * step);
        ++compared;
      }
    }
  }
  EXPECT_GT(compared, 40);
}

std::vector<Sample> swings_of(int count, double decay, double scatter) {
  std::mt19937 random(7);
  std::vector<Sample> turns;
  double side = 1.0;
  for (int i = 0; i < count; ++i) {
    const double share = 2.0 * static_cast<double>(random()) / 4294967296.0 - 1.0;
    turns.push_back({0.5 * i, side * std::exp(-decay * 0.5 * i) * (1.0 + scatter * share)});
    side = -side;
  }
  return turns;
}

TEST(FastestDecay, IsTheirOwnWhereSwingsDoNotScatter) {
  EXPECT_NEAR(fastest_decay(swings_of(400, 0.01, 0.0)), 0.01, 1e-4);
  EXPECT_NEAR(fastest_decay(swings_of(400, -0.01, 0.0)), -0.01, 1e-4);
  EXPECT_NEAR(fastest_decay(swings_of(12, 0.05, 0.0)), 0.05, 1e-3);
  EXPECT_TRUE(std::isinf(fastest_decay(swings_of(8, 0.0, 0.0))));
}

/// 50 swings that scatter by a third may still decay; 5000 do not.
TEST(FastestDecay, IsExcludedByMoreSwings) {
  const auto is_excluded = [](int swings, double decay) {
    return excludes_decay(fastest_decay(swings_of(swings, decay, 0.5)), 0.5 * swings,
                          IrregularTolerances{});
  };
  EXPECT_FALSE(is_excluded(50, 0.0));
  EXPECT_TRUE(is_excluded(5000, 0.0));
  EXPECT_FALSE(is_excluded(5000, 0.2 / 2500.0));
}

}  // namespace
}  // namespace gearlash::drive::time_to_rest_test
