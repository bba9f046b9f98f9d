// Drives that users have: each is decided, and as others found it to be.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "gearlash/analyse.hpp"
#include "gearlash/input.hpp"

namespace gearlash {
namespace {

const std::filesystem::path data =
    std::filesystem::path(GEARLASH_SOURCE_DIRECTORY) / "tests/regression/data";

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

}  // namespace
}  // namespace gearlash
