// Drives of users whose motions ended elsewhere than version 0.2 said.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>

#include "gearlash/analyse.hpp"
#include "gearlash/input.hpp"
#include "gearlash/motion.hpp"

namespace gearlash::ends_test {
namespace {

const std::filesystem::path data =
    std::filesystem::path(GEARLASH_SOURCE_DIRECTORY) / "tests/regression/data/ends";

Answer answer_of(const std::string& file) { return analyse(read_drive(data / (file + ".toml"))); }

/// Integral action pushes the motor across the gap for 30 s while the load stands, without dry
/// friction: no law of creeping. An independent simulation hunts by ±0.3153 rad from every start.
TEST(Ends, AStandingLoadWhoseMotorCrossesTheGapHunts) {
  const Answer answer = answer_of("motor-takes-long-to-cross-its-gap");
  EXPECT_EQ(answer.verdict, Verdict::hunts);
  EXPECT_FALSE(answer.rest);
  ASSERT_EQ(answer.cycles.size(), 1U);
  EXPECT_NEAR(answer.cycles[0].amplitude, 0.3153, 0.0001);
}

/// From the starts on a face the motor slides up to the reference and never stops. simulate() from
/// 2e-5 rad to either side, and the fixed-step simulator, hunt within the gap.
TEST(Ends, AMotorHuntsAloneNearItsReference) {
  const Answer answer = answer_of("motor-hunts-alone-near-its-reference");
  EXPECT_EQ(answer.verdict, Verdict::hunts_if_disturbed);
  ASSERT_EQ(answer.cycles.size(), 1U);
  EXPECT_NEAR(answer.cycles[0].motor_amplitude, 7.891882e-6, 1e-11);
  EXPECT_EQ(answer.cycles[0].amplitude, 0.0);
}

/// Of several irregular motions every verb names the largest, which is listed first.
TEST(Ends, TheLargestOfIrregularMotionsIsListedFirst) {
  const Answer answer = analyse(read_drive(data / "../industrial/rnd08.toml"));
  ASSERT_GT(answer.irregular.size(), 1U);
  ASSERT_EQ(answer.largest_stable(), nullptr);
  double largest = 0.0;
  for (const IrregularMotion& motion : answer.irregular) {
    largest = std::max(largest, motion.amplitude);
  }
  EXPECT_EQ(answer.irregular.front().amplitude, largest);
  EXPECT_EQ(answer.value(Quantity::amplitude), largest);
  for (const StartOutcome& start : answer.search->starts) {
    if (start.end != "irregular") continue;
    ASSERT_TRUE(start.which);
    EXPECT_LT(*start.which, answer.irregular.size());
  }
}

/// The reading is two counts off, as far as the dead band reaches: nothing is integrated.
TEST(Ends, ADeadBandOfWholeCountsIsComparedInCounts) {
  const Answer answer = answer_of("dead-band-of-two-counts");
  EXPECT_EQ(answer.verdict, Verdict::comes_to_rest);
  EXPECT_EQ(answer.search->count("rest"), answer.search->starts.size());
}

/// Samples at bounces look like pauses, and nothing holds the shafts.
TEST(Ends, NothingCreepsWithoutDryFriction) {
  for (const char* file : {"no-friction-c13", "no-friction-c362", "no-friction-c484"}) {
    const Answer answer = answer_of(file);
    EXPECT_EQ(answer.verdict, Verdict::hunts) << file;
    EXPECT_FALSE(answer.rest) << file;
  }
}

/// Dry friction of the motor and integral action, and a load that slides on: three pauses by one
/// ratio, of some hundredths of a second. From there simulate() swings by ±0.001568 rad to 300 s.
TEST(Ends, PausesShorterThanASwingAreNoCreeping) {
  const Answer answer = answer_of("pauses-shorter-than-a-swing");
  EXPECT_EQ(answer.verdict, Verdict::hunts);
  EXPECT_FALSE(answer.rest);
  const auto is_that_swing = [](const Cycle& cycle) {
    return cycle.stability == Stability::stable && std::abs(cycle.amplitude - 0.001568) < 1e-6;
  };
  EXPECT_TRUE(std::any_of(answer.cycles.begin(), answer.cycles.end(), is_that_swing));
}

/// By statics: friction holds 0.1 N m of 18 N m/rad about the reference; at its limit of 2 N m the
/// motor holds a load that leans by 0.95 to 1.05 rad.
TEST(Ends, AnInvertedLoadRestsInThreePieces) {
  const Answer answer = answer_of("inverted-load");
  ASSERT_TRUE(answer.rest);
  EXPECT_NEAR(*answer.value(Quantity::static_error), 0.1 / 18.0, 1e-9);
  ASSERT_EQ(answer.rest->pieces.size(), 3U);
  EXPECT_NEAR(answer.rest->pieces[1].load.low, -1.05, 1e-9);
  EXPECT_NEAR(answer.rest->pieces[2].load.high, 1.05, 1e-9);
}

/// No step of a hundred of the drive's lengths makes it fall; the search tries a larger one, from
/// which the torque limit cannot hold it. Where it begins to fall is that of the motion itself.
TEST(Ends, AWeightThatStandsFallsAfterLargeSteps) {
  const Drive drive = read_drive(data / "weight-falls.toml");
  const Answer answer = analyse(drive);
  const auto falls = [](const Threshold& one) { return one.end == "running away"; };
  const auto threshold = std::find_if(answer.thresholds.begin(), answer.thresholds.end(), falls);
  ASSERT_NE(threshold, answer.thresholds.end());
  const auto place_after = [&](double step) {
    const Span span{.until = 8.0, .start = Start{.load_position = step}};
    return std::abs(simulate(drive, span).at(span.until).shafts.load_position);
  };
  EXPECT_GT(place_after(1.02 * threshold->from), 100.0);
  EXPECT_LT(place_after(0.98 * threshold->below), 1.0);
}

/// Followed on, the start that takes longest rests from 250 s on, to within its half step of the
/// encoder at 407 s (simulate, to 2000 s).
TEST(Ends, ATransientOfMinutesIsNoHunting) {
  const Answer answer = answer_of("rests-after-minutes");
  EXPECT_EQ(answer.verdict, Verdict::comes_to_rest);
  ASSERT_TRUE(answer.rest->time);
  EXPECT_GT(answer.rest->time->longest, 200.0);
  EXPECT_LT(answer.rest->time->longest, 800.0);
  EXPECT_EQ(answer.value(Quantity::time_to_rest), answer.rest->time->longest);
}

/// Each reversal leaves 0.65 to 0.75 of the swing, as the clock's ticks fall (simulate, to 4000 s).
TEST(Ends, SwingsWhoseRatiosScatterVanish) {
  const Answer answer = answer_of("swings-shrink-by-clocked-ratios");
  EXPECT_EQ(answer.verdict, Verdict::comes_to_rest);
  EXPECT_EQ(answer.search->count("rest"), answer.search->starts.size());
}

/// From four large starts it decays with its faces together to a rest without friction that any
/// disturbance leaves; an independent simulator hunts from there.
TEST(Ends, WhatSmallDisturbancesLeaveIsNoRest) {
  const Answer answer = answer_of("decays-to-a-rest-that-is-left");
  EXPECT_EQ(answer.verdict, Verdict::hunts);
  EXPECT_TRUE(answer.rests_engaged);
  EXPECT_FALSE(answer.rest);
  EXPECT_EQ(answer.search->count("cycle"), answer.search->starts.size());
}

/// The motor stops 1e-20 rad beside the reference. The load hangs at the back of the gap, by its
/// weight of 0.00668 N m against its friction of 0.00603 N m.
TEST(Ends, RoundingIsNotIntegrated) {
  const Answer answer = answer_of("rounding-would-be-integrated");
  EXPECT_EQ(answer.search->count("undecided"), 0U);
  ASSERT_FALSE(answer.rest->pieces.empty());
  EXPECT_EQ(answer.rest->pieces[0].kind, RestKind::no_limit);
  EXPECT_NEAR(answer.rest->load.low, -0.0010525, 1e-12);
  ASSERT_TRUE(answer.rest->time);
  EXPECT_LT(answer.rest->time->longest, 10.0);
}

/// Gains ten times too high. From large starts swings grow at the torque limit, up to ±5.13 rad at
/// 0.546 Hz, as an independent simulator and `simulate` have it.
TEST(Ends, SwingsThatGrowAtTheLimitEndWhereViscousFrictionBrakesThem) {
  const Answer answer = answer_of("swings-grow-at-the-limit");
  EXPECT_EQ(answer.search->count("diverges"), 0U);
  const bool is_listed =
      std::any_of(answer.cycles.begin(), answer.cycles.end(),
                  [](const Cycle& cycle) { return std::abs(cycle.amplitude - 5.13) < 0.02; }) ||
      std::any_of(answer.irregular.begin(), answer.irregular.end(),
                  [](const auto& motion) { return std::abs(motion.amplitude - 5.13) < 0.02; });
  EXPECT_TRUE(is_listed);
}

/// The first start is watched for five periods of 3.19 s and more; the others join it.
TEST(Ends, SampledStartsUnderASineJoinAMotionThatIsKnown) {
  const Answer answer = answer_of("sampled-under-a-sine");
  EXPECT_EQ(answer.verdict, Verdict::forced);
  ASSERT_EQ(answer.irregular.size(), 1U);
  EXPECT_EQ(answer.irregular[0].starts, answer.search->starts.size());
  EXPECT_NEAR(answer.irregular[0].amplitude, 0.02104, 2e-5);
  double watched = 0.0;
  for (const StartOutcome& start : answer.search->starts) watched += start.watched;
  EXPECT_LT(watched / static_cast<double>(answer.search->starts.size()), 10.0);
}

TEST(Ends, OneUndecidedStartOfManyIsNotTheVerdict) {
  for (const char* file : {"one-start-undecided-b59", "one-start-undecided-c16"}) {
    EXPECT_EQ(answer_of(file).verdict, Verdict::comes_to_rest) << file;
  }
}

/// The largest torque of the error is 1.2e-4 N m, and the motor holds 3e-3 N m.
TEST(Ends, ShaftsThatStandUnderASineAreAtRest) {
  const Answer answer = answer_of("stands-under-a-sine");
  EXPECT_EQ(answer.verdict, Verdict::comes_to_rest);
  EXPECT_EQ(answer.search->count("rest"), answer.search->starts.size());
}

/// Starts within half a step of the middle are read as 0, and the integral of the sine goes to and
/// fro: they stand. All others join one motion.
TEST(Ends, StartsUnderASineStandOrJoinOneMotion) {
  const Answer answer = answer_of("stands-or-hunts-under-a-sine");
  EXPECT_EQ(answer.verdict, Verdict::forced);
  EXPECT_EQ(answer.search->count("undecided"), 0U);
  EXPECT_EQ(answer.search->count("rest"), 18U);
  EXPECT_EQ(answer.irregular.size(), 1U);
}

/// All starts near the ramp join one motion, of one size. From far away the integral winds up, and
/// swings grow without end (simulate: by 100 rad each, to 8000 s).
TEST(Ends, OnARampOneMotionIsListedOnce) {
  for (const auto& [file, amplitude] :
       {std::pair("ramp-with-encoder-d29", 0.0024), std::pair("ramp-with-encoder-d32", 0.00524)}) {
    const Answer answer = answer_of(file);
    ASSERT_EQ(answer.irregular.size(), 1U) << file;
    EXPECT_NEAR(answer.irregular[0].amplitude, amplitude, 0.01 * amplitude) << file;
    EXPECT_GT(answer.search->count("diverges"), 0U) << file;
    EXPECT_EQ(answer.search->count("undecided"), 0U) << file;
  }
}

}  // namespace
}  // namespace gearlash::ends_test
