// Derivatives of divided differences against fifty digits.
#include "closed_form/decay_slopes.hpp"

#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_bin_float.hpp>

#include "base/seeded_draws.hpp"

namespace gearlash::decay_slopes_test {
namespace {

using Real = boost::multiprecision::cpp_bin_float_50;

constexpr double epsilon = std::numeric_limits<double>::epsilon();

/// exp[points] by its defining quotients; points that coincide are moved apart by 1e-12, which
/// changes it by some 1e-12 squared where they lie evenly about their place.
Real divided_difference(const std::vector<Real>& points) {
  if (points.size() == 1) return exp(points.front());
  const std::vector<Real> without_first(points.begin() + 1, points.end());
  const std::vector<Real> without_last(points.begin(), points.end() - 1);
  return (divided_difference(without_first) - divided_difference(without_last)) /
         (points.back() - points.front());
}

/// exp[0 … 0, −x, −x, −y …] with `zeros` noughts.
Real repeated(int zeros, const Real& x, const std::vector<Real>& others) {
  const Real apart("1e-11");
  std::vector<Real> points;
  if (zeros == 1) points = {0};
  if (zeros == 2) points = {-apart, apart};
  points.push_back(-x - apart * Real(1.25));
  points.push_back(-x + apart * Real(1.25));
  for (const Real& other : others) points.push_back(-other);
  return divided_difference(points);
}

void expect_near(double found, const Real& exact) {
  EXPECT_LE(abs(found + exact), 128.0 * epsilon * exact);  // a slope is minus a divided difference
}

TEST(OracleDecaySlopes, AgreeWithFiftyDigits) {
  constexpr std::uint64_t seed = 2201;
  SCOPED_TRACE(seed);
  SeededDraws draws(seed);
  for (int i = 0; i < 2000; ++i) {
    const double x = draws.log_uniform(1e-6, 300.0);
    const double y = draws.happens(0.3) ? x * (1.0 + draws.either_sign(1e-8, 1e-1))
                                        : draws.log_uniform(1e-6, 300.0);
    SCOPED_TRACE(testing::Message() << x << " " << y);
    const DecaySlope alone = decay_slope(decay(x));
    expect_near(alone.factor, repeated(0, x, {}));
    expect_near(alone.integral, repeated(1, x, {}));
    expect_near(alone.double_integral, repeated(2, x, {}));
    const ConvolutionSlope joint = convolution_slope(decay(x), decay(y));
    expect_near(joint.value, repeated(0, x, {y}));
    expect_near(joint.integral, repeated(1, x, {y}));
    expect_near(joint.double_integral, repeated(2, x, {y}));
  }
}

TEST(EdgeDecaySlopes, AtExponentsOfZero) {
  const Decay zero = decay(0.0);
  EXPECT_DOUBLE_EQ(decay_slope(zero).factor, -1.0);
  EXPECT_DOUBLE_EQ(decay_slope(zero).integral, -1.0 / 2.0);
  EXPECT_DOUBLE_EQ(decay_slope(zero).double_integral, -1.0 / 6.0);
  const ConvolutionSlope slope = convolution_slope(zero, zero);
  EXPECT_DOUBLE_EQ(slope.value, -1.0 / 2.0);
  EXPECT_DOUBLE_EQ(slope.integral, -1.0 / 6.0);
  EXPECT_DOUBLE_EQ(slope.double_integral, -1.0 / 24.0);
}

}  // namespace
}  // namespace gearlash::decay_slopes_test
