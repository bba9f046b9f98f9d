// Proved bounds of linear motion, beside integrals and sums that are known.
#include "numeric/decaying_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "base/seeded_draws.hpp"

namespace gearlash::decaying_motion_test {
namespace {

using Rows = std::vector<std::vector<double>>;

IntervalMatrix matrix(const Rows& rows) { return matrix_of(rows, rows.size()).cast<Interval>(); }

Interval norm(const Rows& flow, TimeKind kind, const std::vector<double>& input,
              const std::vector<double>& output) {
  const auto motion = DecayingMotion::of(matrix(flow), kind);
  if (!motion) return Interval::whole_line();
  return motion->impulse_norm({input.begin(), input.end()}, {output.begin(), output.end()});
}

void expect_encloses(const Interval& found, double exact, double share) {
  EXPECT_LE(found.low, exact);
  EXPECT_GE(found.high, exact);
  EXPECT_LE(found.high, exact * (1.0 + share));
}

/// coth(πζ/(2√(1 − ζ²))), of 1/(s² + 2ζs + 1): each half swing is e^{−πζ/√(1 − ζ²)} of the one
/// before.
TEST(OracleDecayingMotion, OfAnOscillator) {
  for (const double damping : {0.01, 0.1, 0.19, 0.5, 0.9, 0.999}) {
    const double half_swing =
        std::numbers::pi * damping / (2.0 * std::sqrt(1.0 - damping * damping));
    expect_encloses(
        norm({{0.0, 1.0}, {-1.0, -2.0 * damping}}, TimeKind::continuous, {0.0, 1.0}, {1.0, 0.0}),
        1.0 / std::tanh(half_swing), 1e-4);
  }
}

/// Where the response never changes its sign, the norm is the gain at rest.
TEST(OracleDecayingMotion, OfRatesTwelveDecadesApart) {
  const std::vector<double> rates{1e6, 3.0, 2.0, 1e-6};
  Rows flow(4, std::vector<double>(4, 0.0));
  for (std::size_t i = 0; i < 4; ++i) {
    flow[i][i] = -rates[i];
    if (i > 0) flow[i][i - 1] = rates[i];
  }
  expect_encloses(norm(flow, TimeKind::continuous, {1e6, 0.0, 0.0, 0.0}, {0.0, 0.0, 0.0, 1.0}), 1.0,
                  1e-4);
}

TEST(OracleDecayingMotion, OfTwelveEqualRates) {
  Rows flow(12, std::vector<double>(12, 0.0));
  for (std::size_t i = 0; i < 12; ++i) {
    flow[i][i] = -1.0;
    if (i > 0) flow[i][i - 1] = 1.0;
  }
  std::vector<double> input(12, 0.0);
  std::vector<double> output(12, 0.0);
  input[0] = 1.0;
  output[11] = 1.0;
  expect_encloses(norm(flow, TimeKind::continuous, input, output), 1.0, 1e-4);
}

TEST(OracleDecayingMotion, OfSteps) {
  const auto geometric = [](double ratio) {
    return norm({{ratio - 1.0}}, TimeKind::stepwise, {1.0}, {1.0});
  };
  expect_encloses(geometric(0.5), 2.0, 1e-4);
  expect_encloses(geometric(-0.5), 2.0, 1e-4);
  expect_encloses(geometric(0.0), 1.0, 1e-4);
  expect_encloses(geometric(1.0 - 0x1p-30), 0x1p30, 1e-4);
  // A queue of thirty, all of whose eigenvalues are 0, before a slow decay.
  const std::size_t size = 31;
  Rows change(size, std::vector<double>(size, 0.0));
  std::vector<double> input(size, 0.0);
  std::vector<double> output(size, 0.0);
  for (std::size_t i = 0; i < size; ++i) {
    change[i][i] = -1.0;
    if (i > 0) change[i][i - 1] = 1.0;
  }
  change[size - 1][size - 1] = -0x1p-20;
  input[0] = 1.0;
  output[size - 1] = 1.0;
  expect_encloses(norm(change, TimeKind::stepwise, input, output), 0x1p20, 1e-4);
}

TEST(EdgeDecayingMotion, IsNotProvedWhereItDoesNotDecay) {
  for (const Rows& flow : {Rows{{0.0}}, Rows{{1e-9}}, Rows{{0.0, 1.0}, {-1.0, 0.0}},
                           Rows{{0.0, 1.0}, {-1.0, 1e-3}}, Rows{{-1.0, 0.0}, {0.0, 0.0}}}) {
    EXPECT_FALSE(DecayingMotion::of(matrix(flow), TimeKind::continuous));
  }
  for (const double ratio : {1.0, -1.0, 1.5, -3.0}) {
    EXPECT_FALSE(DecayingMotion::of(matrix({{ratio - 1.0}}), TimeKind::stepwise));
  }
  IntervalMatrix wide(1, 1);  // some of these grow
  wide(0, 0) = Interval(-1.0, 1e-3);
  EXPECT_FALSE(DecayingMotion::of(wide, TimeKind::continuous));
}

/// A wide matrix encloses the norms of all that it contains.
TEST(PropertyDecayingMotion, HoldsForEveryMatrixWithin) {
  IntervalMatrix wide(1, 1);
  wide(0, 0) = Interval(-1.1, -0.9);
  const auto motion = DecayingMotion::of(wide, TimeKind::continuous);
  ASSERT_TRUE(motion);
  const Interval found = motion->impulse_norm({1.0}, {1.0});
  EXPECT_LE(found.low, 1.0 / 1.1);
  EXPECT_GE(found.high, 1.0 / 0.9);
  EXPECT_LE(found.high, 1.5);
}

/// x⁺ = (1 + A) x step by step.
double summed(const Rows& change, std::vector<double> state, const std::vector<double>& output) {
  double sum = 0.0;
  for (int step = 0; step < 200'000; ++step) {
    double value = 0.0;
    for (std::size_t i = 0; i < state.size(); ++i) value += output[i] * state[i];
    sum += std::abs(value);
    std::vector<double> next = state;
    for (std::size_t i = 0; i < state.size(); ++i) {
      for (std::size_t j = 0; j < state.size(); ++j) next[i] += change[i][j] * state[j];
    }
    state = std::move(next);
  }
  return sum;
}

TEST(PropertyDecayingMotion, EnclosesTheSumOfRandomSteps) {
  SeededDraws draws(20261123);
  int proved = 0;
  for (int i = 0; i < 60; ++i) {
    const std::size_t size = 1 + static_cast<std::size_t>(draws.uniform(0.0, 4.999));
    const double scale = draws.log_uniform(1e-3, 1.0);
    Rows change(size, std::vector<double>(size, 0.0));
    std::vector<double> input;
    std::vector<double> output;
    for (std::size_t row = 0; row < size; ++row) {
      for (double& entry : change[row]) entry = scale * draws.uniform(-0.5, 0.5);
      change[row][row] -= scale;
      input.push_back(draws.uniform(-1.0, 1.0));
      output.push_back(draws.uniform(-1.0, 1.0));
    }
    const auto motion = DecayingMotion::of(matrix(change), TimeKind::stepwise);
    if (!motion) continue;
    ++proved;
    SCOPED_TRACE("case " + std::to_string(i));
    const double exact = summed(change, input, output);
    const Interval found =
        motion->impulse_norm({input.begin(), input.end()}, {output.begin(), output.end()});
    EXPECT_LE(found.low, exact * (1.0 + 1e-9));
    EXPECT_GE(found.high, exact * (1.0 - 1e-9));
    EXPECT_LE(found.high, exact * 1.001);
  }
  EXPECT_GT(proved, 50);
}

}  // namespace
}  // namespace gearlash::decaying_motion_test
