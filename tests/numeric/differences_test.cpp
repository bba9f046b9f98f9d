// Derivatives by differences, against functions whose derivatives are known.
#include "numeric/differences.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/special_numbers.hpp"
#include "base/traced_draws.hpp"

namespace gearlash::differences_test {
namespace {

using Function = double (*)(double);

Difference difference_of(const std::function<double(double)>& function, double at,
                         DifferenceSteps steps = {}) {
  return differences([&](double x) { return std::vector{function(x)}; }, at, steps).front();
}

TEST(OracleDifferences, OfSmoothFunctionsKnowTheirError) {
  struct Known {
    Function value, slope;
  };
  const Known all[] = {
      {[](double x) { return std::exp(x); }, [](double x) { return std::exp(x); }},
      {[](double x) { return std::sin(3.0 * x); },
       [](double x) { return 3.0 * std::cos(3.0 * x); }},
      {[](double x) { return std::log(x); }, [](double x) { return 1.0 / x; }},
      {[](double x) { return 1.0 / x; }, [](double x) { return -1.0 / (x * x); }},
      {[](double x) { return std::sqrt(x); }, [](double x) { return 0.5 / std::sqrt(x); }}};
  TracedDraws draws(2401);
  for (int i = 0; i < 200; ++i) {
    const double x = draws.log_uniform(0.1, 10.0);
    for (const Known& known : all) {
      const auto [slope, error] = difference_of(known.value, x, {.unit = x});
      const double exact = known.slope(x);
      const double size = std::max(std::abs(exact), std::abs(known.value(x) / x));
      EXPECT_LE(std::abs(slope - exact), 2e-12 * size);
      EXPECT_LE(error, 1e-11 * size);
    }
  }
}

/// Log(1/x) next to where it ends, as periods are next to the boundary of hunting: the nearest
/// steps count.
TEST(OracleDifferences, FindTheirStepBesideASingularity) {
  for (const double distance : {1e-2, 1e-3, 1e-4, 1e-5}) {
    const double here = 1.0 + distance;
    const auto value = [](double x) { return x > 1.0 ? -std::log(x - 1.0) : not_a_number; };
    const auto [slope, error] = difference_of(value, here);
    EXPECT_NEAR(slope, -1.0 / (here - 1.0), 1e-8 / distance);
    EXPECT_LE(std::abs(slope + 1.0 / (here - 1.0)), error + 1e-10 / distance);
  }
}

TEST(OracleDifferences, StopBeforeAKinkAndAJumpNearBy) {
  for (const double distance : {1e-2, 1e-3, 1e-4}) {
    const double place = 1.0 + distance;
    const auto kinked = [&](double x) { return std::exp(x) + std::abs(x - place); };
    EXPECT_NEAR(difference_of(kinked, 1.0).slope, std::exp(1.0) - 1.0, 1e-10);
    const auto jumping = [&](double x) { return std::exp(x) + (x > place ? 0.5 : 0.0); };
    EXPECT_NEAR(difference_of(jumping, 1.0).slope, std::exp(1.0), 1e-10);
    const auto ending = [&](double x) { return x > place ? not_a_number : std::exp(x); };
    EXPECT_NEAR(difference_of(ending, 1.0).slope, std::exp(1.0), 1e-10);
  }
}

TEST(EdgeDifferences, ThereAreNoneAtAKinkAJumpOrASteepEdge) {
  const double at = 1.0;
  EXPECT_TRUE(
      std::isnan(difference_of([](double x) { return 3.0 + std::abs(x - 1.0); }, at).slope));
  EXPECT_TRUE(std::isnan(
      difference_of([](double x) { return std::exp(x) + (x > 1.0 ? 1e-4 * (x - 1.0) : 0.0); }, at)
          .slope));
  EXPECT_TRUE(std::isnan(difference_of([](double x) { return x > 1.0 ? 2.0 : 1.0; }, at).slope));
  EXPECT_TRUE(std::isnan(
      difference_of([](double x) { return 1.0 + std::sqrt(std::max(x - 1.0, 0.0)); }, at).slope));
  EXPECT_TRUE(std::isnan(
      difference_of([](double x) { return x < 1.0 ? not_a_number : std::sqrt(x - 1.0); }, at)
          .slope));
  EXPECT_TRUE(std::isnan(difference_of([](double) { return not_a_number; }, at).slope));
  EXPECT_TRUE(std::isnan(difference_of([](double) { return infinity; }, at).slope));
  EXPECT_TRUE(
      std::isnan(difference_of([](double x) { return x == 1.0 ? 1.0 : not_a_number; }, at).slope));
}

TEST(EdgeDifferences, AtAnEndAreThoseOfTheOneSide) {
  const auto from_above = [](double x) { return x < 0.0 ? not_a_number : std::exp(x) + x * x * x; };
  EXPECT_NEAR(difference_of(from_above, 0.0).slope, 1.0, 1e-11);
  const auto from_below = [](double x) { return x > 1.0 ? not_a_number : std::exp(x); };
  EXPECT_NEAR(difference_of(from_below, 1.0).slope, std::exp(1.0), 1e-10);
}

TEST(EdgeDifferences, OfAConstantAre0AndOfSeveralNumbersEachItsOwn) {
  const auto found = differences(
      [](double x) {
        return x > 2.0 ? std::vector<double>{}
                       : std::vector{7.0, 2.0 * x, std::abs(x - 1.0), x * x};
      },
      1.0);
  ASSERT_EQ(found.size(), 4U);
  EXPECT_EQ(found[0].slope, 0.0);
  EXPECT_NEAR(found[1].slope, 2.0, 1e-13);
  EXPECT_TRUE(std::isnan(found[2].slope));
  EXPECT_NEAR(found[3].slope, 2.0, 1e-12);
}

/// Where the number is about 0 its error is a share of the size that is given.
TEST(EdgeDifferences, OfANumberAboutNoughtAreAsGoodAsItsSize) {
  const auto noisy = [](double x) { return 1e-16 * std::sin(1e9 * x); };
  EXPECT_TRUE(std::isnan(difference_of(noisy, 1.0).slope));
  EXPECT_NEAR(difference_of(noisy, 1.0, {.sizes = {1.0}}).slope, 0.0, 1e-10);
}

}  // namespace
}  // namespace gearlash::differences_test
