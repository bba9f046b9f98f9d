// Studies of tolerances against closed cases.
#include "question/series/tolerance_study.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>

#include "base/seeded_draws.hpp"
#include "base/stopping.hpp"
#include "question/change/target.hpp"
#include "question/change/values.hpp"
#include "question/faults_of.hpp"
#include "question/series/sample_plan.hpp"
#include "toleranced_samples.hpp"

namespace gearlash::tolerance_study_test {
namespace {

Target at_most(double size) {
  Target target;
  target.require(Quantity::amplitude, {0.0, size});
  return target;
}
Target no_hunting() {
  Target target;
  target.no_hunting = true;
  return target;
}

/// Of the sample with one rad of backlash.
double amplitude_per_backlash(double load_friction) {
  Drive drive = sample_data_sheet();
  drive.gearbox.backlash = 1.0;
  drive.load.friction.viscous = load_friction;
  return amplitude_in(closed_answer(drive));
}

constexpr SamplePlan fixed_sampling{.points = 4096, .replicates = 16, .seed = 41};

class OracleToleranceOfBacklash : public testing::TestWithParam<Distribution> {};

TEST_P(OracleToleranceOfBacklash, SizesAreThoseOfTheBacklashScaled) {
  SCOPED_TRACE(fixed_sampling.seed);
  const Distribution& backlash = GetParam();
  SCOPED_TRACE(text_of(backlash));
  const double scale = amplitude_per_backlash(0.038);
  const StudyQuestions questions{.target = at_most(scale * quantile(backlash, 0.8))};
  const ToleranceStudy study =
      study_tolerances(toleranced({{"gearbox.backlash", backlash}}), fixed_sampling, questions);
  EXPECT_EQ(study.hunting.value, 1.0);
  EXPECT_EQ(study.refused, 0U);
  EXPECT_EQ(study.unknown_amplitudes, 0U);
  const double one = 1.0 / static_cast<double>(fixed_sampling.points);
  EXPECT_NEAR(study.yield.value, 0.8, one);
  // Each replicate has one point in each of `points` equal parts of the cube of one dimension, so
  // that its share below any value is true to one point.
  for (const QuantileEstimate& found : study.amplitude) {
    EXPECT_GE(found.value->value, scale * quantile(backlash, found.share - one));
    EXPECT_LE(found.value->value, scale * quantile(backlash, found.share + one));
    EXPECT_NEAR(found.value->value, scale * quantile(backlash, found.share),
                6.0 * found.value->standard_error.value());
  }
  EXPECT_NEAR(study.mean_amplitude->value, scale * mean_of(backlash),
              one * scale * standard_deviation_of(backlash));
  const SensitivityStudy indices =
      study_sensitivities(toleranced({{"gearbox.backlash", backlash}}), fixed_sampling);
  const double variance = std::pow(scale * standard_deviation_of(backlash), 2);
  EXPECT_NEAR(indices.amplitude_variance.value, variance, 1e-2 * variance);
  EXPECT_NEAR(indices.numbers[0].of_amplitude->first_order.value, 1.0, 0.02);
  EXPECT_NEAR(indices.numbers[0].of_amplitude->total.value, 1.0, 0.02);
  EXPECT_FALSE(indices.numbers[0].of_hunting);
}

INSTANTIATE_TEST_SUITE_P(Kinds, OracleToleranceOfBacklash,
                         testing::Values(Distribution(UniformBetween{0.05, 0.1}),
                                         Distribution(within_share(0.3, 0.1)),
                                         Distribution(UniformBetween{0.0, 0.2}),
                                         Distribution(Normal{0.3, 0.02}),
                                         Distribution(Normal{0.3, 0.2, 0.0, 0.7})));

TEST(OracleToleranceStudy, OneThresholdDecidesHowManyHunt) {
  const Drive drive = sample_data_sheet();
  const FeasibleValues quiet = values(drive, "load.friction", no_hunting());
  ASSERT_FALSE(quiet.intervals.empty());
  const double threshold = quiet.intervals.front().low;
  ASSERT_GT(threshold, 0.038);
  SCOPED_TRACE(fixed_sampling.seed);
  for (const double share : {0.013, 0.5, 0.77}) {
    const double width = 0.5 * threshold;
    const UniformBetween friction{threshold - share * width, threshold + (1.0 - share) * width};
    ASSERT_GE(quiet.intervals.front().high, friction.max);
    const TolerancedDrive varied = toleranced({{"load.friction", friction}});
    const ToleranceStudy study = study_tolerances(
        varied, fixed_sampling, {.target = no_hunting(), .shares = {0.5 * share, 0.99}});
    const double one = 1.0 / static_cast<double>(fixed_sampling.points);
    EXPECT_NEAR(study.hunting.value, share, one);
    EXPECT_NEAR(study.hunting.value + study.yield.value, 1.0, 1e-15);
    EXPECT_LT(study.hunting.standard_error.value(), one);
    EXPECT_EQ(study.histogram.quiet,
              static_cast<std::size_t>(
                  std::lround(study.yield.value * static_cast<double>(fixed_sampling.samples()))));
    const SensitivityStudy indices = study_sensitivities(varied, fixed_sampling);
    EXPECT_NEAR(indices.hunting_variance.value, share * (1.0 - share), 2.0 * one);
    EXPECT_NEAR(indices.numbers[0].of_hunting->first_order.value, 1.0,
                6.0 * indices.numbers[0].of_hunting->first_order.standard_error.value() + 1e-3);
    EXPECT_NEAR(indices.numbers[0].of_hunting->total.value, 1.0,
                6.0 * indices.numbers[0].of_hunting->total.standard_error.value() + 1e-3);
  }
}

/// Size = b S(F_L), all hunting: moments of the factors.
struct ProductCase {
  UniformBetween backlash{0.1, 0.3};
  UniformBetween friction{0.01, 0.06};

  TolerancedDrive drive() const {
    return toleranced({{"gearbox.backlash", backlash}, {"load.friction", friction}});
  }
  double moment(int power) const {
    using boost::math::quadrature::gauss;
    return gauss<double, 30>::integrate(
               [&](double f) { return std::pow(amplitude_per_backlash(f), power); }, friction.min,
               friction.max) /
           (friction.max - friction.min);
  }
};

TEST(OracleToleranceStudy, IndicesOfAProductAreThoseOfItsFactors) {
  const ProductCase product;
  const double mean_b = mean_of(product.backlash);
  const double variance_b = std::pow(standard_deviation_of(product.backlash), 2);
  const double mean_s = product.moment(1);
  const double variance_s = product.moment(2) - mean_s * mean_s;
  const double of_b = variance_b * mean_s * mean_s;
  const double of_s = variance_s * mean_b * mean_b;
  const double sum_of_both = variance_b * variance_s;
  const double all = of_b + of_s + sum_of_both;
  const SamplePlan sampling{.points = 8192, .replicates = 16, .seed = 42};
  SCOPED_TRACE(sampling.seed);
  const SensitivityStudy found = study_sensitivities(product.drive(), sampling);
  const auto expect = [](const Estimate& estimate, double value) {
    EXPECT_NEAR(estimate.value, value, 6.0 * estimate.standard_error.value() + 1e-9);
    EXPECT_LT(estimate.standard_error.value(), 2e-3);
  };
  expect(found.amplitude_variance, all);
  expect(found.numbers[0].of_amplitude->first_order, of_b / all);
  expect(found.numbers[1].of_amplitude->first_order, of_s / all);
  expect(found.numbers[0].of_amplitude->total, (of_b + sum_of_both) / all);
  expect(found.numbers[1].of_amplitude->total, (of_s + sum_of_both) / all);
}

/// Slope of the straight line through points, by least squares.
double slope_of(const std::vector<double>& x, const std::vector<double>& y) {
  const auto count = static_cast<double>(x.size());
  double sx = 0.0;
  double sy = 0.0;
  double sxx = 0.0;
  double sxy = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    sx += x[i];
    sy += y[i];
    sxx += x[i] * x[i];
    sxy += x[i] * y[i];
  }
  return (count * sxy - sx * sy) / (count * sxx - sx * sx);
}

TEST(OracleToleranceStudy, TheErrorFallsFasterThanAtRandom) {
  const ProductCase product;
  const double exact = mean_of(product.backlash) * product.moment(1);
  std::vector<double> log_points;
  std::vector<double> log_error;
  std::vector<double> log_stated;
  constexpr std::uint64_t seeds = 16;  // one error alone is near 0 by chance now and then
  SCOPED_TRACE("seeds 100 to 115");
  for (std::size_t points = 32; points <= 16384; points *= 2) {
    double squares = 0.0;
    double stated_squares = 0.0;
    for (std::uint64_t seed = 100; seed < 100 + seeds; ++seed) {
      const SamplePlan sampling{.points = points, .replicates = 16, .seed = seed};
      const Estimate mean = study_tolerances(product.drive(), sampling).mean_amplitude.value();
      EXPECT_NEAR(mean.value, exact, 6.0 * mean.standard_error.value()) << points << " " << seed;
      squares += std::pow(mean.value - exact, 2);
      stated_squares += std::pow(mean.standard_error.value(), 2);
    }
    log_points.push_back(std::log(static_cast<double>(points)));
    log_error.push_back(0.5 * std::log(squares));
    log_stated.push_back(0.5 * std::log(stated_squares));
    EXPECT_NEAR(log_error.back(), log_stated.back(), std::log(2.0));  // the bar is the error
  }
  const double slope = slope_of(log_points, log_error);
  const double stated_slope = slope_of(log_points, log_stated);
  RecordProperty("slope_of_error", std::to_string(slope));
  EXPECT_LE(slope, -0.7);
  EXPECT_LE(stated_slope, -0.7);
}

void expect_same(const Estimate& a, const Estimate& b) {
  EXPECT_EQ(a.value, b.value);
  EXPECT_EQ(a.standard_error, b.standard_error);
}
void expect_same(const std::optional<Estimate>& a, const std::optional<Estimate>& b) {
  ASSERT_EQ(a.has_value(), b.has_value());
  if (a) expect_same(*a, *b);
}
void expect_same(const std::vector<QuantileEstimate>& a, const std::vector<QuantileEstimate>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) expect_same(a[i].value, b[i].value);
}

TEST(PropertyToleranceStudy, AnyNumberOfThreadsGivesTheSameBits) {
  const SamplePlan sampling{.points = 3000, .replicates = 5, .seed = 44};
  SCOPED_TRACE(sampling.seed);
  const TolerancedDrive drive = widely_toleranced();
  const StudyQuestions questions{.target = at_most(0.1)};
  const ToleranceStudy one = study_tolerances(drive, sampling, questions, {.threads = 1});
  const SensitivityStudy one_index = study_sensitivities(drive, sampling, {}, {.threads = 1});
  for (const std::size_t threads : {2U, 3U}) {
    const ToleranceStudy other = study_tolerances(drive, sampling, questions, {.threads = threads});
    expect_same(one.hunting, other.hunting);
    expect_same(one.yield, other.yield);
    expect_same(one.mean_amplitude, other.mean_amplitude);
    expect_same(one.amplitude, other.amplitude);
    expect_same(one.amplitude_of_hunting, other.amplitude_of_hunting);
    expect_same(one.frequency, other.frequency);
    EXPECT_EQ(one.histogram.edges, other.histogram.edges);
    EXPECT_EQ(one.histogram.counts, other.histogram.counts);
    const SensitivityStudy index = study_sensitivities(drive, sampling, {}, {.threads = threads});
    for (std::size_t i = 0; i < drive.varied.size(); ++i) {
      expect_same(one_index.numbers[i].of_amplitude->first_order,
                  index.numbers[i].of_amplitude->first_order);
      expect_same(one_index.numbers[i].of_hunting->total, index.numbers[i].of_hunting->total);
    }
  }
}

TEST(PropertyToleranceStudy, APlainCountOfDrivesAgrees) {
  const SamplePlan sampling{.points = 2048, .replicates = 8, .seed = 45};
  SCOPED_TRACE(sampling.seed);
  const TolerancedDrive drive = widely_toleranced();
  const Target target = at_most(0.1);
  const ToleranceStudy study = study_tolerances(drive, sampling, {.target = target});
  // Plain random draws, one by one.
  constexpr std::size_t draws = 20'000;
  SeededDraws random(46);
  double hunting = 0.0;
  double meeting = 0.0;
  std::vector<double> sizes;
  for (std::size_t i = 0; i < draws; ++i) {
    std::vector<double> values;
    for (const ParameterTolerance& varied : drive.varied) {
      values.push_back(quantile(varied.distribution, random.uniform(0x1p-53, 1.0)));
    }
    const ProportionalServo drawn = drive_with(drive, values);
    const LimitCycleAnalysis analysis = analyse_limit_cycles(drawn.servo);
    const LimitCycle* cycle = largest_stable(analysis);
    sizes.push_back(cycle != nullptr ? cycle->amplitude : 0.0);
    if (cycle != nullptr) hunting += 1.0;
    if (sizes.back() <= 0.1) meeting += 1.0;
  }
  const auto spread = [&](double p) { return std::sqrt(p * (1.0 - p) / draws); };
  const double p = study.hunting.value;
  const double y = study.yield.value;
  EXPECT_GT(p, 0.1);
  EXPECT_LT(p, 0.9);
  EXPECT_NEAR(hunting / draws, p, 5.0 * (spread(p) + study.hunting.standard_error.value()));
  EXPECT_NEAR(meeting / draws, y, 5.0 * (spread(y) + study.yield.standard_error.value()));
  std::sort(sizes.begin(), sizes.end());
  const auto share_below = [&](double size) {
    return static_cast<double>(std::upper_bound(sizes.begin(), sizes.end(), size) - sizes.begin()) /
           draws;
  };
  for (const QuantileEstimate& found : study.amplitude) {
    if (found.value->value == 0.0) continue;
    EXPECT_NEAR(share_below(found.value->value), found.share, 6.0 * spread(found.share) + 1e-3);
  }
  std::size_t counted = study.histogram.quiet + study.histogram.unknown;
  for (const std::size_t count : study.histogram.counts) counted += count;
  EXPECT_EQ(counted, sampling.samples());
}

// ---- what is kept -------------------------------------------------------------------------------

/// Hazen's quantile of values in any order: of n values the k-th, counted from 1, has the share
/// (k − ½)/n.
double plain_quantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  const auto count = static_cast<double>(values.size());
  if (share <= 0.5 / count) return values.front();
  if (share >= 1.0 - 0.5 / count) return values.back();
  std::size_t k = 0;
  while ((static_cast<double>(k) + 1.5) / count <= share) ++k;
  const double way = share * count - 0.5 - static_cast<double>(k);
  return way == 0.0 ? values[k] : values[k] + way * (values[k + 1] - values[k]);
}

/// Values of each replicate.
using Replicates = std::vector<std::vector<double>>;

void expect_quantiles(const std::vector<QuantileEstimate>& found, const Replicates& replicates) {
  std::vector<double> all;
  for (const auto& one : replicates) all.insert(all.end(), one.begin(), one.end());
  for (const QuantileEstimate& quantile : found) {
    SCOPED_TRACE(quantile.share);
    constexpr double rounding = 1e-15;  // of the interpolation alone
    const double value = plain_quantile(all, quantile.share);
    EXPECT_NEAR(quantile.value->value, value, rounding * value);
    double sum = 0.0;
    double squares = 0.0;
    for (const auto& one : replicates) {
      const double of_replicate = plain_quantile(one, quantile.share);
      sum += of_replicate;
      squares += of_replicate * of_replicate;
    }
    const auto count = static_cast<double>(replicates.size());
    const double error =
        std::sqrt(std::max(0.0, squares - sum * sum / count) / (count * (count - 1.0)));
    // Of the difference of squares: its rounding is magnified where the scatter is small.
    EXPECT_NEAR(quantile.value->standard_error.value(), error, 1e-7 * value);
  }
}

TEST(OracleToleranceStudy, QuantilesAndStepsAreThoseOfAllSamplesSorted) {
  const SamplePlan sampling{.points = 1500, .replicates = 8, .seed = 46};
  SCOPED_TRACE(sampling.seed);
  const TolerancedDrive drive = widely_toleranced();
  const StudyQuestions questions{.target = at_most(0.1),
                                 .shares = {0.0, 0.02, 0.3, 0.5, 0.9, 0.999, 1.0}};
  const ToleranceStudy study = study_tolerances(drive, sampling, questions);
  Replicates amplitude(sampling.replicates);
  Replicates of_hunting(sampling.replicates);
  Replicates frequency(sampling.replicates);
  Replicates error(sampling.replicates);
  std::vector<double> positive;
  double sum = 0.0;
  double hunting = 0.0;
  double meeting = 0.0;
  // In parts, as they are dealt out to several machines.
  constexpr std::size_t part = 1000;
  for (std::size_t first = 0; first < sampling.samples(); first += part) {
    const auto results =
        answer_samples(drive, sampling, questions, first, part, {}, no_progress()).value();
    for (std::size_t i = 0; i < part; ++i) {
      const detail::SampleResult& one = results[i];
      const std::size_t replicate = (first + i) / sampling.points;
      amplitude[replicate].push_back(one.amplitude);
      if (one.amplitude > 0.0) of_hunting[replicate].push_back(one.amplitude);
      if (one.amplitude > 0.0) positive.push_back(one.amplitude);
      if (!std::isnan(one.frequency)) frequency[replicate].push_back(one.frequency);
      error[replicate].push_back(one.error);
      EXPECT_EQ(one.error, one.amplitude);  // symmetric about the reference, or at rest on it
      sum += one.amplitude;
      hunting += one.hunts() ? 1.0 : 0.0;
      meeting += one.meets ? 1.0 : 0.0;
    }
  }
  expect_quantiles(study.amplitude, amplitude);
  expect_quantiles(study.amplitude_of_hunting, of_hunting);
  expect_quantiles(study.frequency, frequency);
  expect_quantiles(study.error, error);
  const auto samples = static_cast<double>(sampling.samples());
  EXPECT_EQ(study.hunting.value, hunting / samples);
  EXPECT_EQ(study.yield.value, meeting / samples);
  EXPECT_NEAR(study.mean_amplitude->value, sum / samples, 1e-12 * sum / samples);
  const std::vector<double>& edges = study.histogram.edges;
  ASSERT_EQ(edges.size(), 41U);
  EXPECT_EQ(edges.front(), *std::min_element(positive.begin(), positive.end()));
  EXPECT_EQ(edges.back(), *std::max_element(positive.begin(), positive.end()));
  std::vector<std::size_t> counts(40);
  for (const double size : positive) {
    const auto above = std::upper_bound(edges.begin() + 1, edges.end() - 1, size);
    ++counts[static_cast<std::size_t>(above - edges.begin()) - 1];
  }
  EXPECT_EQ(study.histogram.counts, counts);
  EXPECT_EQ(study.histogram.quiet, sampling.samples() - positive.size());
}

TEST(PropertyToleranceStudy, IndicesAreSharesOfOneWhole) {
  const SamplePlan sampling{.points = 4096, .replicates = 8, .seed = 47};
  SCOPED_TRACE(sampling.seed);
  const SensitivityStudy study = study_sensitivities(widely_toleranced(), sampling);
  double first_orders = 0.0;
  for (const NumberSensitivity& number : study.numbers) {
    for (const auto& indices : {number.of_amplitude, number.of_hunting}) {
      ASSERT_TRUE(indices);
      const auto& [first_order, total] = *indices;
      const double doubt =
          6.0 * (first_order.standard_error.value() + total.standard_error.value());
      EXPECT_GE(first_order.value, -doubt);
      EXPECT_LE(first_order.value, total.value + doubt) << number.path;
    }
    first_orders += number.of_amplitude->first_order.value;
  }
  EXPECT_GT(first_orders, 0.2);
  EXPECT_LT(first_orders, 1.05);
  EXPECT_EQ(study.left_out, 0U);
}

TEST(EdgeToleranceStudy, AnExactNumberHasNoInfluence) {
  const SensitivityStudy study = study_sensitivities(
      toleranced({{"gearbox.backlash", within_share(0.3, 0.1)}, {"load.inertia", ExactValue{0.6}}}),
      fixed_sampling);
  EXPECT_EQ(study.numbers[1].of_amplitude->first_order.value, 0.0);
  EXPECT_EQ(study.numbers[1].of_amplitude->total.value, 0.0);
}

TEST(EdgeToleranceStudy, WithoutVariedNumbersAllPiecesAreAlike) {
  const ToleranceStudy study = study_tolerances(toleranced({}), {.points = 4, .replicates = 2});
  const Answer nominal = closed_answer(sample_data_sheet());
  EXPECT_EQ(study.hunting.value, 1.0);
  EXPECT_NEAR(study.amplitude.front().value->value, *nominal.value(Quantity::amplitude), 1e-13);
  EXPECT_NEAR(study.frequency.back().value->value, *nominal.value(Quantity::frequency), 1e-13);
  EXPECT_EQ(study.amplitude.front().value->standard_error, 0.0);
  EXPECT_EQ(study.histogram.counts.back(), 8U);
}

TEST(EdgeToleranceStudy, QuietDrivesHaveNoFrequencyAndNoIndices) {
  const TolerancedDrive quiet =
      normalised_toleranced({{"servo.damping", UniformBetween{1.5, 2.0}}});
  const SamplePlan sampling{.points = 64, .replicates = 2};
  const ToleranceStudy study = study_tolerances(quiet, sampling);
  EXPECT_EQ(study.hunting.value, 0.0);
  EXPECT_EQ(study.amplitude.back().value->value, 0.0);
  EXPECT_FALSE(study.amplitude_of_hunting.back().value);
  EXPECT_FALSE(study.frequency.back().value);
  EXPECT_EQ(study.mean_amplitude.value().value, 0.0);
  EXPECT_TRUE(study.histogram.edges.empty());
  const SensitivityStudy indices = study_sensitivities(quiet, sampling);
  EXPECT_FALSE(indices.numbers[0].of_amplitude || indices.numbers[0].of_hunting);
}

TEST(EdgeToleranceStudy, NoFrictionGrowsWithoutBound) {
  TolerancedDrive drive = normalised_toleranced({{"servo.backlash", UniformBetween{0.1, 0.2}}});
  drive.nominal.servo->damping = 0.0;
  const ToleranceStudy study =
      study_tolerances(drive, {.points = 4, .replicates = 2}, {.target = at_most(1.0)});
  EXPECT_EQ(study.hunting.value, 1.0);
  EXPECT_EQ(study.yield.value, 0.0);
  EXPECT_TRUE(std::isinf(study.amplitude.front().value->value));
  EXPECT_EQ(study.histogram.unknown, 8U);
  EXPECT_FALSE(study.mean_amplitude);
}

TEST(EdgeToleranceStudy, BouncesAreFollowed) {
  const ToleranceStudy study =
      study_tolerances(normalised_toleranced({{"contact.restitution", UniformBetween{0.1, 0.5}},
                                              {"servo.backlash", within_share(0.3, 0.1)}}),
                       {.points = 16, .replicates = 2});
  EXPECT_EQ(study.hunting.value, 1.0);
  EXPECT_NEAR(study.amplitude[2].value->value, 0.235, 0.02);
}

TEST(EdgeToleranceStudy, CanBeStopped) {
  const SamplePlan sampling{.points = 4096, .replicates = 4};
  test::Stopping stop;
  const ToleranceStudy study =
      study_tolerances(widely_toleranced(), sampling, {}, {.threads = 1}, stop);
  EXPECT_TRUE(study.stopped);
  EXPECT_GT(study.answered, 0U);  // the first block, by the end of which it learns of the stop
  EXPECT_LT(study.answered, sampling.samples());
  const double hunting =
      study_tolerances(widely_toleranced(), sampling, {}, {.threads = 1}, no_progress())
          .hunting.value;
  EXPECT_NEAR(study.hunting.value, hunting, 0.1);
  EXPECT_TRUE(study_sensitivities(widely_toleranced(), sampling, {}, {.threads = 1}, stop).stopped);
}

using test::faults_of;

TEST(EdgeToleranceStudy, EveryFaultIsNamed) {
  using testing::ElementsAre;
  StudyQuestions questions{.target = at_most(-1.0), .shares = {1.5}, .bins = 2'000'000};
  const TolerancedDrive drive = toleranced({{"motor.friction", UniformBetween{-1.0, 1.0}}});
  EXPECT_THAT(
      faults_of([&] { (void)study_tolerances(drive, {.points = 0, .replicates = 1}, questions); }),
      ElementsAre("motor.friction = uniform from -1 to 1: must not fall below zero",
                  "sampling.points = 0: must be at least 1",
                  "sampling.replicates = 1: must be at least 2: their scatter gives the "
                  "error",
                  "target = amplitude >= 0 and amplitude <= -1: must not contradict itself",
                  "quantile = 1.5: must be from 0 to 1",
                  "bins = 2000000: must be at most 1000000"));
  EXPECT_THAT(faults_of([&] {
                (void)study_sensitivities(toleranced({}),
                                          {.points = 1'000'000'000, .replicates = 2});
              }),
              ElementsAre("sampling.points = 1000000000: must give at most 16777216 samples with "
                          "all replicates together: every sample is kept"));
  EXPECT_THAT(faults_of([&] {
                (void)answer_samples(toleranced({}), {.points = 4, .replicates = 2}, {}, 5, 4, {},
                                     no_progress());
              }),
              ElementsAre("samples = 5 and 4 more: must be among the 8 of the plan"));
  EXPECT_THAT(faults_of([&] {
                (void)study_of({.points = 4, .replicates = 2}, {}, detail::SampleResults(7));
              }),
              ElementsAre("results = 7: must be as many as samples: 8"));
}

TEST(EdgeToleranceStudy, KeepsAsManySamplesAsItSays) {
  constexpr std::size_t most = SamplePlan::most_samples;
  EXPECT_THAT(faults(sampling_of(most)), testing::IsEmpty());
  EXPECT_EQ(sampling_of(most).samples(), most);
  EXPECT_THAT(faults(sampling_of(most + 1)), testing::SizeIs(1));
  EXPECT_THAT(faults(SamplePlan{.points = most / 3, .replicates = 3}), testing::IsEmpty());
  EXPECT_THAT(faults(SamplePlan{.points = most / 3 + 1, .replicates = 3}), testing::SizeIs(1));
}

TEST(SamplePlan, HasAPowerOfTwoOfPoints) {
  EXPECT_EQ(sampling_of(65536).points, 4096U);
  EXPECT_EQ(sampling_of(65537).points, 8192U);
  EXPECT_EQ(sampling_of(0).points, 1U);
}

}  // namespace
}  // namespace gearlash::tolerance_study_test
