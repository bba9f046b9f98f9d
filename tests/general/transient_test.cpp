// A transient towards a stable cycle is not listed beside it as another motion.
#include <gtest/gtest.h>

#include <vector>

#include "drives.hpp"
#include "general/attractors/irregular_motion.hpp"

namespace gearlash::drive::transient_test {
namespace {

FoundCycle cycle(Stability stability, double amplitude, double period) {
  FoundCycle found;
  found.orbit.period = period;
  found.stability = stability;
  found.amplitude = amplitude;
  found.motor_amplitude = 1.2 * amplitude;
  found.starts = 3;
  return found;
}

IrregularFound motion(double amplitude, double period) {
  IrregularFound found;
  found.amplitude = amplitude;
  found.motor_amplitude = 1.2 * amplitude;
  found.period = period;
  found.starts = 2;
  return found;
}

TEST(Transient, ThatSwingsAsAStableCycleIsOnItsWayThere) {
  AttractorSearch search;
  search.cycles = {cycle(Stability::stable, 1.0, 2.0), cycle(Stability::unstable, 0.5, 1.5)};
  search.irregular = {motion(1.01, 1.99), motion(0.5, 1.5), motion(1.0, 1.3), motion(1.05, 2.0),
                      motion(0.99, 1.0)};  // the last passes its middle twice a period
  const auto add_start = [&](MotionEnd end, std::size_t which) {
    search.outcomes.emplace_back();
    search.outcomes.back().end = end;
    search.outcomes.back().which = which;
  };
  for (const std::size_t which : {4U, 3U, 0U, 1U, 2U}) add_start(MotionEnd::irregular, which);
  add_start(MotionEnd::cycle, 1);
  take_for_cycles(search, {});
  EXPECT_EQ(search.cycles[0].starts, 3U + 2U + 2U);
  EXPECT_EQ(search.cycles[1].starts, 3U);
  ASSERT_EQ(search.irregular.size(), 3U);
  EXPECT_EQ(search.irregular[0].amplitude, 0.5);
  EXPECT_EQ(search.irregular[1].period, 1.3);
  EXPECT_EQ(search.irregular[2].amplitude, 1.05);
  const auto expect = [&](std::size_t start, MotionEnd end, std::size_t which) {
    EXPECT_EQ(search.outcomes[start].end, end) << start;
    EXPECT_EQ(search.outcomes[start].which, which) << start;
  };
  expect(0, MotionEnd::cycle, 0);
  expect(1, MotionEnd::irregular, 2);
  expect(2, MotionEnd::cycle, 0);
  expect(3, MotionEnd::irregular, 0);
  expect(4, MotionEnd::irregular, 1);
  expect(5, MotionEnd::cycle, 1);
}

/// A start on the cycle, and one beside it that is watched for a few swings only.
TEST(Transient, OfASearchIsListedOnce) {
  const ReducedDrive drive = servo_drive(0.19, 2.0, 0.1);
  AttractorOptions options;
  options.starts = {{1.0, 0.0, 1.0, 0.0}};
  const AttractorSearch found = find_attractors(drive, options);
  ASSERT_EQ(found.cycles.size(), 1U);
  const ShaftStates on_it = shafts_of(found.cycles[0].orbit.start);
  ShaftStates beside = on_it;
  beside.load_speed *= 1.02;
  beside.motor_speed *= 1.02;
  options.starts = {on_it, beside};
  options.swing_times = 8.0;
  options.budget.patience = 1.0;
  for (const bool is_closed : {true, false}) {
    options.tolerances.cycle.wide_nearness = options.tolerances.cycle.widest_nearness =
        is_closed ? 1e-3 : 0.0;
    options.tolerances.cycle.known_event = is_closed ? 1e-4 : 0.0;
    options.tolerances.cycle.nearness = is_closed ? 1e-6 : 1e-12;  // only the cycle itself
    const AttractorSearch both = find_attractors(drive, options);
    ASSERT_EQ(both.cycles.size(), 1U);
    EXPECT_EQ(both.cycles[0].starts, 2U);
    EXPECT_EQ(both.count(MotionEnd::cycle), 2U);
    EXPECT_TRUE(both.irregular.empty());
  }
}

/// 100 swings of 1 rad, of 2 s each.
IrregularFound irregular_motion(double scatter) {
  IrregularFound motion;
  motion.amplitude = 1.2;
  motion.motor_amplitude = 1.0;
  motion.period = 2.0;
  motion.period_deviation = 2.0 * scatter;
  motion.half_swing = 1.0;
  motion.half_swing_deviation = scatter;
  motion.watched = 200.0;
  motion.swings = 100;
  return motion;
}

bool is_one(const IrregularFound& one, const IrregularFound& other) {
  return place_among({one}, other, {}) == 0;
}

/// Means of 100 swings are known to a tenth of the scatter of one.
TEST(IrregularMotions, AreOneWhereChanceExplainsTheirMeans) {
  for (const double scatter : {0.0, 0.5}) {
    const IrregularFound motion = irregular_motion(scatter);
    IrregularFound other = motion;
    other.amplitude = 2.0;  // extremes grow with the time that they are watched
    other.half_swing = 1.06;
    EXPECT_EQ(is_one(motion, other), scatter == 0.5);
    other.half_swing = 1.02;
    EXPECT_TRUE(is_one(motion, other));
    other.period = 2.12;
    EXPECT_EQ(is_one(motion, other), scatter == 0.5);
    other.period = 2.3;
    EXPECT_FALSE(is_one(motion, other));
  }
}

TEST(IrregularMotions, AreOneThoughTheirMiddlesWander) {
  const IrregularFound motion = irregular_motion(0.0);
  IrregularFound other = motion;
  other.center = 0.6;
  other.mean_center = 0.3;
  EXPECT_TRUE(is_one(motion, other));
  other.mean_center = 0.5;
  EXPECT_FALSE(is_one(motion, other));
  other.is_motor_alone = true;  // within the gap, wherever the load stands
  IrregularFound alone = motion;
  alone.is_motor_alone = true;
  EXPECT_TRUE(is_one(alone, other));
}

}  // namespace
}  // namespace gearlash::drive::transient_test
