// The worst corner: no point of a dense random search beats it.
#include "question/series/worst_corner.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "base/seeded_draws.hpp"
#include "base/stopping.hpp"
#include "closed_form/lanes/cycle_batch.hpp"
#include "toleranced_samples.hpp"

namespace gearlash::worst_corner_test {
namespace {

std::vector<double> values_of(const WorstCorner& worst) {
  std::vector<double> values;
  for (const WorstNumber& number : worst.numbers) values.push_back(number.value);
  return values;
}

/// The box that was searched, at random; of lots their values.
std::vector<double> drawn_values(const TolerancedDrive& drive, SeededDraws& draws) {
  std::vector<double> values;
  for (const ParameterTolerance& varied : drive.varied) {
    const Bounds range = three_sigma_range_of(varied.distribution);
    const bool is_lots = std::holds_alternative<DiscreteLots>(varied.distribution);
    values.push_back(is_lots ? quantile(varied.distribution, draws.uniform(1e-9, 1.0))
                             : draws.uniform(range.low, range.high));
  }
  return values;
}

/// Nothing drawn is larger, or where nothing hunts grows more at rest.
void expect_unbeaten(const TolerancedDrive& drive, std::uint64_t seed) {
  SCOPED_TRACE(seed);
  const WorstCorner worst = worst_corner(drive);
  constexpr std::size_t count = 100'000;
  std::vector<NormalizedServo> servos;
  SeededDraws draws(seed);
  for (std::size_t i = 0; i < count; ++i) {
    servos.push_back(drive_with(drive, drawn_values(drive, draws)).servo);
  }
  std::vector<Verdict> verdict(count);
  std::vector<double> amplitude(count);
  std::vector<double> growth_at_rest(count);
  CycleColumns columns{.verdict = verdict};
  columns[Quantity::amplitude] = amplitude;
  columns[Quantity::growth_at_rest] = growth_at_rest;
  find_limit_cycles(servos, columns);
  const bool hunts = worst.result.verdict != Verdict::cannot_hunt;
  double largest = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const bool here = verdict[i] != Verdict::cannot_hunt;
    ASSERT_TRUE(hunts || !here);
    const std::vector<double>& of = hunts ? amplitude : growth_at_rest;
    if (here || !hunts) largest = std::max(largest, of[i]);
  }
  const double found = hunts ? worst.result.amplitude : worst.result.growth_at_rest;
  EXPECT_GT(found, largest);
  // It is what its values make.
  const NormalizedServo servo = drive_with(drive, values_of(worst)).servo;
  const LimitCycleAnalysis analysis = analyse_limit_cycles(servo);
  if (hunts) {
    EXPECT_NEAR(largest_stable(analysis)->amplitude, found, 1e-12 * found);
  } else {
    EXPECT_NEAR(analysis.growth_at_rest, found, 1e-12 * found);
  }
  for (std::size_t i = 0; i < drive.varied.size(); ++i) {
    EXPECT_TRUE(
        three_sigma_range_of(drive.varied[i].distribution).contains(worst.numbers[i].value));
  }
}

TEST(PropertyWorstCorner, IsNotBeatenAtRandom) {
  expect_unbeaten(widely_toleranced(), 61);
  expect_unbeaten(normalised_toleranced({{"servo.damping", UniformBetween{0.05, 0.4}},
                                         {"servo.inertia_ratio", UniformBetween{0.1, 10.0}},
                                         {"servo.friction_ratio", UniformBetween{0.1, 0.9}}}),
                  62);
  expect_unbeaten(normalised_toleranced({{"servo.inertia_ratio", UniformBetween{0.1, 10.0}},
                                         {"servo.backlash", Normal{0.3, 0.03}}}),
                  63);
}

TEST(PropertyWorstCorner, WithoutHuntingIsTheLargestGrowth) {
  expect_unbeaten(normalised_toleranced({{"servo.damping", UniformBetween{0.6, 0.9}},
                                         {"servo.inertia_ratio", UniformBetween{0.2, 8.0}},
                                         {"servo.friction_ratio", UniformBetween{0.4, 0.6}}}),
                  64);
}

TEST(OracleWorstCorner, OfBacklashIsTheWidest) {
  const WorstCorner worst =
      worst_corner(toleranced({{"gearbox.backlash", Normal{0.3, 0.01, 0.2, {}}}}));
  const double nominal = amplitude_in(closed_answer(sample_data_sheet()));
  ASSERT_EQ(worst.numbers.size(), 1U);
  EXPECT_EQ(worst.numbers[0].value, 0.3 + 3.0 * 0.01);
  EXPECT_EQ(worst.numbers[0].place, PlaceInRange::at_high);
  EXPECT_NEAR(worst.result.amplitude, nominal * 1.1, 1e-13);
}

TEST(OracleWorstCorner, MayLieInside) {
  // The growth at rest does not change when the shafts change places, so that along the inertia
  // ratio with equal friction it has its extreme at 1, and so along its logarithm.
  const WorstCorner worst =
      worst_corner(normalised_toleranced({{"servo.inertia_ratio", UniformBetween{0.1, 8.0}}}));
  double largest = 0.0;
  for (int i = 0; i <= 10'000; ++i) {
    const double ratio = 0.1 + 7.9 * i / 10'000;
    const NormalizedServo servo{
        .damping = 0.19, .inertia_ratio = ratio, .friction_ratio = 0.1, .backlash = 0.3};
    const LimitCycleAnalysis analysis = analyse_limit_cycles(servo);
    if (const LimitCycle* cycle = largest_stable(analysis)) {
      largest = std::max(largest, cycle->amplitude);
    }
  }
  EXPECT_GE(worst.result.amplitude, largest);
  EXPECT_LT(worst.result.amplitude, largest * (1.0 + 1e-6));
}

TEST(EdgeWorstCorner, OfLotsIsOneOfThem) {
  const WorstCorner worst = worst_corner(
      toleranced({{"gearbox.backlash", DiscreteLots{{{0.2, 1.0}, {0.4, 1.0}, {0.1, 1.0}}}},
                  {"load.inertia", ExactValue{0.5}}}));
  EXPECT_EQ(worst.numbers[0].value, 0.4);
  EXPECT_EQ(worst.numbers[1].place, PlaceInRange::fixed);
}

TEST(EdgeWorstCorner, NothingVariedIsTheNominalDrive) {
  const WorstCorner worst = worst_corner(toleranced({}));
  EXPECT_TRUE(worst.numbers.empty());
  EXPECT_NEAR(worst.result.amplitude, amplitude_in(closed_answer(sample_data_sheet())), 1e-13);
}

TEST(EdgeWorstCorner, AnyNumberOfThreadsGivesTheSameBits) {
  const WorstCorner one = worst_corner(widely_toleranced(), {}, {.threads = 1});
  const WorstCorner three = worst_corner(widely_toleranced(), {}, {.threads = 3});
  EXPECT_EQ(values_of(one), values_of(three));
  EXPECT_EQ(one.result.amplitude, three.result.amplitude);
}

TEST(WorstCorner, TellsWhatShareOfTheClimbsIsDone) {
  class Heard : public Progress {
   public:
    bool go_on(double share, std::size_t /*bytes*/) override {
      shares.insert(share);
      return true;
    }
    std::set<double> shares;
  };
  Heard heard;
  worst_corner(toleranced({{"gearbox.backlash", within_share(0.3, 0.5)}}),
               {.samples = 16, .starts = 2}, {}, heard);
  EXPECT_THAT(heard.shares, testing::ElementsAre(0.0, 0.25, 0.5, 0.75));
}

/// 4096 samples of a drive that bounces, eight at a time.
TEST(WorstCorner, AsksBetweenTheDrivesOfAClimb) {
  test::Stopping impatient(3);
  EXPECT_TRUE(worst_corner(toleranced({{"gearbox.backlash", within_share(0.3, 0.5)},
                                       {"contact.restitution", UniformBetween{0.1, 0.9}}}),
                           {}, {.threads = 1}, impatient)
                  .stopped);
  EXPECT_EQ(impatient.asked, 3);
}

TEST(EdgeWorstCorner, EveryFaultIsNamed) {
  try {
    worst_corner(toleranced({{"load.friction", Normal{0.0, 1.0}}}), {.starts = 0});
    FAIL();
  } catch (const InvalidInput& error) {
    EXPECT_STREQ(error.what(),
                 "load.friction = normal with mean 0 and standard deviation 1: must stay positive: "
                 "give it a min\nstarts = 0: must be at least 1");
  }
}

}  // namespace
}  // namespace gearlash::worst_corner_test
