// The series of a step: what it leaves out, against the terms themselves.
#include "hybrid/linear_flow.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace gearlash::hybrid {
namespace {

/// x₁′ = s x₂, x₂′ = −x₁/s: its terms are those of a circle, whatever the unit s of x₁.
class OracleLinearFlow : public ::testing::TestWithParam<double> {};

TEST_P(OracleLinearFlow, TheSeriesLeavesOutWhatItSays) {
  const double unit = GetParam();
  Matrix matrix(2, 2);
  matrix << 0.0, unit, -1.0 / unit, 0.0;
  const LinearFlow flow({matrix, Vector::Zero(2)});
  const Vector state = Vector{{unit, 0.0}};
  const Vector noise = Vector::Zero(2);
  Velocity velocity;
  flow.velocity_at(state.data(), noise.data(), velocity);
  for (const double share : {1.0, 0.5, 0.1, 0.01}) {
    const double length = share * flow.longest_step();
    const int order = flow.order(length);
    // Of x₂, in its own unit, all terms are lengthᵏ/k!, turn and turn about 0.
    const auto beyond = [&](int last) {
      long double term = 1.0L;
      long double sum = 0.0L;
      for (int k = 1; k <= last + 40; ++k) {
        term *= static_cast<long double>(length) / k;
        if (k > last) sum += term;
      }
      return static_cast<double>(sum);
    };
    for (const int moving : {0, 1}) {
      const double size = flow.number(moving) == 0 ? unit : 1.0;
      const double left_out = flow.remainder(velocity, length) * flow.weight(moving) / size;
      EXPECT_LE(beyond(order), left_out) << share;
      EXPECT_GT(beyond(order - 1), left_out) << share;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Units, OracleLinearFlow, ::testing::Values(1.0, 0x1p-20, 0x1p10));

}  // namespace
}  // namespace gearlash::hybrid
