// What reports call a motion, and which numbers they give of it.
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "gearlash/analyse.hpp"
#include "gearlash/input.hpp"
#include "gearlash/output.hpp"
#include "model/reduced_drive.hpp"
#include "output/describe_report.hpp"
#include "question/loop/describing/describing.hpp"

namespace gearlash::words_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

const std::filesystem::path root = GEARLASH_SOURCE_DIRECTORY;
constexpr double arcmin = 0.00029088820866572158;

Drive drive_of(const std::filesystem::path& file, const std::vector<Setting>& settings = {}) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return parse_drive(text.str(), file.string(), file.parent_path(), settings).drive;
}

Drive named(const std::string& name, const std::vector<Setting>& settings = {}) {
  return drive_of(root / "tests/regression/data/words" / (name + ".toml"), settings);
}

// ---- quantization -------------------------------------------------------------------------------

/// It hunts by 2.5 encoder steps; without the encoder it hunts alike, by ±6.28 arcmin.
TEST(Quantization, IsNotWhatADriveDoesWithoutEncoderToo) {
  const Drive drive = named("hunts-with-any-encoder");
  const Answer answer = analyse(drive, {.causes = true});
  EXPECT_EQ(answer.is_quantization, false);
  EXPECT_THAT(headline(drive, answer), HasSubstr(", 2.5 encoder steps"));
  EXPECT_THAT(headline(drive, answer), Not(HasSubstr("quantization")));
  EXPECT_THAT(to_json(drive, answer), HasSubstr("\"is_quantization\": false"));
  const Answer exact =
      analyse(named("hunts-with-any-encoder", {{"sensor.counts_per_turn", "none"}}));
  EXPECT_EQ(exact.verdict, Verdict::hunts);
  EXPECT_NEAR(exact.irregular.at(0).mean_amplitude.value(), 6.28 * arcmin, 0.01 * arcmin);
}

/// Without the encoder, and with one four times as fine, it comes to rest from all starts.
TEST(Quantization, IsHuntingThatEndsWithTheStepsOfTheEncoder) {
  const std::filesystem::path file = root / "examples/products/maxon-re40-gp42c.toml";
  const std::vector<Setting> settings = {
      {"load.coulomb", "30 mN m"}, {"sampling.period", "1 ms"}, {"sensor.counts_per_turn", "4096"}};
  const Drive drive = drive_of(file, settings);
  const Answer answer = analyse(drive, {.causes = true});
  EXPECT_EQ(answer.is_quantization, true);
  EXPECT_THAT(headline(drive, answer), HasSubstr("2.7 encoder steps: quantization"));
  for (const char* counts : {"none", "16384"}) {
    std::vector<Setting> other = settings;
    other.back().text = counts;
    EXPECT_EQ(analyse(drive_of(file, other)).verdict, Verdict::comes_to_rest) << counts;
  }
}

/// It costs a second search.
TEST(Quantization, IsLeftOpenWhereNobodyAsks) {
  const Drive drive = named("hunts-with-any-encoder");
  const Answer answer = analyse(drive);
  EXPECT_FALSE(answer.is_quantization);
  EXPECT_THAT(to_json(drive, answer), HasSubstr("\"is_quantization\": null"));
}

// ---- describing functions -----------------------------------------------------------------------

/// An independent fixed-step simulation swings by ±1.2588 rad every 2.3610 s on average; the
/// largest swing is ±1.260 rad.
TEST(Describe, GivesTheNumbersOfTheAnswerAlsoWhereNothingClosed) {
  const Drive drive = named("sampled-without-lock");
  const Answer answer = analyse(drive);
  ASSERT_TRUE(answer.cycles.empty());
  const DescribeReport report = describe_report_of(drive, answer);
  const std::string text = describe_text(report);
  EXPECT_THAT(text, StartsWith(headline(drive, answer) + "\n"));
  EXPECT_THAT(text, StartsWith("hunts: ±1.26 rad"));
  EXPECT_THAT(text, HasSubstr("exact            ±1.26 rad   ±1.06 rad   2.361 s"));
  EXPECT_THAT(text, Not(HasSubstr("no stable cycle")));
  const std::string json = describe_json(report);
  EXPECT_THAT(json, HasSubstr("\"exact\": 0"));
  EXPECT_THAT(json, HasSubstr("\"mean_amplitude\": 1.258"));
}

Drive with_controller(const std::string& controller) {
  return parse_drive(R"([motor]
kind = "torque-controlled"
inertia = "0.0123 kg m2"
friction = "0.031 N m s/rad"
[gearbox]
ratio = 1
backlash = "15 arcmin"
[load]
inertia = "0.137 kg m2"
friction = "0.053 N m s/rad"
[sampling]
period = "3.7 ms"
[controller]
kind = "transfer-function"
gain = "1 N m/rad"
)" + controller);
}

/// 3.7/(0.017 · 0.1493) = 1457.8 and 0.3/(0.017 · 0.1493) = 118.2; there was −1.149e-17 s² before.
TEST(Describe, HasNoRoundingForCoefficients) {
  const Drive lag = with_controller("num = [0.3, 3.7]\nden = [0.017, 1.1, 0]\n");
  const auto of_s = drive::describing_analyses(reduce(lag)).at(0).loop;
  ASSERT_EQ(of_s.numerator.size(), 2U);
  EXPECT_NEAR(of_s.numerator[0], 0.3 / (0.017 * 0.1493), 1e-10);
  EXPECT_NEAR(of_s.numerator[1], 3.7 / (0.017 * 0.1493), 1e-10);
  // z² − 1.9 z + 0.9 has the root 1; the doubles add up to 1.1e-16.
  const Drive discrete =
      with_controller("variable = \"z\"\nnum = [3.7, -6.9, 3.21]\nden = [1, -1.9, 0.9]\n");
  const auto of_z = drive::describing_analyses(reduce(discrete)).at(0).loop;
  ASSERT_EQ(of_z.denominator.size(), 5U);
  EXPECT_EQ(of_z.denominator[3], 0.0);
  EXPECT_EQ(of_z.denominator[4], 0.0);
  EXPECT_NE(of_z.denominator[2], 0.0);
}

// ---- SECTION=none -------------------------------------------------------------------------------

/// As the same file without timestep, which hunts by ±1.5916′.
TEST(SectionNone, TakesOutWhatAnotherSectionGives) {
  const Drive continuous = named("joint-of-mujoco", {{"sampling", "none"}});
  EXPECT_FALSE(continuous.sampling);
  EXPECT_EQ(continuous, named("joint-of-mujoco", {{"actuator.timestep", "none"}}));
  EXPECT_NEAR(analyse(continuous).value(Quantity::amplitude).value(), 1.59164 * arcmin,
              1e-5 * arcmin);
  EXPECT_TRUE(named("joint-of-mujoco").sampling);
}

TEST(SectionNone, IsTakenForTheSectionsOfEveryForm) {
  EXPECT_NO_THROW((void)read_setting("actuator=none"));
  EXPECT_THROW((void)read_setting("actuators=none"), InvalidInput);
  const std::filesystem::path sheet = root / "examples/elinco-fd162.toml";
  const Drive changed = drive_of(
      sheet, {{"loop", "none"}, {"controller.kind", "P"}, {"controller.proportional", "1 V/rad"}});
  EXPECT_EQ(changed.controller.law.index(), drive_of(sheet).controller.law.index());
  EXPECT_THROW((void)named("joint-of-mujoco", {{"actuator", "none"}}), InvalidInput);
}

TEST(JointOfMujoco, SaysWhichEncoderIsAssumed) {
  const Answer assumed = analyse(named("joint-of-mujoco"));
  ASSERT_EQ(assumed.notes.size(), 1U);
  EXPECT_EQ(assumed.notes[0].code, "assumed-encoder");
  EXPECT_EQ(assumed.notes[0].text,
            "The encoder is assumed on the load; sensor.position = \"motor\" puts it on the "
            "motor.");
  for (const char* place : {"load", "motor"}) {
    for (const Note& note : analyse(named("joint-of-mujoco", {{"sensor.position", place}})).notes) {
      EXPECT_NE(note.code, "assumed-encoder") << place;
    }
  }
}

// ---- running away -------------------------------------------------------------------------------

/// It rests within ±5 arcmin. Steps from two thirds of a turn on wind its integral up.
TEST(Headline, OfADriveThatWindsUpBeginsWithItsRest) {
  const Drive drive = named("integral-without-anti-windup");
  const Answer answer = analyse(drive);
  EXPECT_EQ(answer.verdict, Verdict::runs_away_if_disturbed);
  EXPECT_THAT(headline(drive, answer),
              StartsWith("comes to rest, up to 5 arcmin off; runs away after steps from "));
  EXPECT_THAT(to_json(drive, answer), HasSubstr("\"verdict\": \"runs away if disturbed\""));
}

// ---- time to rest -------------------------------------------------------------------------------

TEST(TimeToRestInWords, IsInTheHeadlineFromAMinuteOn) {
  const Drive slow = drive_of(root / "tests/regression/data/ends/rests-after-minutes.toml");
  const Answer answer = analyse(slow);
  EXPECT_THAT(headline(slow, answer),
              StartsWith("comes to rest, up to 2.64 arcmin off, after up to "));
  EXPECT_THAT(headline(slow, answer), HasSubstr(" min"));
  // A wider band is reached sooner.
  Drive tolerant = slow;
  tolerant.specification.band = 60.0 * arcmin;
  const Answer wide = analyse(tolerant);
  ASSERT_TRUE(wide.rest && wide.rest->time);
  EXPECT_EQ(wide.rest->time->band, 60.0 * arcmin);
  EXPECT_LT(wide.rest->time->longest, 60.0);
  EXPECT_THAT(headline(slow, wide), Not(HasSubstr(" after ")));
}

}  // namespace
}  // namespace gearlash::words_test
