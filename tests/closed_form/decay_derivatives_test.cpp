// Derivatives of divided differences against their definition in many digits.
#include "closed_form/decay_derivatives.hpp"

#include <gtest/gtest.h>

#include "base/references.hpp"

namespace gearlash::decay_slopes_test {
namespace {

TEST(OracleDecaySlopes, KeepTheirDigits) {
  for (const Reference& exact : References("closed_form", "decay_slopes")) {
    const double x = exact.input("x");
    const double y = exact.input("y");
    const auto check = [&](const char* name, double slope) {
      EXPECT_LE(epsilons_off(-slope, exact[name]), 128.0) << name << " x " << x << " y " << y;
    };
    const DecaySlope alone = decay_slope(decay(x));
    check("factor", alone.factor);
    check("integral", alone.integral);
    check("double_integral", alone.double_integral);
    const ConvolutionSlope joint = convolution_slope(decay(x), decay(y));
    check("joint", joint.value);
    check("joint_integral", joint.integral);
    check("joint_double_integral", joint.double_integral);
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
