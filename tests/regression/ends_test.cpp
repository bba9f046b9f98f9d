// Drives of users whose motions ended elsewhere than version 0.2 said.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>

#include "gearlash/analyse.hpp"
#include "gearlash/input.hpp"

namespace gearlash::ends_test {
namespace {

const std::filesystem::path data =
    std::filesystem::path(GEARLASH_SOURCE_DIRECTORY) / "tests/regression/data/ends";

Answer answer_of(const std::string& file) { return analyse(read_drive(data / (file + ".toml"))); }

/// Integral action pushes the motor across the gap for 30 s while the load stands, without dry
/// friction: no law of creeping. An independent simulation hunts by ±0.3153 rad from every start.
TEST(Ends, AStandingLoadWhoseMotorCrossesTheGapHunts) {
  const Answer answer = answer_of("motor-takes-long-to-cross-its-gap");
  EXPECT_EQ(answer.verdict, Verdict::hunts);
  EXPECT_FALSE(answer.rest);
  ASSERT_EQ(answer.cycles.size(), 1U);
  EXPECT_NEAR(answer.cycles[0].amplitude, 0.3153, 0.0001);
}

/// The reading is two counts off, as far as the dead band reaches: nothing is integrated.
TEST(Ends, ADeadBandOfWholeCountsIsComparedInCounts) {
  const Answer answer = answer_of("dead-band-of-two-counts");
  EXPECT_EQ(answer.verdict, Verdict::comes_to_rest);
  EXPECT_EQ(answer.search->count("rest"), answer.search->starts.size());
}

/// Samples at bounces look like pauses, and nothing holds the shafts.
TEST(Ends, NothingCreepsWithoutDryFriction) {
  for (const char* file : {"no-friction-c13", "no-friction-c362", "no-friction-c484"}) {
    const Answer answer = answer_of(file);
    EXPECT_EQ(answer.verdict, Verdict::hunts) << file;
    EXPECT_FALSE(answer.rest) << file;
  }
}

/// Dry friction of the motor and integral action, and a load that slides on: three pauses by one
/// ratio, of some hundredths of a second. From there simulate() swings by ±0.001568 rad to 300 s.
TEST(Ends, PausesShorterThanASwingAreNoCreeping) {
  const Answer answer = answer_of("pauses-shorter-than-a-swing");
  EXPECT_EQ(answer.verdict, Verdict::hunts);
  EXPECT_FALSE(answer.rest);
  const auto is_that_swing = [](const Cycle& cycle) {
    return cycle.stability == Stability::stable && std::abs(cycle.amplitude - 0.001568) < 1e-6;
  };
  EXPECT_TRUE(std::any_of(answer.cycles.begin(), answer.cycles.end(), is_that_swing));
}

}  // namespace
}  // namespace gearlash::ends_test
