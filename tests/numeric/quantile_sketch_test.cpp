// Quantiles by buckets: against sorted values, in any order, and the values that are special.
#include "numeric/quantile_sketch.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "base/seeded_draws.hpp"

namespace gearlash::quantile_sketch_test {
namespace {

constexpr std::uint64_t seed = 20190818;
constexpr double accuracy = QuantileSketch::relative_accuracy;

std::vector<double> values_over_12_decades(std::size_t count, bool both_signs) {
  SeededDraws draws(seed);
  std::vector<double> values(count);
  for (double& value : values) {
    value = both_signs ? draws.either_sign(1e-6, 1e6) : draws.log_uniform(1e-6, 1e6);
  }
  return values;
}

QuantileSketch sketch_of(const std::vector<double>& values) {
  QuantileSketch sketch;
  for (const double value : values) sketch.add(value);
  return sketch;
}

TEST(PropertyQuantileSketch, EveryRankOfSortedValuesIsWithinTheAccuracy) {
  SCOPED_TRACE("seed " + std::to_string(seed));
  for (const bool both_signs : {false, true}) {
    std::vector<double> values = values_over_12_decades(20'001, both_signs);
    const QuantileSketch sketch = sketch_of(values);
    std::sort(values.begin(), values.end());
    ASSERT_EQ(sketch.size(), values.size());
    double worst = 0.0;
    for (std::size_t rank = 0; rank < values.size(); rank += 7) {
      worst = std::max(worst, std::abs(sketch.value_at(rank) / values[rank] - 1.0));
    }
    EXPECT_LE(worst, accuracy);
    EXPECT_GT(worst, 0.9 * accuracy);  // the accuracy claimed is the one there is
    EXPECT_EQ(sketch.value_at(0), values.front());
    EXPECT_EQ(sketch.smallest(), values.front());
    EXPECT_EQ(sketch.value_at(values.size() - 1), values.back());
    EXPECT_EQ(sketch.largest(), values.back());
    for (const double share : {0.0, 0.001, 0.05, 0.31, 0.5, 0.75, 0.999, 1.0}) {
      const double rank = std::clamp(share * 20'001 - 0.5, 0.0, 20'000.0);
      const auto low = static_cast<std::size_t>(rank);
      const double high_value = values[std::min<std::size_t>(low + 1, 20'000)];
      const double exact =
          values[low] + (rank - static_cast<double>(low)) * (high_value - values[low]);
      const double size = std::max(std::abs(values[low]), std::abs(high_value));
      EXPECT_NEAR(sketch.quantile(share), exact, accuracy * size) << share;
    }
  }
}

/// Also values at the ends of buckets, where rounding would show.
TEST(PropertyQuantileSketch, EveryValueIsWithinItsBucket) {
  SCOPED_TRACE("seed " + std::to_string(seed));
  SeededDraws draws(seed);
  for (int i = 0; i < 2'000; ++i) {
    const double size = std::ldexp(1.0 + std::floor(draws.uniform(0.0, 512.0)) / 512.0,
                                   static_cast<int>(draws.uniform(-1022.0, 1024.0)));
    for (const double value : {size, std::nextafter(size, 0.0), -size, draws.sign() * 1.1 * size}) {
      if (std::abs(value) < std::numeric_limits<double>::min() || std::isinf(value)) continue;
      QuantileSketch sketch;
      sketch.add(value, 3);
      ASSERT_EQ(sketch.buckets().size(), 1U);
      const QuantileSketch::Bucket bucket = sketch.buckets().front();
      ASSERT_TRUE(value > 0.0 ? bucket.low <= value && value < bucket.high
                              : bucket.low < value && value <= bucket.high)
          << value;
      ASSERT_EQ(bucket.count, 3U);
      sketch.add(10.0 * value);  // so that neither extreme is asked for
      sketch.add(0.1 * value);
      ASSERT_NEAR(sketch.value_at(2) / value, 1.0, accuracy) << value;
    }
  }
}

TEST(PropertyQuantileSketch, OrderAndDivisionDoNotMatter) {
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::vector<double> values = values_over_12_decades(5'000, true);
  for (const double special : {0.0, -0.0, infinity, -infinity, not_a_number, 1e-320, -1e-320}) {
    values.insert(values.begin() + 999, special);
  }
  const QuantileSketch whole = sketch_of(values);
  std::array<QuantileSketch, 7> parts;
  for (std::size_t i = 0; i < values.size(); ++i) parts[i * i % 7].add(values[i]);
  std::array<int, 7> order = {0, 1, 2, 3, 4, 5, 6};
  for (int i = 0; i < 50; ++i) {
    QuantileSketch merged;
    for (const int part : order) merged.merge(parts[static_cast<std::size_t>(part)]);
    ASSERT_TRUE(merged == whole);
    std::next_permutation(order.begin(), order.end());
    std::rotate(order.begin(), order.begin() + 3, order.end());
  }
  std::reverse(values.begin(), values.end());
  EXPECT_TRUE(sketch_of(values) == whole);
  values.back() *= 1.01;
  EXPECT_FALSE(sketch_of(values) == whole);
}

TEST(EdgeQuantileSketch, SpecialValuesHaveTheirPlaces) {
  QuantileSketch sketch;
  EXPECT_EQ(sketch.size(), 0U);
  EXPECT_TRUE(std::isnan(sketch.quantile(0.5)));
  EXPECT_TRUE(std::isnan(sketch.smallest()));
  EXPECT_TRUE(std::isnan(sketch.largest_finite()));
  sketch.add(not_a_number);
  EXPECT_EQ(sketch.size(), 0U);
  EXPECT_EQ(sketch.not_known(), 1U);
  for (const double value : {infinity, 3.0, 0.0, -2.0, -infinity, -0.0, 1e-310, infinity}) {
    sketch.add(value);
  }
  EXPECT_EQ(sketch.size(), 8U);
  EXPECT_EQ(sketch.finite(), 5U);
  const std::vector<double> sorted = {-infinity, -2.0, 0.0, 0.0, 0.0, 3.0, infinity, infinity};
  for (std::size_t rank = 0; rank < 8; ++rank) EXPECT_EQ(sketch.value_at(rank), sorted[rank]);
  EXPECT_EQ(sketch.smallest(), -infinity);
  EXPECT_EQ(sketch.smallest_finite(), -2.0);
  EXPECT_EQ(sketch.largest_finite(), 3.0);
  EXPECT_EQ(sketch.quantile(1.0), infinity);
  EXPECT_EQ(sketch.quantile(0.5), 0.0);
  QuantileSketch mixed;
  for (const double value : {4.0, 0.0, 2.0, 0.0, 8.0}) mixed.add(value);
  EXPECT_NEAR(mixed.value_at(2), 2.0, accuracy * 2.0);
  EXPECT_NEAR(mixed.value_at(3), 4.0, accuracy * 4.0);
  QuantileSketch one;
  one.add(7.0);
  for (const double share : {0.0, 0.5, 1.0}) EXPECT_EQ(one.quantile(share), 7.0);
  QuantileSketch largest;
  largest.add(std::numeric_limits<double>::max(), 5);
  EXPECT_EQ(largest.value_at(2), std::numeric_limits<double>::max());
  EXPECT_EQ(largest.buckets(1).front().high, infinity);
}

TEST(PropertyQuantileSketch, WiderBucketsHaveTheSameValues) {
  SCOPED_TRACE("seed " + std::to_string(seed));
  const std::vector<double> values = values_over_12_decades(3'000, true);
  QuantileSketch sketch = sketch_of(values);
  sketch.add(0.0, 4);
  std::uint64_t all = 0;
  double end = -infinity;
  for (const QuantileSketch::Bucket& bucket : sketch.buckets(8)) {
    EXPECT_LE(end, bucket.low);
    end = bucket.high;
    all += bucket.count;
    if (bucket.low == 0.0) {
      EXPECT_EQ(bucket.count, 4U);
      continue;
    }
    const double near = std::min(std::abs(bucket.low), std::abs(bucket.high));
    EXPECT_EQ(bucket.high - bucket.low, std::exp2(std::floor(std::log2(near))) / 8.0);
    EXPECT_EQ(bucket.count, static_cast<std::uint64_t>(
                                std::count_if(values.begin(), values.end(), [&](double value) {
                                  return value > 0.0 ? bucket.low <= value && value < bucket.high
                                                     : bucket.low < value && value <= bucket.high;
                                })));
  }
  EXPECT_EQ(all, 3'004U);
}

TEST(PropertyQuantileSketch, IsReadBackAsItWasPacked) {
  SCOPED_TRACE("seed " + std::to_string(seed));
  QuantileSketch sketch = sketch_of(values_over_12_decades(1'000, true));
  for (const double special : {0.0, infinity, -infinity, not_a_number, 1e308, 1e-300})
    sketch.add(special);
  PackedNumbers packed;
  sketch.pack(packed);
  packed.add(42);
  UnpackedNumbers numbers(packed.text());
  QuantileSketch again;
  ASSERT_TRUE(again.unpack(numbers));
  EXPECT_TRUE(again == sketch);
  EXPECT_EQ(numbers.next(), 42U);
  EXPECT_TRUE(numbers.is_at_end());
  for (const std::size_t length : {std::size_t{0}, std::size_t{5}, packed.text().size() - 5}) {
    const std::string cut = packed.text().substr(0, length);
    UnpackedNumbers some(cut);
    EXPECT_FALSE(again.unpack(some));
  }
  UnpackedNumbers foreign("not a sketch!");
  EXPECT_FALSE(again.unpack(foreign));
}

}  // namespace
}  // namespace gearlash::quantile_sketch_test
