// The one answer: what is proved of a drive covers its data as written.
#include "gearlash/analyse.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "controllers.hpp"
#include "model/reduced_drive.hpp"
#include "question/analyse.hpp"
#include "question/contradictions.hpp"
#include "question/pd_drive.hpp"

namespace gearlash::analyse_test {
namespace {

/// Speed fed back from the motor takes away all but `left` of its friction, 1 N m s/rad at the
/// load.
Drive almost_undamped_motor(double left) {
  Drive drive;
  drive.motor.inertia = 1e-3;
  drive.motor.friction.viscous = 1e-2;
  drive.gearbox = {.ratio = 10.0, .backlash = 0.01};
  drive.load = {.inertia = 0.2, .friction = {.viscous = 0.5}};
  drive.sensor.position = SensorPlace::both;
  drive.controller.law =
      PID{.terms = PIDTerms::PD, .proportional = 2.0, .derivative = -0.1 * (1.0 - left)};
  return drive;
}

TEST(Analyse, NotesWhatASheetSaysAndTheModelLacks) {
  Drive drive = almost_undamped_motor(0.5);
  EXPECT_TRUE(analyse(drive).notes.empty());
  drive.gearbox.efficiency = 0.72;
  const Answer answer = analyse(drive);
  ASSERT_EQ(answer.notes.size(), 1U);
  EXPECT_EQ(answer.notes[0].code, "efficiency");
  EXPECT_EQ(answer.notes[0].text.substr(0, 42), "gearbox.efficiency = 0.72 is not modelled:");
}

TEST(EdgeAnalyse, BoundsCoverTheDataWhereTheFrictionIsADifference) {
  const Drive drive = almost_undamped_motor(1e-7);
  const Answer answer = analyse(drive);
  ASSERT_EQ(answer.engine, Engine::closed_form);
  ASSERT_TRUE(answer.bounds);
  for (const double change : {1.0 - 0x1p-51, 1.0 + 0x1p-51}) {
    Drive other = drive;
    other.motor.friction.viscous *= change;
    const double growth = analyse(other).growth_at_rest.value();
    EXPECT_NE(growth, answer.growth_at_rest.value());
    EXPECT_LE(answer.bounds->growth_at_rest.low, growth);
    EXPECT_GE(answer.bounds->growth_at_rest.high, growth);
  }
}

/// A verdict on all starts needs all of them decided.
TEST(Analyse, WithoutBordersTheVerdictIsTheSame) {
  Drive drive = pd_drive();
  std::get<PID>(drive.controller.law).proportional = 4.0;
  const Answer with = analyse(drive);
  const Answer without = analyse(drive, {.borders = false});
  EXPECT_EQ(with.verdict, Verdict::hunts_if_disturbed);
  EXPECT_EQ(without.verdict, with.verdict);
  EXPECT_EQ(without.value(Quantity::amplitude), with.value(Quantity::amplitude));
  ASSERT_EQ(with.cycles.size(), 2U);
  EXPECT_EQ(with.cycles[1].stability, Stability::unstable);
  EXPECT_FALSE(with.thresholds.empty());
  EXPECT_EQ(without.cycles.size(), 1U);
  EXPECT_TRUE(without.thresholds.empty());
}

TEST(Analyse, EndsWithTheStartAfterWhichNoMoreAreWanted) {
  const Drive drive = pd_drive();
  const Answer whole = analyse(drive, {.borders = false});
  const Answer part =
      analyse_in_full(
          drive, {.borders = false}, no_progress(),
          {.is_enough =
               [](const drive::AttractorSearch& search) { return search.outcomes.size() == 3; }})
          .answer;
  ASSERT_GT(whole.search->starts.size(), 3U);
  EXPECT_EQ(part.search->starts.size(), 3U);
  EXPECT_EQ(part.search->starts[2].end, whole.search->starts[2].end);
}

TEST(Analyse, FollowedMotionOfAnotherKindServesWhereItSuffices) {
  const Wanted wanted{.proofs = false, .borders = false};
  Drive stiff = pd_drive();
  std::get<PID>(stiff.controller.law).proportional = 4.0;
  const Analysis hunting = analyse_in_full(stiff, wanted);
  ASSERT_TRUE(hunts(hunting.answer.verdict));
  const Drive still = pd_drive();
  const Analysis afresh = analyse_in_full(still, wanted, no_progress(), {.near = &hunting});
  EXPECT_FALSE(afresh.is_followed);
  ASSERT_TRUE(is_at_rest(afresh.answer.verdict));
  const auto rests = [](const Answer& answer) { return is_at_rest(answer.verdict); };
  const Analysis followed =
      analyse_in_full(still, wanted, no_progress(), {.near = &hunting, .suffices = rests});
  EXPECT_TRUE(followed.is_followed);
  EXPECT_EQ(followed.answer.verdict, afresh.answer.verdict);
  EXPECT_LT(followed.answer.search->starts.size(), afresh.answer.search->starts.size());
  const auto never = [](const Answer&) { return false; };
  EXPECT_FALSE(analyse_in_full(still, wanted, no_progress(), {.near = &hunting, .suffices = never})
                   .is_followed);
}

/// Its faces come to bounce without end before it sticks, and a state that stands recurs at once: a
/// round of such an orbit was divided for ever.
TEST(EdgeAnalyse, ElasticFacesUnderACascadeHaveAnAnswer) {
  Drive drive;
  drive.motor = {.kind = TorqueControl{},
                 .inertia = 0.0024359754752367735,
                 .friction = {.viscous = 0.0005094251432241972,
                              .coulomb = 0.19082105876090485,
                              .breakaway = 0.25425245638095456},
                 .limit = 92.75063213279736};
  drive.gearbox = {.ratio = 8.0, .backlash = 0.00025609499730627213};
  drive.load = {.inertia = 0.0805183916171659,
                .friction = {.viscous = 0.03448718561201093, .coulomb = 4.00617755732326}};
  drive.contact = RigidContact{.restitution = 1.0};
  drive.sensor.position = SensorPlace::load;
  drive.controller.law = CascadeController{.position = 52.118561893211684,
                                           .speed = 0.9482285065205898,
                                           .speed_integral = 73.20463671925833,
                                           .tracking_time = 0.007281293848360734};
  drive.controller.shaft = GainShaft::motor;
  const Answer answer =
      analyse_in_full(  // the ninth start led there
          drive, {.proofs = false, .borders = false}, no_progress(),
          {.is_enough =
               [](const drive::AttractorSearch& search) { return search.outcomes.size() == 9; }})
          .answer;
  EXPECT_EQ(answer.search->count("undecided"), 0U);
}

/// It sticks for 26 s of each half-period, in which the filter of its derivative comes to rest to
/// the last bit: the orbit that Newton's method closes must have it so.
TEST(Analyse, NearFollowsACycleThatSticksForLong) {
  const auto drive_with = [](double derivative) {
    Drive drive = pd_drive();
    drive.motor.inertia = 2e-6;
    drive.controller.law = PID{.terms = PIDTerms::PID,
                               .proportional = 6.07753125,
                               .integral = 20.0,
                               .derivative = derivative,
                               .filter = 1e-3};
    return drive;
  };
  const Wanted wanted{.proofs = false, .borders = false};
  for (const double power : {5.0, 9.0, 11.0, 12.0, 13.0}) {
    const double derivative = 0.02 * std::pow(1.05, power);
    const Analysis known = analyse_in_full(drive_with(derivative), wanted);
    const Analysis near =
        analyse_in_full(drive_with(derivative / 1.014), wanted, no_progress(), {.near = &known});
    EXPECT_TRUE(near.is_followed) << derivative;
    EXPECT_EQ(near.answer.cycles.at(0).kind, CycleKind::symmetric) << derivative;
  }
}

TEST(Analyse, IsNoVerdictOnStartsThatAreUndecided) {
  const drive::ReducedDrive drive = reduce(almost_undamped_motor(0.5));
  const auto verdict = [&](std::vector<drive::MotionEnd> ends, bool is_complete = true) {
    drive::AttractorSearch search;
    search.outcomes.resize(ends.size());
    for (std::size_t i = 0; i < ends.size(); ++i) search.outcomes[i].end = ends[i];
    search.is_complete = is_complete;
    return answer_of(search, drive).verdict;
  };
  using enum drive::MotionEnd;
  EXPECT_EQ(verdict({diverges, diverges}), Verdict::runs_away);
  EXPECT_EQ(verdict({diverges, undecided}), Verdict::runs_away_if_disturbed);
  EXPECT_EQ(verdict({diverges}, false), Verdict::runs_away_if_disturbed);
  EXPECT_EQ(verdict({diverges, rest}), Verdict::runs_away_if_disturbed);
  EXPECT_EQ(verdict({rest, rest}), Verdict::comes_to_rest);
  EXPECT_EQ(verdict({rest, undecided}), Verdict::undecided);
  EXPECT_EQ(verdict({rest}, false), Verdict::undecided);
  std::vector<drive::MotionEnd> many(18, rest);
  many.resize(20, undecided);
  EXPECT_EQ(verdict(many), Verdict::comes_to_rest);
  EXPECT_EQ(verdict(many, false), Verdict::undecided);
  many.pop_back();
  many.front() = undecided;  // 2 of 19
  EXPECT_EQ(verdict(many), Verdict::undecided);
}

/// One start for each of these times, at rest at the reference.
drive::AttractorSearch search_with_times(const std::vector<double>& times) {
  drive::AttractorSearch search;
  for (const double time : times) {
    drive::Outcome& outcome = search.outcomes.emplace_back();
    outcome.end = drive::MotionEnd::rest;
    outcome.time_to_rest = time;
  }
  search.rest = drive::RestFound{};
  return search;
}

TEST(Analyse, TakesTheMeanOfTheTwoMiddleTimesToRest) {
  const drive::ReducedDrive drive = reduce(almost_undamped_motor(0.5));
  const auto median = [&](const std::vector<double>& times) {
    return answer_of(search_with_times(times), drive).rest->time->median;
  };
  EXPECT_EQ(median({8.0, 1.0, 2.0, 4.0}), 3.0);
  EXPECT_EQ(median({8.0, 1.0, 2.0}), 2.0);
  EXPECT_EQ(median({8.0}), 8.0);
}

/// By statics it rests at the reference, and leaning by ±0.1 rad at its limit of 2 N m, less
/// `load_torque`/20 rad.
drive::ReducedDrive inverted_load(double load_torque) {
  drive::ReducedDrive drive;
  drive.motor = {.inertia = 1.0, .friction = {.viscous = 1.0}};
  drive.load = {.inertia = 1.0, .friction = {.viscous = 1.0}};
  drive.backlash = 0.02;
  drive.controller = at_load(PID{.terms = PIDTerms::PD, .proportional = 30.0, .derivative = 1.0});
  drive.torque_limit = 2.0;
  drive.gravity.stiffness = -20.0;
  drive.load_torque = load_torque;
  return drive;
}

Answer answer_of_rest_at(const RestPlace& place, const drive::ReducedDrive& drive) {
  drive::AttractorSearch search = search_with_times({1.0});
  search.outcomes.front().rest = place;
  return answer_of(search, drive);
}

/// Without dry friction those equilibria count that starts approach.
TEST(Analyse, CountsMirrorImagesOfRestOnlyWhereTheDriveIsItsOwn) {
  const RestPlace place{.load = 0.1, .uncertainty = 1e-3};
  EXPECT_EQ(answer_of_rest_at(place, inverted_load(0.0)).rest->pieces.size(), 2U);
  const Answer pushed = answer_of_rest_at(place, inverted_load(0.001));
  ASSERT_EQ(pushed.rest->pieces.size(), 1U);
  EXPECT_EQ(pushed.rest->pieces[0].side, -1.0);
  EXPECT_NEAR(pushed.rest->pieces[0].load.high, 0.1 - 0.001 / 20.0, 1e-9);
  EXPECT_TRUE(contradictions(pushed).empty());
}

TEST(Analyse, KeepsTheEquilibriaThatNoStartApproaches) {
  const Answer answer =
      answer_of_rest_at({.load = 0.05, .uncertainty = 1e-3}, inverted_load(0.001));
  EXPECT_EQ(answer.rest->pieces.size(), 3U);
  EXPECT_EQ(contradictions(answer).size(), 1U);
}

}  // namespace
}  // namespace gearlash::analyse_test
