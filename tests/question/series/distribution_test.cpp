// Distributions against closed forms and against their own quantiles.
#include "question/series/distribution.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>

namespace gearlash::distribution_test {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();
constexpr double infinity = std::numeric_limits<double>::infinity();

double normal_share(double x) { return 0.5 * std::erfc(-x / std::sqrt(2.0)); }

TEST(OracleDistribution, AnExactValueIsEveryQuantile) {
  const Distribution exact = ExactValue{0.1};
  for (const double u : {0x1p-53, 0.5, 1.0 - 0x1p-53}) EXPECT_EQ(quantile(exact, u), 0.1);
  EXPECT_EQ(standard_deviation_of(exact), 0.0);
  EXPECT_EQ(range_of_draws(exact), (Bounds{0.1, 0.1}));
}

TEST(OracleDistribution, UniformIsLinear) {
  const Distribution between = UniformBetween{2.0, 6.0};
  EXPECT_EQ(quantile(between, 0.25), 3.0);
  EXPECT_EQ(mean_of(between), 4.0);
  EXPECT_NEAR(standard_deviation_of(between), 4.0 / std::sqrt(12.0), 4.0 * epsilon);
  const Distribution about = within_share(4.0, 0.5);
  EXPECT_EQ(support_of(about), (Bounds{2.0, 6.0}));
  EXPECT_NEAR(standard_deviation_of(about), standard_deviation_of(between), 4.0 * epsilon);
  for (const double u : {0.1, 0.3, 0.9}) EXPECT_EQ(quantile(about, u), quantile(between, u));
}

TEST(OracleDistribution, QuantilesOfANormalGiveTheirShareBack) {
  const Distribution normal = Normal{3.0, 0.5};
  for (const double u : {1e-12, 0.05, 0.5, 0.95, 0.999}) {
    EXPECT_NEAR(normal_share((quantile(normal, u) - 3.0) / 0.5), u, 1e-13 * u + 4.0 * epsilon);
  }
  EXPECT_EQ(support_of(normal), (Bounds{-infinity, infinity}));
  EXPECT_EQ(three_sigma_range_of(normal), (Bounds{1.5, 4.5}));
  EXPECT_NEAR(range_of_draws(normal).low, 3.0 - 0.5 * 8.2095, 1e-4);
}

TEST(OracleDistribution, ATruncatedNormalHasTheMomentsOfItsDensity) {
  using boost::math::quadrature::gauss_kronrod;
  for (const Normal& normal :
       {Normal{1.0, 0.5, 0.2, 1.3}, Normal{1.0, 0.5, 2.3, 2.4}, Normal{1.0, 0.5, 0.8, 1.29},
        Normal{1.0, 0.5, 0.99999, 1.00002}, Normal{1.0, 0.5, -0.4, -0.3}}) {
    SCOPED_TRACE(text_of(normal));
    const auto moment = [&](double origin, int power) {
      return gauss_kronrod<double, 61>::integrate(
          [&](double x) {
            const double z = (x - normal.mean) / normal.standard_deviation;
            return std::pow(x - origin, power) * std::exp(-0.5 * z * z);
          },
          *normal.min, *normal.max, 0);
    };
    const double mean = moment(normal.mean, 1) / moment(0.0, 0) + normal.mean;
    const double spread = std::sqrt(moment(mean, 2) / moment(0.0, 0));
    EXPECT_NEAR(mean_of(normal), mean, 1e-14);
    EXPECT_NEAR(standard_deviation_of(normal), spread, 1e-10 * spread);
    const QuantileFunction value_at(normal);
    for (const double u : {0x1p-53, 0.01, 0.4, 0.99, 1.0 - 0x1p-53}) {
      const double value = value_at(u);
      EXPECT_GE(value, *normal.min);
      EXPECT_LE(value, *normal.max);
      const auto share = [&](double x) {
        return normal_share((x - normal.mean) / normal.standard_deviation);
      };
      const double expected = share(*normal.min) + u * (share(*normal.max) - share(*normal.min));
      EXPECT_NEAR(share(value), expected, 4.0 * epsilon);
    }
  }
}

TEST(OracleDistribution, ATruncatedNormalOnOneSide) {
  const Distribution half = Normal{0.0, 1.0, 0.0, {}};
  EXPECT_NEAR(mean_of(half), std::sqrt(2.0 / std::acos(-1.0)), 4.0 * epsilon);
  EXPECT_NEAR(standard_deviation_of(half), std::sqrt(1.0 - 2.0 / std::acos(-1.0)), 4.0 * epsilon);
  EXPECT_EQ(three_sigma_range_of(half), (Bounds{0.0, 3.0}));
  EXPECT_GE(range_of_draws(half).low, 0.0);
  EXPECT_TRUE(std::isfinite(range_of_draws(half).high));
}

TEST(OracleDistribution, LotsAreAsLikelyAsTheirWeights) {
  const Distribution lots = DiscreteLots{{{3.0, 1.0}, {1.0, 2.0}, {2.0, 1.0}}};
  EXPECT_EQ(quantile(lots, 0.49), 1.0);
  EXPECT_EQ(quantile(lots, 0.51), 2.0);
  EXPECT_EQ(quantile(lots, 0.76), 3.0);
  EXPECT_EQ(quantile(lots, 1.0 - 0x1p-53), 3.0);
  EXPECT_EQ(mean_of(lots), 1.75);
  EXPECT_NEAR(standard_deviation_of(lots), std::sqrt(2.75 / 4.0), 4.0 * epsilon);
  EXPECT_EQ(support_of(lots), (Bounds{1.0, 3.0}));
}

std::vector<std::string> faults_of(const Distribution& distribution) {
  std::vector<std::string> lines;
  for (const Fault& fault : faults(distribution, "load.inertia")) {
    lines.push_back(to_string(fault));
  }
  return lines;
}

TEST(EdgeDistribution, EveryFaultIsNamed) {
  using testing::ElementsAre;
  using testing::IsEmpty;
  EXPECT_THAT(faults_of(ExactValue{infinity}),
              ElementsAre("load.inertia.value = inf: must be finite"));
  EXPECT_THAT(faults_of(UniformBetween{2.0, 1.0}),
              ElementsAre("load.inertia.max = 1: must be at least min, 2 in SI units"));
  EXPECT_THAT(faults_of(within_share(2.0, -0.5)),
              ElementsAre("load.inertia.tolerance = -1: must be zero or positive, and finite"));
  EXPECT_THAT(faults_of(Normal{infinity, 0.0}),
              ElementsAre("load.inertia.mean = inf: must be finite",
                          "load.inertia.standard_deviation = 0: must be positive and finite"));
  EXPECT_THAT(faults_of(Normal{1.0, 0.1, 1.2, 1.1}),
              ElementsAre("load.inertia.max = 1.1: must be above min, 1.2"));
  EXPECT_THAT(faults_of(Normal{1.0, 0.5, 3.0, {}}),
              ElementsAre("load.inertia.min = 3: must be below mean + 3 standard deviations, 2.5: "
                          "almost no samples remain"));
  EXPECT_THAT(faults_of(Normal{1.0, 0.5, {}, -1.0}),
              ElementsAre("load.inertia.max = -1: must be above mean - 3 standard deviations, "
                          "-0.5: almost no samples remain"));
  EXPECT_THAT(
      faults_of(DiscreteLots{}),
      ElementsAre("load.inertia.lots is missing: must be at least one value with a weight"));
  EXPECT_THAT(faults_of(DiscreteLots{{{1.0, 0.0}, {infinity, -1.0}}}),
              ElementsAre("load.inertia.lots[0].weight = 0: must be positive and finite",
                          "load.inertia.lots[1].value = inf: must be finite",
                          "load.inertia.lots[1].weight = -1: must be positive and finite"));
  EXPECT_THAT(faults_of(Normal{1.0, 0.5, 0.5, 2.0}), IsEmpty());
  EXPECT_THAT(faults_of(UniformBetween{1.0, 1.0}), IsEmpty());
}

}  // namespace
}  // namespace gearlash::distribution_test
