// The one answer: what is proved of a drive covers its data as written.
#include "gearlash/analyse.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "analysis/analyse.hpp"
#include "analysis/pd_drive.hpp"
#include "model/reduced_drive.hpp"

namespace gearlash {
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

TEST(Analyse, AWindingWithInductanceHasNoClosedFormButACeiling) {
  Drive drive = almost_undamped_motor(0.5);
  drive.motor.kind = ArmatureControl{.torque_constant = 0.1, .resistance = 1.0};
  EXPECT_TRUE(closed_form_servo(drive));
  std::get<ArmatureControl>(drive.motor.kind).inductance = 1e-4;
  EXPECT_FALSE(closed_form_servo(drive));
  const Ceiling ceiling = *analyse(drive, {.ceiling = true}).ceiling;
  EXPECT_TRUE(ceiling.load) << ceiling.reason;
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
  const Answer part = analyse_until(
      drive, {.borders = false},
      [](const drive::AttractorSearch& search) { return search.outcomes.size() == 3; });
  ASSERT_GT(whole.search->starts.size(), 3U);
  EXPECT_EQ(part.search->starts.size(), 3U);
  EXPECT_EQ(part.search->starts[2].end, whole.search->starts[2].end);
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
}

}  // namespace
}  // namespace gearlash
