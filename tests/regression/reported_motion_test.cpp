// What is said of a motion that a search found: how long it was watched, what it is called, and
// that nothing is listed twice.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>
#include <string>

#include "gearlash/analyse.hpp"
#include "gearlash/input.hpp"
#include "gearlash/motion.hpp"
#include "gearlash/output.hpp"
#include "general/attractors/attractors.hpp"
#include "model/reduced_drive.hpp"
#include "output/answer_report.hpp"
#include "question/loop/describing/describing.hpp"

namespace gearlash::reported_motion_test {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

const std::filesystem::path root = GEARLASH_SOURCE_DIRECTORY;
constexpr double arcmin = std::numbers::pi / 180.0 / 60.0;

Drive drive_of(const std::string& file) {
  return read_drive(root / "tests/regression/data" / file);
}

/// The first file that a page of docs shows.
Drive first_drive_on(const std::string& page) {
  std::ifstream stream(root / page);
  std::string text;
  bool is_inside = false;
  for (std::string line; std::getline(stream, line);) {
    if (is_inside && line == "```") break;
    if (is_inside) text += line + "\n";
    is_inside = is_inside || line == "```toml";
  }
  return parse_drive(text);
}

void expect_mirrored(const Bounds& range) { EXPECT_EQ(range.low, -range.high); }

// ---- how long a start is watched ----------------------------------------------------------------

/// Its motor ticks every 3.4 to 7.5 s under a computer of 10 kHz: a dozen of its swings are half a
/// million ticks, which do not use up the events that a start may have.
TEST(ReportedMotion, IsWatchedForManyTicksOfAMotorWithinItsGap) {
  drive::AttractorOptions options;
  options.starts = {{.motor_position = 1e-3, .load_position = 1e-3}};
  options.most_events = 20'000;
  const drive::AttractorSearch found =
      drive::find_attractors(reduce(drive_of("industrial/rnd02.toml")), options);
  ASSERT_EQ(found.irregular.size(), 1U);
  const drive::IrregularFound& motion = found.irregular[0];
  EXPECT_TRUE(motion.is_motor_alone);
  EXPECT_GT(motion.period, 3.0);
  EXPECT_GE(motion.swings, options.tolerances.irregular.few_swings);
  EXPECT_GT(found.outcomes[0].watched, 10.0 * motion.period);
  EXPECT_GT(found.outcomes[0].watched / 1e-4, 5e5);
}

/// The example on the drives' page. An independent fixed-step simulator hunts by 18.999 arcmin
/// every 4.1850 s from 0.3 arcmin on. The large steps wind up the integral, which has no
/// anti-windup, and the swings grow.
TEST(ReportedMotion, OfTheDrivesPageIsDecidedInLittleTime) {
  const Drive drive = first_drive_on("docs/reference/drives.md");
  const Answer answer = analyse(drive);
  ASSERT_TRUE(answer.search);
  EXPECT_EQ(answer.search->count("undecided"), 0U);
  EXPECT_EQ(answer.verdict, Verdict::hunts_if_disturbed);
  ASSERT_EQ(answer.irregular.size(), 1U);
  const IrregularMotion& motion = answer.irregular[0];
  EXPECT_NEAR(*motion.mean_amplitude / arcmin, 18.999, 1e-3);
  EXPECT_NEAR(*motion.mean_period, 4.1850, 5e-4);
  const std::string text = to_text(drive, answer);
  EXPECT_THAT(text, StartsWith("hunts: ±19.1 arcmin at 0.239 Hz; comes to rest from "));
  EXPECT_THAT(text, HasSubstr("runs away after steps from"));
  EXPECT_THAT(text, Not(HasSubstr("not seen to repeat")));
  // Of simulated time: a start that repeats, or joins a known motion, need not be watched on.
  double watched = 0.0;
  for (const StartOutcome& start : answer.search->starts) watched += start.watched;
  EXPECT_LT(watched, 3000.0);
}

// ---- what it is called --------------------------------------------------------------------------

Drive driven(const std::string& key) {
  return parse_drive(R"([motor]
kind = "torque-controlled"
inertia = "1 kg m2"
friction = "0.5 N m s/rad"
[gearbox]
ratio = 1
backlash = "0.1 rad"
[load]
inertia = "1 kg m2"
friction = "0.5 N m s/rad"
[controller]
kind = "PD"
proportional = "10 N m/rad"
derivative = "3 N m s/rad"
[)" + key + R"(]
kind = "sine"
amplitude = ")" + (key == "reference" ? "1 rad" : "5 N m") +
                     R"("
frequency = "0.4 Hz"
)");
}

TEST(ReportedMotion, ThatASineDrivesIsForcedAndNoHunting) {
  for (const std::string key : {"reference", "load_torque"}) {
    const Drive drive = driven(key);
    const Answer answer = analyse(drive);
    EXPECT_EQ(answer.verdict, Verdict::forced) << key;
    const std::string text = to_text(drive, answer);
    EXPECT_THAT(text, StartsWith("forced oscillation: "));
    EXPECT_THAT(text, Not(HasSubstr("hunts")));
    const std::string json = to_json(drive, answer);
    EXPECT_THAT(json, HasSubstr("\"verdict\": \"forced\""));
    EXPECT_THAT(json, Not(HasSubstr("\"hunts")));
  }
}

TEST(ReportedMotion, OfAFewEncoderStepsIsGivenInSteps) {
  const Drive drive = drive_of("industrial/rnd08.toml");
  const Answer answer = analyse(drive);
  ASSERT_FALSE(answer.irregular.empty());
  EXPECT_LT(answer.irregular[0].encoder_steps.value(), steps_of_quantization);
  EXPECT_THAT(headline(drive, answer), HasSubstr(", 3.5 encoder steps"));
}

IrregularMotion motion_with(double mismatch, double spread, double encoder_steps) {
  return {.amplitude = 1.1,
          .motor_amplitude = 1.2,
          .mean_amplitude = 1.0,
          .amplitude_deviation = spread,
          .mean_period = 2.0,
          .period_deviation = 0.01,
          .mismatch = mismatch,
          .exponent = 1.17,
          .watched = 1000.0,
          .encoder_steps = encoder_steps};
}

/// Half the peak-to-peak, as of a cycle, whatever the swings are on average: report and describe
/// had the mean of those that repeat, and targets and tables the extremes.
TEST(ReportedMotion, HasOneAmplitudeInEveryVerb) {
  Answer answer;
  answer.verdict = Verdict::hunts;
  answer.irregular = {motion_with(2e-11, 0.2, 50.0)};
  EXPECT_EQ(answer.value(Quantity::amplitude), 1.1);
  EXPECT_THAT(headline(Drive{}, answer), StartsWith("hunts: ±1.1 rad"));
  ASSERT_EQ(drive::exact_motions(answer).size(), 1U);
  EXPECT_EQ(drive::exact_motions(answer)[0].amplitude, 1.1);
  AnswerReport report = report_of(Drive{}, answer);
  report.measured = MeasuredHunting{.amplitude = 1.1, .frequency = 0.5};
  EXPECT_THAT(answer_json(report), HasSubstr("\"amplitude_share\": 0"));
}

/// Small swings lie between its large ones: their mean is ±0.86 arcmin.
TEST(ReportedMotion, OfSeveralSwingsAPeriodHasThePeakToPeakForAmplitude) {
  const Drive drive = drive_of("two-swings-of-one-load.toml");
  EXPECT_THAT(headline(drive, analyse(drive)), HasSubstr("±1.28 arcmin"));
}

/// A ramp makes it irregular: later starts join the motion of the first, and are not watched on.
TEST(ReportedMotion, ThatIsIrregularIsJoined) {
  Drive drive = drive_of("coarse-load-encoder.toml");
  drive.reference = RampSignal{.rate = 5.0 * 60.0 * arcmin};
  drive::AttractorOptions options;
  options.starts = {{.load_position = 0.01},
                    {.load_position = -0.01},
                    {.motor_position = 0.05, .load_position = 0.05}};
  const drive::AttractorSearch found = drive::find_attractors(reduce(drive), options);
  ASSERT_EQ(found.irregular.size(), 1U);
  EXPECT_EQ(found.irregular[0].starts, 3U);
  EXPECT_LT(found.outcomes[2].watched, 0.5 * found.outcomes[0].watched);
}

/// Newton's method must not leave the encoder's grid, beside which each count has a cycle of its
/// own.
TEST(ReportedMotion, BehindACoarseEncoderIsOneCycle) {
  const Drive drive = drive_of("coarse-load-encoder.toml");
  const Answer answer = analyse(drive);
  ASSERT_EQ(answer.cycles.size(), 1U);
  EXPECT_EQ(answer.cycles[0].starts, answer.search->starts.size());
  const Motion motion = simulate(drive, {.until = 20.0});
  const double period = answer.cycles[0].period;
  double low = 1e9;
  double high = -1e9;
  constexpr int samples = 20000;
  for (int i = 0; i <= samples; ++i) {
    const double position = motion.at(20.0 - period * i / samples).shafts.load_position;
    low = std::min(low, position);
    high = std::max(high, position);
  }
  EXPECT_NEAR(0.5 * (high - low), answer.cycles[0].amplitude, 1e-9);
  EXPECT_NEAR(0.5 * (high + low) - 20.0 * std::numbers::pi / 180.0, answer.cycles[0].center, 1e-9);
}

/// Swings that repeat are not irregular, whatever their neighbours do.
TEST(ReportedMotion, RepeatsIfItsSwingsDoOrWithinAnEncodersStep) {
  EXPECT_TRUE(motion_with(2e-11, 0.2, 50.0).repeats());
  EXPECT_FALSE(motion_with(0.02, 0.2, 50.0).repeats());
  EXPECT_TRUE(motion_with(0.02, 0.019, 50.0).repeats());
  EXPECT_FALSE(motion_with(0.02, 0.021, 50.0).repeats());
  EXPECT_FALSE(motion_with(0.02, 0.2, 0.0).repeats());  // the encoder does not see it
  IrregularMotion uneven = motion_with(0.02, 0.019, 50.0);
  uneven.period_deviation = 0.2;
  EXPECT_FALSE(uneven.repeats());
  EXPECT_FALSE(IrregularMotion{.amplitude = 1.0}.repeats());
  Answer answer;
  answer.search = SearchRecord{.starts = {{.end = "irregular", .which = 0}}};
  answer.irregular = {motion_with(2e-11, 0.2, 50.0)};
  const std::string text = answer_text(report_of(Drive{}, answer), Detail::all);
  EXPECT_THAT(text, HasSubstr("Motion whose swings repeat"));
  EXPECT_THAT(text, HasSubstr("1 to motion whose swings repeat"));
  EXPECT_THAT(text, Not(HasSubstr("chaotic")));
  EXPECT_THAT(to_json(Drive{}, answer), HasSubstr("\"repeats\": true"));
}

/// Eight starts hunt at 18.7 Hz; the large ones run away. What engineers read first says both.
TEST(ReportedMotion, SaysInItsFirstLineWhatLargeStepsDo) {
  const Drive drive = drive_of("current-loop-2500-hz.toml");
  const Answer answer = analyse(drive);
  const std::string line = headline(drive, answer);
  EXPECT_THAT(line, StartsWith("comes to rest, up to "));
  EXPECT_THAT(line, HasSubstr("; hunts, "));
  EXPECT_THAT(line, HasSubstr(" at 18.7 Hz"));
  EXPECT_THAT(line, HasSubstr("; runs away after steps from "));
  // ±0.195° at an encoder step of 0.0055°.
  EXPECT_NEAR(answer.irregular.at(0).encoder_steps.value(), 71.0, 2.0);
}

// ---- where it rests -----------------------------------------------------------------------------

TEST(ReportedRest, OfADriveThatIsItsMirrorImageIsOneToo) {
  for (const std::string file : {"pid-coulomb-motor-encoder-0.toml", "industrial/rnd04.toml",
                                 "pid-with-coulomb-friction.toml"}) {
    const Answer answer = analyse(drive_of(file));
    ASSERT_TRUE(answer.rest) << file;
    expect_mirrored(answer.rest->load);
    expect_mirrored(answer.rest->motor);
    expect_mirrored(answer.rest->error);
  }
}

/// Starts begin on one side.
TEST(ReportedRest, OfStartsOnOneSideHasItsMirrorImage) {
  Drive drive = drive_of("industrial/rnd04.toml");
  drive.controller.dead_band.width = 0.01;
  const Answer answer = analyse(drive);
  ASSERT_TRUE(answer.rest);
  EXPECT_EQ(answer.rest->certainty, Certainty::computed);
  EXPECT_GT(answer.rest->load.high, 0.0);
  expect_mirrored(answer.rest->load);
  expect_mirrored(answer.rest->motor);
  // Encoders that never read the reference read its two sides differently.
  drive.reference = 0.3 * reduce(drive).sensing.resolution;
  const Answer aside = analyse(drive);
  ASSERT_TRUE(aside.rest);
  EXPECT_NE(aside.rest->load.low, -aside.rest->load.high);
}

/// Joined shafts measured on the motor: its torque comes to rest at the edge of its friction, where
/// rounding lets it stop and break away without end.
TEST(ReportedRest, OfAMotorThatTremblesAtItsFrictionsEdge) {
  Drive drive = read_drive(root / "examples/telescope-axis.toml");
  drive.sensor.position = SensorPlace::motor;
  drive.contact = CompliantContact{.stiffness = 44.0 / arcmin, .damping = 80.0};
  drive.gearbox.backlash = 0.0;
  const Answer answer = analyse(drive);
  EXPECT_EQ(answer.verdict, Verdict::comes_to_rest);
  EXPECT_EQ(answer.search->count("undecided"), 0U);
}

/// A load that is where it should be but for rounding.
TEST(ReportedRest, HasNoDigitsOfRounding) {
  const Drive drive = drive_of("ramp-stick-slip.toml");
  const Answer answer = analyse(drive);
  ASSERT_TRUE(answer.rest);
  EXPECT_EQ(answer.rest->load.low, 0.0);
  EXPECT_EQ(answer.rest->load.high, 0.0);
  EXPECT_THAT(to_text(drive, answer), HasSubstr("error, reference − load  0 rad"));
}

}  // namespace
}  // namespace gearlash::reported_motion_test
