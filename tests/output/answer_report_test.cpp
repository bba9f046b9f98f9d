// The one report of an answer: its headline in every case.
#include "output/answer_report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "gearlash/output.hpp"
#include "output/answer_parts.hpp"

namespace gearlash::answer_report_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

AnswerReport report_of(Verdict verdict) {
  AnswerReport report;
  report.drive.gearbox.backlash = 0.01;
  report.answer.verdict = verdict;
  report.answer.search = SearchRecord{.watch_time = 10.0, .starts = {{.end = "rest"}}};
  return report;
}

AnswerReport report_of(Verdict verdict, const Cycle& cycle) {
  AnswerReport report = report_of(verdict);
  report.answer.cycles = {cycle};
  return report;
}

constexpr Cycle swing{.amplitude = 0.02, .motor_amplitude = 0.03, .period = 0.5};
constexpr Cycle ticking{.amplitude = 0.0, .motor_amplitude = 0.004, .error = 0.01, .period = 0.5};

TEST(Headline, AnAnswerPrintsItself) {
  Answer answer;
  answer.verdict = Verdict::hunts;
  answer.cycles = {swing};
  std::ostringstream stream;
  stream << answer;
  EXPECT_EQ(stream.str(), "hunts: ±0.02 rad at 2 Hz");
  EXPECT_THAT(to_text(Drive{}, answer), testing::StartsWith(stream.str() + "\n"));
}

TEST(Headline, GivesAmplitudeAndFrequency) {
  EXPECT_EQ(headline(report_of(Verdict::hunts, swing)),
            "hunts: ±0.02 rad at 2 Hz (found from 1 start)");
  AnswerReport normalized = report_of(Verdict::hunts, swing);
  normalized.drive.servo.emplace();
  EXPECT_EQ(headline(normalized), "hunts: ±0.02 rad, period 0.5 / ω_n (found from 1 start)");
}

TEST(Headline, SaysWhereTheMotorAloneSwings) {
  EXPECT_EQ(
      headline(report_of(Verdict::hunts, ticking)),
      "hunts: the motor within the gap, ±0.004 rad at 2 Hz, while the load stands, up to 0.01 rad "
      "off (found from 1 start)");
}

/// Its proof needs motion off the torque limit, whether the swing has a ceiling or not.
TEST(CeilingText, TheMeanMeshTorqueHoldsBelowALimit) {
  AnswerReport report = report_of(Verdict::hunts, swing);
  report.answer.ceiling = {.reason = "too large", .is_below_limit = true, .mesh_torque = 2.0};
  EXPECT_THAT(ceiling_text(report), HasSubstr("mean mesh torque of every motion is within ±2 N m"));
  EXPECT_THAT(ceiling_text(report), HasSubstr("stays\noff its limits (proved)"));
  report.answer.ceiling->is_below_limit = false;
  EXPECT_THAT(ceiling_text(report), Not(HasSubstr("limit")));
  report.answer.ceiling->mesh_torque.reset();
  EXPECT_THAT(ceiling_text(report), Not(HasSubstr("mesh")));
}

/// They are of the motion about the final course of the signals.
TEST(CeilingText, SafeStartsAreThoseAfterSignalsThatEnd) {
  AnswerReport report = report_of(Verdict::hunts, swing);
  report.answer.ceiling = {
      .load = 0.1, .motor = 0.1, .is_below_limit = true, .safe_starts = SafeStarts{0.2, 0.3}};
  EXPECT_THAT(ceiling_text(report), HasSubstr("\nStarts displaced"));
  report.drive.reference = TableSignal{.times = {0.0, 1.0}, .values = {0.0, 5.0}};
  EXPECT_THAT(ceiling_text(report), HasSubstr("\nOnce the signals have ended, starts displaced"));
}

TEST(Headline, OfForcedMotionIsNoHunting) {
  EXPECT_THAT(headline(report_of(Verdict::forced, swing)), Not(HasSubstr("hunts")));
}

TEST(Headline, NeedsNoCycle) {
  EXPECT_EQ(headline(report_of(Verdict::comes_to_rest)), "comes to rest (found from 1 start)");
  AnswerReport almost = report_of(Verdict::comes_to_rest);
  almost.answer.search->starts.push_back({.end = "undecided"});
  EXPECT_EQ(headline(almost), "comes to rest; 1 of 2 starts undecided (found from 2 starts)");
  EXPECT_EQ(headline(report_of(Verdict::runs_away)), "runs away (found from 1 start)");
  EXPECT_EQ(headline(report_of(Verdict::undecided)), "undecided");
  AnswerReport irregular = report_of(Verdict::hunts_irregularly);
  irregular.answer.irregular = {{.amplitude = 0.02}};
  EXPECT_EQ(headline(irregular), "hunts irregularly: up to ±0.02 rad (found from 1 start)");
}

/// As a motor that ticks in its gap, beside hunting against the torque limit after large steps.
TEST(Headline, NamesAMuchLargerMotionBesides) {
  AnswerReport report = report_of(Verdict::hunts_irregularly);
  report.answer.irregular = {{.amplitude = 0.02, .starts = 20}, {.amplitude = 2.0, .starts = 4}};
  report.answer.search = SearchRecord{};
  report.answer.search->starts.resize(24);
  EXPECT_EQ(headline(report),
            "hunts irregularly: up to ±0.02 rad; 4 of 24 starts hunt by ±2 rad (found from 24 "
            "starts)");
  report.answer.irregular[1].amplitude = 0.025;
  EXPECT_EQ(headline(report), "hunts irregularly: up to ±0.02 rad (found from 24 starts)");
}

/// A start that ran away or stayed undecided is not in the small print alone.
TEST(Headline, CountsTheStartsThatAreNoPartOfIt) {
  AnswerReport report = report_of(Verdict::hunts_irregularly);
  report.answer.irregular = {{.amplitude = 0.02}};
  std::vector<StartOutcome>& starts = report.answer.search->starts;
  starts.assign(17, {.end = "irregular"});
  starts.insert(starts.end(), 7, {.end = "undecided"});
  EXPECT_EQ(headline(report),
            "hunts irregularly: up to ±0.02 rad; 7 of 24 starts undecided (found from 24 starts)");
  starts.insert(starts.end(), 2, {.end = "diverges"});
  EXPECT_EQ(headline(report),
            "hunts irregularly: up to ±0.02 rad; runs away from 2 of 26 starts; 7 of 26 starts "
            "undecided (found from 26 starts)");
  report.answer.search->is_complete = false;
  EXPECT_THAT(headline(report), HasSubstr("; stopped early; "));
}

TEST(Headline, OfARunawayBeginsWithWhatSmallStepsLeadTo) {
  AnswerReport report = report_of(Verdict::runs_away_if_disturbed);
  Answer& answer = report.answer;
  answer.rest = Rest{.error = {-0.01, 0.02}};
  answer.search->starts.assign(3, {.load_position = 0.1, .end = "rest"});
  answer.search->starts.insert(answer.search->starts.end(), 2,
                               {.load_position = 1.0, .end = "diverges"});
  const std::string rests = "comes to rest, up to 0.02 rad off; ";
  EXPECT_EQ(headline(report), rests + "runs away from 2 of 5 starts (found from 5 starts)");
  answer.thresholds = {{.end = "running away", .direction = 1.0, .below = 0.5, .from = 1.0}};
  EXPECT_EQ(headline(report),
            rests + "runs away after steps from 1 rad forward on (found from 5 starts)");
  answer.notes = {{"wind-up", "It winds up."}};
  EXPECT_EQ(
      headline(report),
      rests + "winds up and runs away after steps from 1 rad forward on (found from 5 starts)");
  answer.search->starts.assign(5, {.load_position = 0.1, .end = "undecided"});
  answer.search->starts[0].end = "diverges";
  answer.thresholds.clear();
  answer.notes.clear();
  EXPECT_EQ(headline(report),
            "runs away from 1 of 5 starts; 4 of 5 starts undecided (found from 5 starts)");
}

/// A drive that rests from small displacements and hunts after larger ones, and the reverse.
TEST(Headline, GoesFromSmallDisplacementsToLargeOnes) {
  AnswerReport report = report_of(Verdict::hunts_if_disturbed, swing);
  Answer& answer = report.answer;
  answer.rest = Rest{.error = {-0.01, 0.01}};
  answer.thresholds = {{.end = "hunting", .below = 0.4, .from = 0.5}};
  answer.search->starts = {{.load_position = 0.1, .end = "rest"},
                           {.load_position = 1.0, .end = "cycle", .which = 0}};
  EXPECT_EQ(headline(report),
            "comes to rest, up to 0.01 rad off; hunts, ±0.02 rad at 2 Hz, after steps from 0.5 rad "
            "on (found from 2 starts)");
  std::swap(answer.search->starts[0].load_position, answer.search->starts[1].load_position);
  EXPECT_EQ(headline(report),
            "hunts: ±0.02 rad at 2 Hz; comes to rest from 1 of 2 starts (found from 2 starts)");
}

/// The word is for a cause that a run without the encoder has shown.
TEST(Headline, NamesQuantizationWhereTheAnswerDoes) {
  Cycle small = swing;
  small.encoder_steps = 2.0;
  AnswerReport report = report_of(Verdict::hunts, small);
  for (const std::optional<bool> is_it : {std::optional<bool>(), std::optional(false)}) {
    report.answer.is_quantization = is_it;
    EXPECT_EQ(headline(report), "hunts: ±0.02 rad at 2 Hz, 2 encoder steps (found from 1 start)");
  }
  report.answer.is_quantization = true;
  EXPECT_EQ(headline(report),
            "hunts: ±0.02 rad at 2 Hz, 2 encoder steps: quantization (found from 1 start)");
}

TEST(AnswerText, ListsUnstableCyclesInALineEach) {
  Cycle unstable = swing;
  unstable.stability = Stability::unstable;
  unstable.multiplier = 1.5;
  AnswerReport report = report_of(Verdict::comes_to_rest, unstable);
  EXPECT_THAT(answer_text(report, Detail::all),
              HasSubstr("\nUnstable limit cycles, on which no motion stays\n  symmetric"));
}

}  // namespace
}  // namespace gearlash::answer_report_test
