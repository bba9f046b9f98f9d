// Targets as they are typed, and what is said of those that cannot be read.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>
#include <string>
#include <vector>

#include "gearlash/input.hpp"
#include "question/faults_of.hpp"

namespace gearlash::target_text_test {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

Target read(std::string_view text) { return read_target("--target", text, TimeScale::known); }

TEST(TargetText, IsReadWithItsUnits) {
  const auto low = [](const Target& target, Quantity quantity) {
    return target.permitted(quantity).low;
  };
  Target expected;
  expected.require(Quantity::amplitude, {-Target::infinity, degree});
  EXPECT_EQ(read("size <= 1 deg"), expected);
  EXPECT_EQ(read(" size<=1deg "), expected);
  EXPECT_EQ(read("amplitude <= 1 deg"), expected);
  EXPECT_EQ(read("size ≤ 1 deg"), expected);
  EXPECT_EQ(read("size < 1 deg"), expected);
  expected = {};
  expected.require(Quantity::amplitude, {-Target::infinity, 0.25});
  EXPECT_EQ(read("size <= 0.25"), expected);
  EXPECT_EQ(read("size <= 1/4 and size <= 1"), expected);
  expected.require(Quantity::frequency, {5.0, Target::infinity});
  EXPECT_EQ(read("size <= 0.25 and frequency >= 5 Hz"), expected);
  EXPECT_EQ(read("size <= 0.25 and period <= 0.2 s"), expected);
  EXPECT_EQ(low(read("size <= 0.25 and period <= 200 ms"), Quantity::frequency), 5.0);
  EXPECT_EQ(low(read("frequency >= 30 rad/s"), Quantity::frequency),
            30.0 / (2.0 * std::numbers::pi));
  EXPECT_EQ(low(read("bandwidth >= 5 Hz"), Quantity::bandwidth), 5.0);
  EXPECT_EQ(low(read("bandwidth >= 30 rad/s"), Quantity::bandwidth),
            30.0 / (2.0 * std::numbers::pi));
  EXPECT_EQ(low(read("phase-margin >= 30 deg"), Quantity::phase_margin), 30.0 * degree);
  EXPECT_EQ(read("overshoot <= 10 %").permitted(Quantity::overshoot).high, 0.1);
  EXPECT_EQ(read("settling-time <= 50 ms and rise-time <= 0.01 s")
                .permitted(Quantity::settling_time)
                .high,
            0.05);
  EXPECT_TRUE(read("no-hunting").no_hunting);
  EXPECT_TRUE(read("no-hunting-if-disturbed").no_hunting_if_disturbed);
  EXPECT_TRUE(read("no-runaway and amplitude <= 1 deg").no_runaway);
  EXPECT_EQ(read("growth-at-rest <= 0.9").permitted(Quantity::growth_at_rest).high, 0.9);
  EXPECT_EQ(read("motor-amplitude <= 2 deg").permitted(Quantity::motor_amplitude).high,
            2.0 * degree);
  EXPECT_EQ(low(read("ceiling >= 0.5 rad"), Quantity::ceiling), 0.5);
}

TEST(TargetText, OfADriveMayNameTimesIfItHasThem) {
  Drive drive = normal_form(0.19, 2.0, 0.1, 0.3);
  EXPECT_EQ(parse_target("size <= 1 deg", drive).permitted(Quantity::amplitude).high, degree);
  EXPECT_THROW((void)parse_target("frequency >= 5 Hz", drive), InvalidInput);
  EXPECT_THROW((void)parse_target("bandwidth >= 5 Hz", drive), InvalidInput);
  EXPECT_THROW((void)parse_target("rise-time <= 5 s", drive), InvalidInput);
  EXPECT_EQ(parse_target("overshoot <= 0.1", drive).permitted(Quantity::overshoot).high, 0.1);
  drive.servo->natural_frequency = 14.5;
  EXPECT_EQ(parse_target("frequency >= 5 Hz", drive).permitted(Quantity::frequency).low, 5.0);
}

std::vector<std::string> faults_of(std::string_view text, TimeScale scale = TimeScale::known) {
  return test::faults_of([&] { read_target("--target", text, scale); });
}

TEST(EdgeTargetText, FaultsAreToldAtOnceEachInALine) {
  using testing::ElementsAre;
  using testing::StartsWith;
  EXPECT_THAT(
      faults_of("speed <= 3 and size <= 1 kg and size"),
      ElementsAre(StartsWith("--target = speed <= 3: must be no-hunting, no-hunting-if-disturbed"),
                  StartsWith("--target = size <= 1 kg: must be an angle"),
                  StartsWith("--target = size: must be size <= LIMIT or size >= LIMIT")));
  EXPECT_THAT(faults_of(""), ElementsAre(StartsWith("--target = \"\": must be no-hunting")));
  EXPECT_THAT(faults_of("size <="), ElementsAre(StartsWith("--target = size <=: must be")));
  EXPECT_THAT(faults_of("size <= -1"),
              ElementsAre("--target = size <= -1: must have a limit of 0 or more"));
  EXPECT_THAT(faults_of("period <= 0 s"),
              ElementsAre("--target = period <= 0 s: must have a positive limit"));
  EXPECT_THAT(faults_of("size <= 0.1 and size >= 0.2"),
              ElementsAre("--target = size <= 0.1 and size >= 0.2: must not contradict itself"));
  EXPECT_THAT(faults_of("no-hunting-if-disturbed and size >= 0.2"),
              ElementsAre("--target = no-hunting-if-disturbed and size >= 0.2: must not contradict "
                          "itself"));
  EXPECT_THAT(faults_of("frequency >= 5 Hz", TimeScale::unknown),
              ElementsAre("--target = frequency >= 5 Hz: needs a time scale: a servo with a "
                          "natural_frequency, or a data sheet"));
}

TEST(EdgeTargetText, MisspeltNamesGetAGuess) {
  using testing::ElementsAre;
  EXPECT_THAT(faults_of("bandwith >= 3 Hz and no-huntng"),
              ElementsAre("--target = bandwith >= 3 Hz: must name a quantity or a condition (did "
                          "you mean bandwidth?)",
                          "--target = no-huntng: must name a quantity or a condition (did you mean "
                          "no-hunting?)"));
  EXPECT_THAT(faults_of("amplitude <= 1 deg, bandwidth >= 3 Hz"),
              ElementsAre("--target = amplitude <= 1 deg, bandwidth >= 3 Hz: must have \"and\" "
                          "between its conditions"));
}

TEST(EdgeTargetText, AnAngleWithoutUnitIsInRadiansOnlyWhereTheseAreTaken) {
  EXPECT_EQ(read("amplitude <= 0.5").permitted(Quantity::amplitude).high, 0.5);
  EXPECT_THAT(test::faults_of([] {
                read_target("--target", "amplitude <= 0.5", TimeScale::known, BareNumbers::refused);
              }),
              testing::ElementsAre("--target = amplitude <= 0.5: must be an angle with its unit, "
                                   "such as 12 arcmin"));
}

}  // namespace
}  // namespace gearlash::target_text_test
