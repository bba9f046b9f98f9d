// The widest tolerance on backlash: put back, it gives the yield.
#include "question/series/widest_backlash.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "question/change/target.hpp"
#include "toleranced_samples.hpp"

namespace gearlash::widest_backlash_test {
namespace {

Target at_most(double size) {
  Target target;
  target.require(Quantity::amplitude, {0.0, size});
  return target;
}

constexpr SamplePlan sampling{.points = 2048, .replicates = 16, .seed = 51};

/// Size of the sample for one rad of backlash.
double amplitude_per_backlash() { return amplitude_in(closed_answer(sample_data_sheet())) / 0.3; }

TEST(OracleWidestBacklash, OfBacklashAloneIsALine) {
  SCOPED_TRACE(sampling.seed);
  const double limit = 0.2;  // met up to backlash b = limit/S
  const double met = limit / amplitude_per_backlash();
  for (const double min : {0.0, 0.1}) {
    for (const double yield : {0.5, 0.9, 1.0}) {
      const auto found = widest_backlash(toleranced({}), {at_most(limit), yield, min}, sampling);
      ASSERT_TRUE(found);
      // (met − min)/(max − min) = yield, to one point.
      const double max = min + (met - min) / yield;
      EXPECT_NEAR(found->max, max, 2.0 * (max - min) / (yield * sampling.points));
      EXPECT_GE(found->yield.value, yield);
      EXPECT_LE(found->uncertainty.low, found->max);
      EXPECT_GE(found->uncertainty.high, found->max);
    }
  }
}

TEST(PropertyWidestBacklash, PutBackItGivesTheYieldOfTheSamePoints) {
  SCOPED_TRACE(sampling.seed);
  TolerancedDrive drive = widely_toleranced();
  for (const double yield : {0.6, 0.8, 0.95}) {
    const BacklashDemand demand{.target = at_most(0.1), .yield = yield, .min = 0.01};
    const auto found = widest_backlash(drive, demand, sampling);
    ASSERT_TRUE(found);
    const auto yield_with = [&](double max) {
      drive.varied[*place_of_backlash(drive)].distribution = UniformBetween{0.01, max};
      return study_tolerances(drive, sampling, {.target = demand.target}).yield;
    };
    const double one = 1.0 / static_cast<double>(sampling.samples());
    EXPECT_GE(yield_with(found->max * (1.0 - 1e-12)).value, yield);
    EXPECT_LT(yield_with(found->max * (1.0 + 1e-9)).value, yield + one);
    EXPECT_NEAR(yield_with(found->max).standard_error.value(), found->yield.standard_error.value(),
                one);
    EXPECT_LT(yield_with(found->max * 1.01).value, yield);
    EXPECT_NEAR(yield_with(found->uncertainty.low).value,
                yield + found->yield.standard_error.value(), 3.0 * one);
    EXPECT_NEAR(yield_with(found->uncertainty.high).value,
                yield - found->yield.standard_error.value(), 3.0 * one);
    // Bisection over the same points ends there.
    double met = 0.01;
    double unmet = 10.0;
    for (int i = 0; i < 30; ++i) {
      const double middle = 0.5 * (met + unmet);
      (yield_with(middle).value >= yield ? met : unmet) = middle;
    }
    EXPECT_NEAR(found->max, met, 1e-7);
  }
}

TEST(PropertyWidestBacklash, AnyNumberOfThreadsGivesTheSameBits) {
  const BacklashDemand demand{.target = at_most(0.1), .yield = 0.9, .min = {}};
  const auto one = widest_backlash(widely_toleranced(), demand, sampling, {.threads = 1});
  ASSERT_TRUE(one);
  for (const std::size_t threads : {2U, 3U}) {
    const auto other = widest_backlash(widely_toleranced(), demand, sampling, {.threads = threads});
    ASSERT_TRUE(other);
    EXPECT_EQ(one->max, other->max);
    EXPECT_EQ(one->uncertainty, other->uncertainty);
  }
}

TEST(EdgeWidestBacklash, IsNothingWhereZeroToleranceDoesNotReachTheYield) {
  const double limit = 0.09 * amplitude_per_backlash();
  EXPECT_FALSE(widest_backlash(toleranced({}), {at_most(limit), 0.5, 0.1}, sampling));
  // The nominal backlash of 0.3 rad is the lowest where no other is given.
  EXPECT_FALSE(widest_backlash(toleranced({}), {at_most(limit), 0.5, {}}, sampling));
  Target fast;
  fast.require(Quantity::frequency, {1e3, Target::infinity});
  EXPECT_FALSE(widest_backlash(toleranced({}), {fast, 0.5, 0.1}, sampling));
}

TEST(EdgeWidestBacklash, IsZeroWhereOnlyZeroBacklashDoes) {
  Target quiet;
  quiet.no_hunting = true;
  const auto found = widest_backlash(toleranced({}), {quiet, 0.5, 0.0}, sampling);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->max, 0.0);
  EXPECT_FALSE(widest_backlash(toleranced({}), {quiet, 0.5, 1e-6}, sampling));
}

TEST(EdgeWidestBacklash, HasNoLimitWhereBacklashDoesNotMatter) {
  Target any_amplitude;
  any_amplitude.require(Quantity::frequency, {0.0, 1e3});
  const auto found = widest_backlash(toleranced({}), {any_amplitude, 0.99, {}}, sampling);
  ASSERT_TRUE(found);
  EXPECT_TRUE(std::isinf(found->max));
  EXPECT_EQ(found->min, 0.3);
}

TEST(EdgeWidestBacklash, TheLowestValueIsThatOfItsDistribution) {
  const auto found = widest_backlash(toleranced({{"gearbox.backlash", within_share(0.3, 0.5)}}),
                                     {at_most(0.2), 0.9, {}}, sampling);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->min, 0.15);
}

TEST(EdgeWidestBacklash, EveryFaultIsNamed) {
  BacklashDemand demand{.target = at_most(1.0), .yield = 0.0, .min = -1.0};
  demand.target.require(Quantity::amplitude, {0.5, Target::infinity});
  std::vector<std::string> lines;
  for (const Fault& fault : faults(demand)) lines.push_back(to_string(fault));
  EXPECT_THAT(lines,
              testing::ElementsAre(
                  "target = amplitude >= 0.5: must have no lower limit of amplitude: more backlash "
                  "would then be better",
                  "yield = 0: must be above 0 and at most 1",
                  "min = -1 rad: must be zero or positive, and finite"));
  EXPECT_THROW((void)widest_backlash(toleranced({}), demand, sampling), InvalidInput);
}

}  // namespace
}  // namespace gearlash::widest_backlash_test
