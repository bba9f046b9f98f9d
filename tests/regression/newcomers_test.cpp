// What five new users found in their first hours (FINDINGS G of November 2026), on their own files:
// tests/input/data/newcomers.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>
#include <string>

#include "base/lists.hpp"
#include "gearlash/analyse.hpp"
#include "gearlash/input.hpp"
#include "gearlash/tolerance.hpp"
#include "output/answer_report.hpp"

namespace gearlash::newcomers_test {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

constexpr double arcmin = std::numbers::pi / 180.0 / 60.0;
constexpr double half_gap = 5.0 * arcmin;

const std::filesystem::path folder =
    std::filesystem::path(GEARLASH_SOURCE_DIRECTORY) / "tests/input/data/newcomers";

/// With a specification of 2 arcmin.
WrittenDrive written(const std::string& name, const std::vector<Setting>& settings = {}) {
  std::ostringstream text;
  text << std::ifstream(folder / (name + ".toml")).rdbuf();
  WrittenDrive drive = parse_drive(text.str(), name, folder, settings);
  drive.drive.specification.error = 2.0 * arcmin;
  return drive;
}

AnswerReport report_on(const WrittenDrive& drive) {
  const Answer answer = analyse(drive.drive, {.proofs = false,
                                              .ceiling = true,
                                              .loop = true,
                                              .step = true,
                                              .borders = false,
                                              .causes = true});
  return report_of(drive.drive, answer, {});
}

bool has_note(const Answer& answer, const std::string& code) {
  return any_of(answer.notes, [&](const Note& note) { return note.code == code; });
}

/// Point 1: the specification is missed, and by how much; a target on the amplitude alone hides it.
TEST(Newcomers, ASpecificationThatIsMissedIsNotMet) {
  const WrittenDrive drive = written("jt", {{"sensor.position", "motor"}});
  const AnswerReport report = report_on(drive);
  const double friction = (0.5 + 0.2) / 200.0;  // N m at the joint, N m/rad
  const double error = half_gap + friction;
  EXPECT_NEAR(report.answer.value(Quantity::error).value(), error, 1e-9);
  const SpecificationAnswer& judged = report.answer.specification.value();
  EXPECT_EQ(judged.small, Fulfilment::not_met);
  EXPECT_NEAR(judged.excess.value(), error - 2.0 * arcmin, 1e-9);
  EXPECT_EQ(judged.cause, Cause::dry_friction);
  EXPECT_THAT(answer_text(report), HasSubstr("not met; the load ends up to 17.03 arcmin off"));

  TolerancedDrive series{.nominal = drive.drive};
  series.varied = {{"load.coulomb", UniformAbout{0.2, 0.02}}};
  const ToleranceStudy study =
      study_tolerances(series, {.points = 8, .replicates = 2},
                       {.target = Target{}.require(Quantity::amplitude, {0.0, 2.0 * arcmin})});
  EXPECT_EQ(study.yield.value, 1.0);
  EXPECT_EQ(study.hidden_errors, 16U);
  EXPECT_NEAR(study.error.back().value->value, error, 0.02 / 200.0);
}

/// Point 2: whether the drive settles does not depend on where in the gap it stops.
TEST(Newcomers, SettlingIsNoCoinToss) {
  for (const char* gain : {"60 1/s", "63.8 1/s"}) {
    const WrittenDrive drive = written("nema23f", {{"controller.position", gain}});
    const Answer answer = analyse(drive.drive, {.step = true, .borders = false});
    EXPECT_EQ(answer.step->band, 2.0 * arcmin);
    EXPECT_FALSE(answer.step->settling_time) << gain;  // it stops within the gap
    EXPECT_GT(answer.step->final_error, answer.step->band) << gain;
  }
}

/// Point 4: what small disturbances lead to comes first; wind-up has its name, and its cure cures.
TEST(Newcomers, AHeadlineBeginsWithSmallDisturbancesAndNamesWindUp) {
  const WrittenDrive drive = written("nema23f");
  const AnswerReport report = report_on(drive);
  EXPECT_THAT(headline(report), StartsWith("comes to rest, up to 5 arcmin off; winds up"));
  EXPECT_THAT(answer_text(report), HasSubstr("controller.tracking_time = \"10 ms\""));
  const Answer cured = analyse(written("nema23f", {{"controller.tracking_time", "10 ms"}}).drive,
                               {.borders = false});
  EXPECT_EQ(cured.search->count("diverges"), 0U);
}

/// Point 5: a drive that drifts in its gap, and cycles of an encoder step in one line.
TEST(Newcomers, ADriveWithoutDryFrictionIsSaidToDriftInItsGap) {
  const AnswerReport report = report_on(written("nema23"));
  EXPECT_TRUE(has_note(report.answer, "drifts-in-gap"));
  EXPECT_FALSE(has_note(report_on(written("nema23f")).answer, "drifts-in-gap"));
  const std::string text = answer_text(report);
  const std::string after_headline = text.substr(text.find('\n') + 1);
  EXPECT_THAT(after_headline, StartsWith("\nNo dry friction is given"));
  EXPECT_NEAR(report.answer.value(Quantity::error).value(), half_gap, 0.001 * half_gap);
  EXPECT_EQ(report.answer.specification->small, Fulfilment::not_met);
  EXPECT_LE(std::count(text.begin(), text.end(), '\n'), 40) << text;
  EXPECT_THAT(text, HasSubstr("of few encoder steps"));
}

/// The arm that hangs in its gap: half a gap, the weight and dry friction over the gain, to a
/// count.
TEST(Newcomers, AnArmThatHangsInItsGapIsOffByItsWeightToo) {
  const AnswerReport report = report_on(written("moteus"));
  const double gain = 100.0 / (2.0 * std::numbers::pi) * 8.0 * 8.0;  // N m/rad at the load
  const double error = 1.5 * 60.0 * arcmin + (8.0 + 0.03 * 8.0) / gain;
  const double count = 2.0 * std::numbers::pi / 8192.0 / 8.0;
  EXPECT_NEAR(report.answer.value(Quantity::error).value(), error, count);
}

/// Points 10 and 5: margins of the loop, how certain, one unit for one number, forty lines.
TEST(Newcomers, ReportsHaveTheLoopTheirCertaintyAndFortyLines) {
  for (const char* name : {"faul", "jt", "moteus", "nema23f", "odrive", "series"}) {
    const AnswerReport report = report_on(written(name));
    const std::string text = answer_text(report);
    EXPECT_LE(std::count(text.begin(), text.end(), '\n'), 40) << text;
    EXPECT_THAT(text.substr(0, text.find('\n')), HasSubstr("(found from ")) << name;
    EXPECT_THAT(text, HasSubstr("phase margin")) << name;
    EXPECT_THAT(text, Not(HasSubstr("rad)"))) << name;
    EXPECT_THAT(text, Not(HasSubstr("Shooting"))) << name;
  }
}

}  // namespace
}  // namespace gearlash::newcomers_test
