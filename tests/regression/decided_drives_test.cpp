// Drives that users have: each is decided, and as others found it to be.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <utility>

#include "gearlash/analyse.hpp"
#include "gearlash/input.hpp"
#include "gearlash/parameter.hpp"
#include "general/attractors/attractors.hpp"
#include "model/reduced_drive.hpp"

namespace gearlash::decided_drives_test {
namespace {

const std::filesystem::path root = GEARLASH_SOURCE_DIRECTORY;
const std::filesystem::path data = root / "tests/regression/data";

Answer answer_of(const std::string& file) { return analyse(read_drive(data / file)); }

std::size_t undecided(const Answer& answer) {
  return answer.search ? answer.search->count("undecided") : 0;
}

class IndustrialDrive : public testing::TestWithParam<int> {};

TEST_P(IndustrialDrive, IsDecidedAsTheFixedStepSimulatorDoes) {
  std::ifstream table(data / "industrial/expected.csv");
  std::string line;
  for (int i = 0; i <= GetParam() + 1; ++i) ASSERT_TRUE(std::getline(table, line));
  std::istringstream row(line);
  std::string file;
  std::string rests;
  std::string hunts;
  std::getline(row, file, ',');
  std::getline(row, rests, ',');
  std::getline(row, hunts, ',');
  const Answer answer = answer_of("industrial/" + file);
  EXPECT_EQ(undecided(answer), 0U);
  EXPECT_NE(answer.verdict, Verdict::undecided);
  EXPECT_EQ(answer.rest.has_value(), rests == "1") << file;
  const bool is_hunting = !answer.irregular.empty() || answer.largest_stable() != nullptr;
  EXPECT_EQ(is_hunting, hunts == "1") << file;
}

INSTANTIATE_TEST_SUITE_P(Twenty, IndustrialDrive, testing::Range(0, 20));

/// Friction at rest that is that of motion stores nothing: integral action moves the drive ever
/// less and ever later (Armstrong-Hélouvry & Amin 1996; Ruderman, arXiv 2006.08977).
TEST(DecidedDrive, CreepsToRestWhereStaticFrictionIsThatOfMotion) {
  for (int i = 0; i < 5; ++i) {
    const Answer answer = answer_of("pid-coulomb-motor-encoder-" + std::to_string(i) + ".toml");
    EXPECT_EQ(answer.verdict, Verdict::comes_to_rest) << i;
    EXPECT_EQ(undecided(answer), 0U) << i;
  }
  EXPECT_GT(answer_of("pid-coulomb-motor-encoder-0.toml").rest->creeping_starts, 0U);
}

/// Starts within 0.05 rad die down, 0.09 rad runs away.
TEST(DecidedDrive, RunsAwayIfDisturbedFarEnough) {
  const Answer answer = answer_of("pid-with-coulomb-friction.toml");
  EXPECT_EQ(answer.verdict, Verdict::runs_away_if_disturbed);
  for (const StartOutcome& start : answer.search->starts) {
    if (start.load_speed != 0.0) continue;
    EXPECT_EQ(start.end, start.load_position < 0.05 ? "rest" : "diverges") << start.load_position;
  }
  // They end on a cycle of the gap's size on which the drive moves for a second in five hours.
  EXPECT_GT(answer.rest->creeping_starts, 0U);
  EXPECT_TRUE(answer.cycles.empty());
  EXPECT_NEAR(answer.rest->load.high, 2.67019e-7, 1e-12);
  EXPECT_NEAR(answer.rest->load.low, -2.67019e-7, 1e-12);
  // Between them is an unstable cycle of about 0.0726 rad, which a step of that size passes.
  ASSERT_EQ(answer.thresholds.size(), 1U);
  const Threshold& away = answer.thresholds.front();
  EXPECT_EQ(away.end, "running away");
  EXPECT_EQ(away.direction, 0.0);
  EXPECT_GT(away.below, 0.05);
  EXPECT_LT(away.from, 0.09);
  EXPECT_LT(away.from / away.below, 1.04);
}

/// With this gain six rounds of that cycle were taken for one, on which a rounded speed moved the
/// load while it stood.
TEST(DecidedDrive, RunsAwayIfDisturbedWithNeighbouringGains) {
  Drive drive = read_drive(data / "pid-with-coulomb-friction.toml");
  for (const char* gain : {"2.05 N m/rad", "2.06 N m/rad", "2.07 N m/rad"}) {
    set(drive, "controller.proportional", gain);
    EXPECT_EQ(analyse(drive).verdict, Verdict::runs_away_if_disturbed) << gain;
  }
}

/// One start of twenty stands for an hour before the motor crosses the gap.
TEST(DecidedDrive, BreaksAwayAfterAnHour) {
  Drive drive = read_drive(root / "examples/telescope-axis.toml");
  drive.gearbox.backlash = 5.0 / 60.0 * std::acos(-1.0) / 180.0;
  const Answer answer = analyse(drive);
  EXPECT_EQ(answer.verdict, Verdict::hunts);
  EXPECT_EQ(answer.search->count("cycle"), 20U);
  double longest = 0.0;
  for (const StartOutcome& start : answer.search->starts)
    longest = std::max(longest, start.watched);
  EXPECT_GT(longest, 3600.0);
}

/// Events that follow each other without end by rounding alone are rest.
TEST(DecidedDrive, TremblesAtItsFrictionsEdge) {
  const Answer answer = answer_of("trembles-behind-its-gap.toml");
  EXPECT_EQ(answer.verdict, Verdict::hunts_if_disturbed);
  EXPECT_EQ(undecided(answer), 0U);
  EXPECT_NEAR(answer.rest->error.high, 0.0, 1e-12);
}

/// A standstill of a sampled drive, or under a sine, is not watched until the law of creeping
/// shows.
TEST(DecidedDrive, StandsForLongWhereThatIsCostlyToWatch) {
  std::ifstream file(data / "pid-coulomb-motor-encoder-0.toml");
  std::stringstream text;
  text << file.rdbuf();
  for (const std::string more :
       {"[sampling]\nperiod = \"1 ms\"\n",
        "[load_torque]\nkind = \"sine\"\namplitude = \"5 mN m\"\nfrequency = \"3 Hz\"\n"}) {
    const Answer answer = analyse(parse_drive(text.str() + more));
    EXPECT_EQ(answer.verdict, Verdict::comes_to_rest) << more;
    EXPECT_GT(answer.rest->creeping_starts, 0U) << more;
  }
}

/// The integral takes minutes to hours, or pushes the motor across its gap ever later.
TEST(DecidedDrive, SlidesOrCreepsToRestForHours) {
  for (const char* file : {"slides-for-hours", "bouncing-slides", "creeps-across-its-gap"}) {
    const Answer answer = answer_of(std::string("continuous/") + file + ".toml");
    EXPECT_EQ(answer.verdict, Verdict::comes_to_rest) << file;
    EXPECT_EQ(undecided(answer), 0U) << file;
  }
  const Answer creeping = answer_of("continuous/creeps-across-its-gap.toml");
  EXPECT_EQ(creeping.rest->creeping_starts, creeping.search->starts.size());
}

/// The motor sticks and slips 88 times a second while the load slides to the reference.
TEST(DecidedDrive, SticksAndSlipsAsItFades) {
  const Answer answer = answer_of("continuous/sticks-and-slips-as-it-fades.toml");
  EXPECT_EQ(answer.verdict, Verdict::runs_away_if_disturbed);
  EXPECT_EQ(undecided(answer), 0U);
  EXPECT_EQ(answer.search->count("cycle"), 0U);
}

/// It stands for half a minute between its moves, in which its integral grows: not to be taken for
/// fading. The fixed-step simulator of tests/oracle/drives has 3.368e-6 and 0.0004102 rad.
TEST(DecidedDrive, HuntsBetweenStandstills) {
  const Answer answer = answer_of("continuous/hunts-between-standstills.toml");
  EXPECT_EQ(answer.verdict, Verdict::hunts_if_disturbed);
  ASSERT_EQ(answer.cycles.size(), 1U);
  EXPECT_NEAR(answer.cycles[0].amplitude, 3.368e-6, 0.02 * 3.368e-6);
  EXPECT_NEAR(answer.cycles[0].motor_amplitude, 4.102e-4, 0.001 * 4.102e-4);
}

/// It stopped, once, in an orbit that is rest but for rounding.
TEST(DecidedDrive, RestsAtRounding) {
  const Answer answer = answer_of("continuous/rests-at-rounding.toml");
  EXPECT_EQ(answer.verdict, Verdict::runs_away_if_disturbed);
  EXPECT_TRUE(answer.cycles.empty());
  EXPECT_TRUE(answer.irregular.empty());
}

/// Rounding in the projector on its fast decays let every number act on every other by 1e-46. Their
/// common scale then hid the impact of the faces, and the motor swung 8 rad through the load.
TEST(DecidedDrive, MeetsItsFacesOnceItsFilterIsOver) {
  const Answer answer =
      analyse(read_drive(data / "continuous/bounces-behind-a-filter.toml"), {.ceiling = true});
  EXPECT_EQ(answer.verdict, Verdict::hunts);
  ASSERT_NE(answer.largest_stable(), nullptr);
  EXPECT_LT(answer.largest_stable()->amplitude, *answer.ceiling->load);
  EXPECT_LT(answer.largest_stable()->motor_amplitude, *answer.ceiling->motor);
}

/// It moves irregularly for a minute before it joins a cycle that lies where it moves.
TEST(DecidedDrive, JoinsItsCycleLate) {
  const Answer answer = answer_of("continuous/joins-its-cycle-late.toml");
  EXPECT_EQ(answer.verdict, Verdict::hunts);
  EXPECT_TRUE(answer.irregular.empty());
  EXPECT_EQ(answer.search->count("cycle"), answer.search->starts.size());
}

/// An orbit at rest recurs after any time, and was divided into shorter ones without end.
TEST(DecidedDrive, HasNoCycleOfRounding) {
  const Answer answer = answer_of("continuous/recurs-at-rounding.toml");
  EXPECT_EQ(answer.verdict, Verdict::runs_away_if_disturbed);
  EXPECT_EQ(answer.search->count("cycle"), 0U);
  EXPECT_EQ(undecided(answer), 0U);
}

/// It stands for minutes before its integral action breaks it away.
TEST(DecidedDrive, WithStictionIsWatchedUntilItBreaksAway) {
  const Answer answer = answer_of("slow-to-break-away.toml");
  EXPECT_EQ(answer.verdict, Verdict::hunts_if_disturbed);
  EXPECT_EQ(undecided(answer), 0U);
}

/// Steady tracking, and beside it a stick-slip of both shafts, of which an independent simulator
/// has these numbers.
TEST(DecidedDrive, SticksAndSlipsBehindARamp) {
  const Answer answer = answer_of("ramp-stick-slip.toml");
  EXPECT_EQ(undecided(answer), 0U);
  EXPECT_TRUE(answer.rest);
  ASSERT_NE(answer.largest_stable(), nullptr);
  EXPECT_NEAR(answer.largest_stable()->amplitude, 0.0022391, 1e-7);
  EXPECT_NEAR(answer.largest_stable()->period, 2.49741, 1e-5);
}

/// Hunting of some encoder steps at 18.7 Hz, reached from many starts; two large ones run away.
TEST(DecidedDrive, HuntsAtTheRateOfMostOfItsStarts) {
  const Answer answer = answer_of("current-loop-2500-hz.toml");
  EXPECT_EQ(undecided(answer), 0U);
  EXPECT_EQ(answer.search->count("diverges"), 2U);
  ASSERT_FALSE(answer.irregular.empty());
  const auto most =
      std::max_element(answer.irregular.begin(), answer.irregular.end(),
                       [](const auto& a, const auto& b) { return a.starts < b.starts; });
  EXPECT_NEAR(1.0 / most->mean_period.value(), 18.7, 0.2);
}

/// Two motions whose loads swing by less than a tenth of the motors' swing apart: ±0.62 arcmin at
/// 30.7 Hz and ±1.28 arcmin at 9.1 Hz. Simulated for 40 s, each goes on as it is. They were once
/// taken for one.
TEST(DecidedDrive, TellsMotionsApartByTheMotorsSwing) {
  const Answer answer = answer_of("two-swings-of-one-load.toml");
  ASSERT_EQ(answer.irregular.size(), 2U);
  const auto [slow, quick] = std::pair(answer.irregular[0], answer.irregular[1]);
  EXPECT_NEAR(slow.amplitude, 3.72e-4, 0.02e-4);
  EXPECT_NEAR(slow.motor_amplitude.value(), 1.68e-3, 0.02e-3);
  EXPECT_NEAR(slow.mean_period.value(), 0.110, 0.002);
  EXPECT_NEAR(quick.amplitude, 1.801e-4, 0.002e-4);
  EXPECT_NEAR(quick.motor_amplitude.value(), 2.203e-3, 0.002e-3);
  EXPECT_NEAR(quick.mean_period.value(), 0.03259, 0.0001);
  EXPECT_GT(quick.starts, slow.starts);
}

/// 0.367 N m over 2 N m/rad · 50: the only equilibrium. Closing a cycle, a shot that hardly
/// approached its end was once followed for ages.
TEST(DecidedDrive, RestsUnderAConstantLoadTorque) {
  const Answer answer = answer_of("constant-load-torque.toml");
  EXPECT_EQ(answer.verdict, Verdict::comes_to_rest);
  EXPECT_NEAR(answer.rest->load.low, 0.00367, 1e-12);
  EXPECT_NEAR(answer.rest->load.high, 0.00367, 1e-12);
}

/// A load that is read as one step off the middle of a sine: the integral of that step, 3 µN m/s,
/// takes ten hours to the 0.106 N m that the motor holds.
TEST(DecidedDrive, HuntsUnderASineThatIsIntegratedOffItsMiddle) {
  Drive drive = read_drive(data / "ends/stands-or-hunts-under-a-sine.toml");
  drive.sensor.encoder.resolution = 8e-9;
  drive::AttractorOptions options;
  options.starts = {{.motor_position = -9.742e-6, .load_position = 9e-9}};
  const auto found = drive::find_attractors(reduce(drive), options);
  ASSERT_EQ(found.outcomes.size(), 1U);
  EXPECT_EQ(found.outcomes[0].end, drive::MotionEnd::irregular);
}

/// A period of 1,000 s beside a filter of 5 ms.
TEST(DecidedDrive, FollowsASlowSine) {
  drive::AttractorOptions options;
  options.starts = {{}, {.motor_position = 0.2, .load_position = 0.2}};
  const auto found = drive::find_attractors(reduce(read_drive(data / "slow-sine.toml")), options);
  EXPECT_EQ(found.count(drive::MotionEnd::cycle), 2U);
  ASSERT_EQ(found.cycles.size(), 1U);
  EXPECT_NEAR(found.cycles[0].period(), 1000.0, 1e-7);  // shooting closes orbits to 1e-10
  EXPECT_NEAR(found.cycles[0].amplitude, 0.1 - 0.7 / 100.0, 1e-5);  // friction over 100 N m/rad
}

/// Poles from 0.1 to 10,000 rad/s: the steps are short, and so must be what is kept of them.
TEST(DecidedDrive, WithALagOfTwelfthOrderRunsAwayIfDisturbed) {
  drive::AttractorOptions options;
  options.starts = {{.motor_position = 1e-5, .load_position = 1e-5},
                    {.motor_position = 10.0, .load_position = 10.0}};
  const auto found =
      drive::find_attractors(reduce(read_drive(data / "twelfth-order-lag.toml")), options);
  ASSERT_EQ(found.outcomes.size(), 2U);
  EXPECT_EQ(found.outcomes[0].end, drive::MotionEnd::rest);
  EXPECT_EQ(found.outcomes[1].end, drive::MotionEnd::diverges);
}

}  // namespace
}  // namespace gearlash::decided_drives_test
