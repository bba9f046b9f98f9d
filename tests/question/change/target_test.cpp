// What meets a target: verdicts and quantities of answers that are made up.
#include "question/change/target.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace gearlash::target_test {
namespace {

Target within(Quantity quantity, const Bounds& permitted) {
  return Target{}.require(quantity, permitted);
}

Answer answer_with(Verdict verdict) {
  Answer answer{.verdict = verdict};
  answer.search = SearchRecord{};
  return answer;
}

/// With a stable cycle of this amplitude, to which a start led.
Answer hunting(Verdict verdict, double amplitude) {
  Answer answer = answer_with(verdict);
  answer.cycles.push_back({.stability = Stability::stable, .amplitude = amplitude, .starts = 1});
  answer.search->starts.push_back({.end = "cycle", .which = 0});
  return answer;
}

TEST(Target, PermitsVerdicts) {
  const Target no_hunting{.no_hunting = true};
  const Target no_runaway{.no_runaway = true};
  struct Row {
    Verdict verdict;
    bool without_hunting;
    bool at_rest;
    bool without_runaway;
  };
  for (const Row& row :
       {Row{Verdict::comes_to_rest, true, true, true}, Row{Verdict::cannot_hunt, true, true, true},
        Row{Verdict::hunts, false, false, true},
        Row{Verdict::hunts_irregularly, false, false, true},
        Row{Verdict::forced, false, false, true},
        Row{Verdict::hunts_if_disturbed, true, false, true},
        Row{Verdict::runs_away, false, false, false},
        Row{Verdict::runs_away_if_disturbed, true, true, false},
        Row{Verdict::undecided, false, false, false}}) {
    const Answer answer = answer_with(row.verdict);
    EXPECT_EQ(is_met(no_hunting, answer), row.without_hunting) << name_of(row.verdict);
    EXPECT_EQ(is_met(always_at_rest(), answer), row.at_rest) << name_of(row.verdict);
    EXPECT_EQ(is_met(no_runaway, answer), row.without_runaway) << name_of(row.verdict);
    EXPECT_EQ(is_known(no_hunting, answer), row.verdict != Verdict::undecided);
  }
}

/// The worse of two ends gives the verdict.
TEST(Target, SeesHuntingBesideRunningAway) {
  const Answer answer = hunting(Verdict::runs_away_if_disturbed, 0.1);
  EXPECT_TRUE(is_met(Target{.no_hunting = true}, answer));
  EXPECT_FALSE(is_met(always_at_rest(), answer));
  Answer beside = hunting(Verdict::hunts, 0.1);
  beside.search->starts.push_back({.end = "diverges"});
  EXPECT_FALSE(is_met(Target{.no_runaway = true}, beside));
}

/// An upper limit is for the largest motion, of whatever kind.
TEST(Target, LimitsIrregularMotionBesideACycle) {
  Answer answer = hunting(Verdict::hunts, 0.1);
  answer.irregular.push_back({.amplitude = 0.2, .motor_amplitude = 0.4});
  const auto up_to = [](Quantity quantity, double most) {
    return Target{}.require(quantity, {0.0, most});
  };
  EXPECT_FALSE(is_met(up_to(Quantity::amplitude, 0.15), answer));
  EXPECT_TRUE(is_met(up_to(Quantity::amplitude, 0.2), answer));
  EXPECT_NEAR(excess(up_to(Quantity::amplitude, 0.1), answer), std::log(2.0), 1e-15);
  EXPECT_FALSE(is_met(up_to(Quantity::motor_amplitude, 0.3), answer));
  EXPECT_TRUE(is_met(up_to(Quantity::motor_amplitude, 0.4), answer));
  answer.cycles.push_back({.stability = Stability::unstable, .amplitude = 1.0});
  EXPECT_TRUE(is_met(up_to(Quantity::amplitude, 0.2), answer));
}

TEST(Target, LimitsAnyQuantity) {
  const Answer answer = hunting(Verdict::hunts, 0.1);
  EXPECT_TRUE(is_met(within(Quantity::amplitude, {0.0, 0.1}), answer));
  EXPECT_FALSE(is_met(within(Quantity::amplitude, {0.0, 0.09}), answer));
  EXPECT_NEAR(excess(within(Quantity::amplitude, {0.0, 0.05}), answer), std::log(2.0), 1e-15);
  EXPECT_NEAR(excess(within(Quantity::amplitude, {0.4, 1.0}), answer), std::log(4.0), 1e-15);
  // A ceiling that is not known keeps no limit.
  EXPECT_FALSE(is_met(within(Quantity::ceiling, {0.0, 1.0}), answer));
  EXPECT_EQ(excess(within(Quantity::ceiling, {0.0, 1.0}), answer), Target::infinity);
  Answer bounded = answer;
  bounded.ceiling = Ceiling{.load = 0.5};
  EXPECT_TRUE(is_met(within(Quantity::ceiling, {0.0, 1.0}), bounded));
  // A drive at rest has no frequency, and its amplitude is 0.
  const Answer rest = answer_with(Verdict::comes_to_rest);
  EXPECT_TRUE(is_met(within(Quantity::frequency, {5.0, 6.0}), rest));
  EXPECT_FALSE(is_met(within(Quantity::amplitude, {0.1, 1.0}), rest));
}

TEST(Target, NarrowsALimitThatIsGivenTwice) {
  Target target;
  target.require(Quantity::amplitude, {0.0, 2.0}).require(Quantity::amplitude, {1.0, 3.0});
  EXPECT_EQ(target.permitted(Quantity::amplitude), (Bounds{1.0, 2.0}));
  EXPECT_EQ(target.limits.size(), 1U);
}

TEST(Target, AsksForWhatItsLimitsAreOf) {
  const auto of = [&](Quantity quantity) {
    return wanted_for(Target{}.require(quantity, {0.0, 1.0}));
  };
  EXPECT_FALSE(of(Quantity::static_error).borders);
  EXPECT_TRUE(of(Quantity::amplitude).borders);
  EXPECT_TRUE(of(Quantity::ceiling).ceiling);
  EXPECT_TRUE(of(Quantity::phase_margin).loop);
  EXPECT_TRUE(of(Quantity::settling_time).step);
  const Wanted rest = wanted_for(always_at_rest());
  EXPECT_FALSE(rest.borders || rest.ceiling || rest.loop || rest.step);
}

TEST(Target, IsNotKnownWhereAStepWasCutShort) {
  const Target target = within(Quantity::overshoot, {0.0, 0.1});
  Answer answer = answer_with(Verdict::comes_to_rest);
  answer.step = StepResponse{.overshoot = 0.05, .is_whole = true};
  EXPECT_TRUE(is_met(target, answer));
  answer.step->overshoot = 0.15;
  EXPECT_TRUE(is_known(target, answer) && !is_met(target, answer));
  answer.step = StepResponse{};
  EXPECT_FALSE(is_known(target, answer));
  EXPECT_FALSE(is_met(target, answer));
}

}  // namespace
}  // namespace gearlash::target_test
