// All divided differences of the header against Opitz's matrix: the divided differences of exp at
// x₀ … x_n are the first row of the exponential of the matrix with x₀ … x_n on its diagonal and
// ones above it. That holds for coincident points too, and shares nothing with the formulas under
// test.
#include "closed_form/decay_integral.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "base/fifty_digits.hpp"
#include "base/seeded_draws.hpp"

namespace gearlash::decay_integral_test {
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

Convolution convolution_of(double x, double y) { return convolution(decay(x), decay(y)); }

/// Keeps the largest error of each divided difference for the test's report.
class LargestErrors {
 public:
  void check(double x, double y) {
    const Decay single = decay(x);
    const Convolution two = convolution_of(x, y);
    check("exp[-x]", single.factor, divided_difference<1>({-x}), x, y);
    check("exp[0,-x]", single.integral, divided_difference<2>({0.0, -x}), x, y);
    check("exp[0,0,-x]", single.double_integral, divided_difference<3>({0.0, 0.0, -x}), x, y);
    check("exp[-x,-y]", two.value, divided_difference<2>({-x, -y}), x, y);
    check("exp[0,-x,-y]", two.integral, divided_difference<3>({0.0, -x, -y}), x, y);
    check("exp[0,0,-x,-y]", two.double_integral, divided_difference<4>({0.0, 0.0, -x, -y}), x, y);
  }
  ~LargestErrors() {
    for (const auto& [name, value] : largest_) {
      testing::Test::RecordProperty(name, std::to_string(value));
    }
  }

 private:
  void check(const std::string& name, double actual, const Wide& exact, double x, double y) {
    const double epsilons = error(actual, exact);
    largest_[name] = std::max(largest_[name], epsilons);
    EXPECT_LE(epsilons, promised_epsilons) << name << " x " << x << " y " << y;
  }
  std::map<std::string, double> largest_;
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
  const double below = std::nextafter(1.0, 0.0);
  const double above = std::nextafter(1.0, 2.0);
  std::vector<double> values = {0.0,  5e-324, 1e-300, 1e-20, 1e-12, 1e-8, 1e-4,
                                0.1,  0.5,    below,  1.0,   above, 1.5,  3.0,
                                36.0, 700.0,  708.0,  745.0, 800.0, 1e4,  1e9};
  for (const double x : values) {
    for (const double y : values) largest.check(x, y);
  }
}

TEST(EdgeDecayIntegral, ValuesAtZero) {
  const Decay none = decay(0.0);
  EXPECT_EQ(none.factor, 1.0);
  EXPECT_EQ(none.integral, 1.0);
  EXPECT_EQ(none.double_integral, 0.5);
  const Convolution two = convolution(none, none);
  EXPECT_EQ(two.value, 1.0);
  EXPECT_EQ(two.integral, 0.5);
  EXPECT_EQ(two.double_integral, 1.0 / 6.0);
}

TEST(PropertyDecayIntegral, SymmetricInTheTwoRates) {
  SeededDraws draws(1846);
  for (int i = 0; i < 10000; ++i) {
    const double x = draws.log_uniform(1e-12, 1e9);
    const double y = draws.log_uniform(1e-12, 1e9);
    const Convolution one = convolution_of(x, y);
    const Convolution other = convolution_of(y, x);
    ASSERT_EQ(one.value, other.value);
    ASSERT_EQ(one.integral, other.integral);
    ASSERT_EQ(one.double_integral, other.double_integral);
  }
}

TEST(PropertyDecayIntegral, PositiveAndDecreasing) {
  // A step of 1e-3 moves each function by far more than the promised error.
  SeededDraws draws(1847);
  for (int i = 0; i < 10000; ++i) {
    const double x = draws.log_uniform(0.1, 100.0);
    const double y = draws.log_uniform(0.1, 100.0);
    const Convolution here = convolution_of(x, y);
    const Convolution later = convolution_of(1.001 * x, 1.001 * y);
    ASSERT_GT(decay(x).integral, decay(1.001 * x).integral);
    ASSERT_GT(decay(x).double_integral, decay(1.001 * x).double_integral);
    ASSERT_GT(here.integral, later.integral);
    ASSERT_GT(here.double_integral, later.double_integral);
    ASSERT_GT(here.double_integral, 0.0);
  }
}

}  // namespace
}  // namespace gearlash::decay_integral_test
