// The five φ-functions against Opitz's matrix: the divided differences of exp at x₀ … x_n are the
// first row of the exponential of the matrix with x₀ … x_n on its diagonal and ones above it. That
// holds for coincident points too, and shares nothing with the formulas under test.
#include "gearlash/motion/decay_integral.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "../servo/seeded_draws.hpp"
#include "fifty_digits.hpp"

namespace gearlash {
namespace {

/// What the header promises over the whole quadrant.
constexpr double promised_epsilons = 16.0;

template <std::size_t size>
Wide divided_difference(const std::array<double, size>& points) {
  WideMatrix<size> opitz{};
  for (std::size_t i = 0; i < size; ++i) {
    opitz[i][i] = points[i];
    if (i + 1 < size) opitz[i][i + 1] = 1;
  }
  return exponential(opitz)[0][size - 1];
}

/// Relative error in epsilons; where the exact value is no normal double, in its last place.
double error(double actual, const Wide& exact) {
  constexpr double smallest = std::numeric_limits<double>::min();
  if (exact < smallest) return epsilons_of(actual, exact, smallest);
  return epsilons_off(actual, exact);
}

struct Errors {
  double decay_integral = 0.0;
  double decay_double_integral = 0.0;
  double decay_convolution = 0.0;
  double convolution_integral = 0.0;
  double convolution_double_integral = 0.0;

  double largest() const {
    return std::max({decay_integral, decay_double_integral, decay_convolution, convolution_integral,
                     convolution_double_integral});
  }
};

Errors errors_at(double x, double y) {
  return {error(decay_integral(x), divided_difference<2>({0.0, -x})),
          error(decay_double_integral(x), divided_difference<3>({0.0, 0.0, -x})),
          error(decay_convolution(x, y), divided_difference<2>({-x, -y})),
          error(convolution_integral(x, y), divided_difference<3>({0.0, -x, -y})),
          error(convolution_double_integral(x, y), divided_difference<4>({0.0, 0.0, -x, -y}))};
}

class LargestErrors {
 public:
  void check(double x, double y) {
    const Errors errors = errors_at(x, y);
    keep(decay_integral_, errors.decay_integral);
    keep(decay_double_integral_, errors.decay_double_integral);
    keep(decay_convolution_, errors.decay_convolution);
    keep(convolution_integral_, errors.convolution_integral);
    keep(convolution_double_integral_, errors.convolution_double_integral);
    EXPECT_LE(errors.decay_integral, promised_epsilons) << "x " << x;
    EXPECT_LE(errors.decay_double_integral, promised_epsilons) << "x " << x;
    EXPECT_LE(errors.decay_convolution, promised_epsilons) << "x " << x << " y " << y;
    EXPECT_LE(errors.convolution_integral, promised_epsilons) << "x " << x << " y " << y;
    EXPECT_LE(errors.convolution_double_integral, promised_epsilons) << "x " << x << " y " << y;
  }
  ~LargestErrors() {
    testing::Test::RecordProperty("decay_integral", std::to_string(decay_integral_));
    testing::Test::RecordProperty("decay_double_integral", std::to_string(decay_double_integral_));
    testing::Test::RecordProperty("decay_convolution", std::to_string(decay_convolution_));
    testing::Test::RecordProperty("convolution_integral", std::to_string(convolution_integral_));
    testing::Test::RecordProperty("convolution_double_integral",
                                  std::to_string(convolution_double_integral_));
  }

 private:
  static void keep(double& largest, double value) { largest = std::max(largest, value); }
  double decay_integral_ = 0.0;
  double decay_double_integral_ = 0.0;
  double decay_convolution_ = 0.0;
  double convolution_integral_ = 0.0;
  double convolution_double_integral_ = 0.0;
};

TEST(OracleDecayIntegral, RandomArgumentsOverTheQuadrant) {
  constexpr std::uint64_t seed = 1843;
  SCOPED_TRACE(seed);
  SeededDraws draws(seed);
  LargestErrors largest;
  for (int i = 0; i < 2000 && !testing::Test::HasFailure(); ++i) {
    const double x = draws.log_uniform(1e-12, 1e9);
    largest.check(x, draws.log_uniform(1e-12, 1e9));
  }
}

TEST(OracleDecayIntegral, ArgumentsOfOrderOneWhereTheFormulasChange) {
  constexpr std::uint64_t seed = 1844;
  SCOPED_TRACE(seed);
  SeededDraws draws(seed);
  LargestErrors largest;
  for (int i = 0; i < 3000 && !testing::Test::HasFailure(); ++i) {
    const double x = draws.log_uniform(0.01, 10.0);
    largest.check(x, draws.log_uniform(0.1, 10.0));
  }
}

TEST(OracleDecayIntegral, NearlyEqualArguments) {
  constexpr std::uint64_t seed = 1845;
  SCOPED_TRACE(seed);
  SeededDraws draws(seed);
  LargestErrors largest;
  for (int i = 0; i < 1500 && !testing::Test::HasFailure(); ++i) {
    const double x = draws.log_uniform(1e-12, 1e9);
    largest.check(x, x * (1.0 + draws.either_sign(1e-16, 0.1)));
  }
}

TEST(EdgeDecayIntegral, EqualVanishingAndLimitingArguments) {
  LargestErrors largest;
  const double below = std::nextafter(1.5, 0.0);
  const double above = std::nextafter(1.5, 2.0);
  std::vector<double> values = {
      0.0,   5e-324, 1e-300, 1e-20, 1e-12, 1e-8, 1e-4, 0.1,   std::nextafter(0.5, 0.0),
      0.5,   1.0,    below,  1.5,   above, 3.0,  36.0, 700.0, 708.0,
      745.0, 800.0,  1e4,    1e9};
  for (const double x : values) {
    for (const double y : values) largest.check(x, y);
  }
}

TEST(EdgeDecayIntegral, ValuesAtZero) {
  EXPECT_EQ(decay_integral(0.0), 1.0);
  EXPECT_EQ(decay_double_integral(0.0), 0.5);
  EXPECT_EQ(decay_convolution(0.0, 0.0), 1.0);
  EXPECT_EQ(convolution_integral(0.0, 0.0), 0.5);
  EXPECT_EQ(convolution_double_integral(0.0, 0.0), 1.0 / 6.0);
}

TEST(PropertyDecayIntegral, SymmetricInTheTwoRates) {
  SeededDraws draws(1846);
  for (int i = 0; i < 10000; ++i) {
    const double x = draws.log_uniform(1e-12, 1e9);
    const double y = draws.log_uniform(1e-12, 1e9);
    ASSERT_EQ(decay_convolution(x, y), decay_convolution(y, x));
    ASSERT_EQ(convolution_integral(x, y), convolution_integral(y, x));
    ASSERT_EQ(convolution_double_integral(x, y), convolution_double_integral(y, x));
  }
}

TEST(PropertyDecayIntegral, PositiveAndDecreasing) {
  // A step of 1e-3 moves each function by far more than the promised error.
  SeededDraws draws(1847);
  for (int i = 0; i < 10000; ++i) {
    const double x = draws.log_uniform(0.1, 100.0);
    const double y = draws.log_uniform(0.1, 100.0);
    ASSERT_GT(decay_integral(x), decay_integral(1.001 * x));
    ASSERT_GT(decay_double_integral(x), decay_double_integral(1.001 * x));
    ASSERT_GT(convolution_integral(x, y), convolution_integral(1.001 * x, 1.001 * y));
    ASSERT_GT(convolution_double_integral(x, y), convolution_double_integral(1.001 * x, 1.001 * y));
    ASSERT_GT(convolution_double_integral(x, y), 0.0);
  }
}

}  // namespace
}  // namespace gearlash
