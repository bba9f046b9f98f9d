// The series of a step: what it leaves out, against the terms themselves.
#include "hybrid/linear_flow.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "hybrid/guard_form.hpp"

namespace gearlash::hybrid::linear_flow_test {
namespace {

/// Of lengthᵏ/k! beyond an order: of all orders, or of those that are odd or even alone.
double terms_beyond(double length, int last, int first = 1, int every = 1) {
  long double term = 1.0L;
  long double sum = 0.0L;
  for (int k = 1; k <= last + 40; ++k) {
    term *= static_cast<long double>(length) / k;
    if (k > last && k % every == first % every) sum += term;
  }
  return static_cast<double>(sum);
}

/// x₁′ = s x₂, x₂′ = −x₁/s: its terms are those of a circle, whatever the unit s of x₁. From
/// x₁ = s, x₂ = 0 on, those of x₁ are of even order, those of x₂ of odd order.
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
    EXPECT_LE(terms_beyond(length, order), left_out * length) << share;
    EXPECT_GT(terms_beyond(length, order - 1), left_out * length) << share;
    for (const int i : {0, 1}) {
      const GuardTable table(flow, SparseForm({Vector::Unit(2, i), 0.0}));
      const double size = i == 0 ? unit : 1.0;
      for (const int last : {0, 3, order}) {
        const double beyond = terms_beyond(length, last, i, 2) * size;
        EXPECT_GE(table.beyond(velocity, share, last), (1.0 - 1e-15) * beyond) << share << last;
      }
      EXPECT_LE(table.beyond(velocity, 1.0, flow.order(flow.longest_step())),
                left_out * table.reach(velocity, 1.0));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Units, OracleLinearFlow, ::testing::Values(1.0, 0x1p-20, 0x1p10));

}  // namespace
}  // namespace gearlash::hybrid::linear_flow_test
