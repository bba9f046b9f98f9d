// All divided differences of the header against their definition in many digits.
#include "closed_form/decay_integral.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>

#include "base/references.hpp"
#include "base/seeded_draws.hpp"

namespace gearlash::decay_integral_test {
namespace {

/// What the header promises over the whole quadrant.
constexpr double promised_epsilons = 16.0;

/// Relative error in epsilons; where the exact value is no normal double, in its last place.
double error(double actual, Wide exact) {
  constexpr double smallest = std::numeric_limits<double>::min();
  return exact < smallest ? epsilons_of(actual, exact, smallest) : epsilons_off(actual, exact);
}

Convolution convolution_of(double x, double y) { return convolution(decay(x), decay(y)); }

/// Random arguments over the quadrant, of order one where the formulas change, nearly equal ones,
/// and the ends: 0, where exponents vanish, and where their factors do.
TEST(OracleDecayIntegral, KeepsItsDigitsOverTheQuadrant) {
  std::map<std::string, double> largest;
  for (const Reference& exact : References("closed_form", "divided_differences")) {
    const double x = exact.input("x");
    const double y = exact.input("y");
    const Decay single = decay(x);
    const Convolution two = convolution_of(x, y);
    const auto check = [&](const char* name, double actual) {
      const double epsilons = error(actual, exact[name]);
      largest[name] = std::max(largest[name], epsilons);
      EXPECT_LE(epsilons, promised_epsilons) << name << " x " << x << " y " << y;
    };
    check("factor", single.factor);
    check("integral", single.integral);
    check("double_integral", single.double_integral);
    check("joint", two.value);
    check("joint_integral", two.integral);
    check("joint_double_integral", two.double_integral);
  }
  for (const auto& [name, value] : largest) RecordProperty(name, std::to_string(value));
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

}  // namespace
}  // namespace gearlash::decay_integral_test
