// What is told of describing functions: predicted, exact and the error between them.
#include "output/describe_report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "controllers.hpp"

namespace gearlash::describe_report_test {
namespace {

using testing::HasSubstr;
using testing::Not;

/// KT = 5: two cycles of a load held by friction.
drive::ReducedDrive type_one_servo() {
  drive::ReducedDrive drive;
  drive.motor = {0.25, {.viscous = 0.75}};
  drive.load = {0.75, {.viscous = 0.25}};
  drive.backlash = 2.0;
  drive.controller = at_load(PID{.proportional = 5.0});
  return drive;
}

DescribeReport report_of(const drive::ReducedDrive& drive) {
  Cycle cycle;
  cycle.amplitude = 2.0;
  cycle.motor_amplitude = 3.0;
  cycle.period = 4.0;
  DescribeReport report;
  report.analyses = drive::describing_analyses(drive);
  report.answer.verdict = Verdict::hunts;
  report.answer.cycles = {cycle};
  report.backlash = drive.backlash;
  set_errors(report.analyses, report.answer);
  return report;
}

TEST(DescribeReport, TextPutsTheErrorBelowWhatIsExact) {
  const std::string text = describe_text(report_of(type_one_servo()));
  EXPECT_THAT(text, testing::StartsWith("hunts: ±2 rad at 0.25 Hz\n\n"
                                        "Gap, load held by friction\n"));
  // 2.020632 − 1 of the load, 2π/1.591383 s.
  EXPECT_THAT(text, HasSubstr("predicted, stable    ±1.021 rad   ±2.021 rad  3.948 s"));
  EXPECT_THAT(text, HasSubstr("exact              ±2 rad       ±3 rad      4 s "));
  EXPECT_THAT(text, HasSubstr("error              −49 %        −32.6 %     −1.29 %"));
  EXPECT_THAT(text, HasSubstr("L(s) = 5/(s² + s)\n"));
  EXPECT_THAT(text, HasSubstr("Assumed: the motor drives all inertia"));
}

TEST(DescribeReport, APredictionWithoutAnExactCycleIsSaidToBeWrong) {
  DescribeReport report = report_of(type_one_servo());
  report.answer.cycles.clear();
  report.answer.verdict = Verdict::cannot_hunt;
  set_errors(report.analyses, report.answer);
  const std::string text = describe_text(report);
  EXPECT_THAT(text, testing::StartsWith("cannot hunt: "));
  EXPECT_THAT(text, HasSubstr("  exact              no stable cycle\n"));
  EXPECT_THAT(text, Not(HasSubstr("error")));
}

TEST(DescribeReport, WhatIsUndecidedIsNotSaidToBeWrong) {
  DescribeReport report = report_of(type_one_servo());
  report.answer.cycles.clear();
  report.answer.verdict = Verdict::undecided;
  set_errors(report.analyses, report.answer);
  EXPECT_THAT(describe_text(report), HasSubstr("  exact              undecided\n"));
}

TEST(DescribeReport, LeavesOutAPredictionTooSmallToBeSeen) {
  DescribeReport report = report_of(type_one_servo());
  report.backlash = 1e5;
  EXPECT_THAT(describe_text(report), HasSubstr("  no cycle predicted\n"));
}

TEST(EdgeDescribeReport, NormalisedTimesAreTold) {
  DescribeReport report = report_of(type_one_servo());
  report.drive.servo.emplace();
  EXPECT_THAT(describe_text(report), HasSubstr("3.948 / ω_n"));
  EXPECT_THAT(describe_text(report), HasSubstr("1.591 ω_n"));
  EXPECT_THAT(describe_text(report), Not(HasSubstr(" Hz")));
}

TEST(EdgeDescribeReport, WhatIsOutsideOfTheLoopHasNoCycle) {
  drive::ReducedDrive drive = type_one_servo();
  drive.controller = at_load(PID{});
  EXPECT_THAT(describe_text(report_of(drive)), HasSubstr("no cycle: nothing is fed back"));
}

}  // namespace
}  // namespace gearlash::describe_report_test
