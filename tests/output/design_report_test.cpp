// What a design reports beside the values that meet the target.
#include "output/design_report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

namespace gearlash::design_report_test {
namespace {

using testing::HasSubstr;
using testing::Not;

/// One value of the gap that meets the target, with the loop that is given.
DesignReport report_with(const std::optional<LinearLoop>& loop) {
  DesignReport report;
  report.target_text = "no-hunting";
  report.target.no_hunting = true;
  DesignedParameter parameter;
  parameter.values.parameter = "gearbox.backlash";
  parameter.values.present = 0.2;
  parameter.values.searched = {0.02, 2.0};
  parameter.values.kind = SearchKind::searched;
  parameter.values.intervals = {{0.02, 0.1}};
  parameter.values.grid = {0.02, 0.1, 0.2, 2.0};
  DriveWithValue one{.value = 0.1};
  one.answer.loop = loop;
  one.answer.verdict = Verdict::comes_to_rest;
  parameter.results = {one};
  report.design.parameters = {parameter};
  return report;
}

TEST(DesignReport, ShowsBandwidthInHertzAndPhaseMarginInDegrees) {
  const DesignReport report = report_with(LinearLoop{.is_stable = true,
                                                     .bandwidth = 12.5,
                                                     .phase_margin = std::numbers::pi / 4.0,
                                                     .crossover = 7.25});
  const std::string text = design_text(report);
  EXPECT_THAT(text, HasSubstr("settles  bandwidth  phase margin\n"));
  EXPECT_THAT(text, HasSubstr("12.5 Hz    45.0 deg\n"));
}

TEST(DesignReport, LeavesWhatThereIsNotBlank) {
  const DesignReport unstable = report_with(LinearLoop{});
  EXPECT_THAT(design_text(unstable), Not(HasSubstr(" Hz")));
  EXPECT_THAT(design_text(unstable), Not(HasSubstr(" deg\n")));
}

}  // namespace
}  // namespace gearlash::design_report_test
