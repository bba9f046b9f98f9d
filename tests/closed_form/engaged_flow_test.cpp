// The engaged flow and its zeros against the exponential of its matrix in fifty digits.
#include "closed_form/engaged_flow.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "base/fifty_digits.hpp"
#include "base/seeded_draws.hpp"

namespace gearlash::engaged_flow_test {
namespace {

struct WideState {
  Wide position;
  Wide speed;
};

WideMatrix<2> wide_flow(double damping, const Wide& time) {
  return exponential<2>({{{0, time}, {-time, -2 * Wide(damping) * time}}});
}

WideState wide_at(const EngagedFlow& flow, const Wide& time) {
  const WideMatrix<2> m = wide_flow(flow.damping, time);
  return {m[0][0] * flow.position + m[0][1] * flow.speed,
          m[1][0] * flow.position + m[1][1] * flow.speed};
}

/// What one epsilon in the data can do: the rates times time enter exponentials and angles, so the
/// terms of the closed form carry (1 + rate t) epsilons each. Below ζ = 1 the two rates are one
/// complex pair of modulus 1.
struct Scale {
  double position;
  double speed;
};

Scale scale_of(const EngagedFlow& flow, double time) {
  const double zeta = flow.damping;
  const double p = std::abs(flow.position);
  const double v = std::abs(flow.speed);
  if (zeta < 1.0) {
    const double w = std::sqrt((1.0 - zeta) * (1.0 + zeta));
    const double size =
        (p + v) * std::exp(-zeta * time) * (1.0 + time) * (1.0 + std::min(time, 1.0 / w));
    return {size, size};
  }
  const double half_split = std::sqrt((zeta - 1.0) * (zeta + 1.0));
  const double fast = zeta + half_split;
  const double slow = 1.0 / fast;
  const double decay = std::exp(-slow * time) * (1.0 + slow * time);
  const double impulse = decay * std::min(time, 0.5 / half_split);
  const double fast_decay = std::exp(-fast * time) * (1.0 + fast * time);
  return {p * (decay + slow * impulse) + v * impulse,
          v * (fast_decay + slow * impulse) + p * impulse};
}

/// Measured at most 3; eight is what the dozen roundings of the closed form could add up to.
constexpr double flow_epsilons = 8.0;

void expect_exact(const EngagedFlow& flow, double time) {
  const EngagedFlow::State actual = flow.at(time);
  const WideState exact = wide_at(flow, time);
  const Scale scale = scale_of(flow, time);
  EXPECT_LE(epsilons_of(actual.position, exact.position, scale.position), flow_epsilons)
      << "damping " << flow.damping << " time " << time;
  EXPECT_LE(epsilons_of(actual.speed, exact.speed, scale.speed), flow_epsilons)
      << "damping " << flow.damping << " time " << time;
}

double random_damping(SeededDraws& draws) {
  const double kind = draws.uniform(0.0, 1.0);
  if (kind < 0.1) return draws.one_of({0.0, 1.0, 1000.0, 1e-12});
  if (kind < 0.4) return std::abs(1.0 + draws.either_sign(1e-16, 1e-3));
  if (kind < 0.8) return draws.uniform(0.0, 2.0);
  return draws.log_uniform(1.0, 1000.0);
}

TEST(OracleEngagedFlow, RandomStatesAgainstTheMatrixExponential) {
  constexpr std::uint64_t seed = 271;
  SCOPED_TRACE(seed);
  SeededDraws draws(seed);
  for (int i = 0; i < 4000 && !testing::Test::HasFailure(); ++i) {
    const EngagedFlow flow{random_damping(draws), draws.uniform(-1.0, 1.0),
                           draws.uniform(-1.0, 1.0)};
    expect_exact(flow, draws.log_uniform(1e-9, 100.0));
  }
}

TEST(EdgeEngagedFlow, TimeZeroIsTheInitialStateExactly) {
  for (const double damping :
       {0.0, 0.3, std::nextafter(1.0, 0.0), 1.0, std::nextafter(1.0, 2.0), 3.0, 1000.0}) {
    const EngagedFlow::State state = EngagedFlow{damping, 0.3, -0.7}.at(0.0);
    EXPECT_EQ(state.position, 0.3) << damping;
    EXPECT_EQ(state.speed, -0.7) << damping;
  }
}

TEST(EdgeEngagedFlow, ThroughCriticalDampingFromBothSides) {
  for (const double offset : {1e-3, 1e-5, 1e-7, 1e-9, 1e-11, 1e-13, 1e-15, 1e-16, 0.0}) {
    for (const double side : {-1.0, 1.0}) {
      for (const double time : {1e-6, 0.1, 1.0, 7.0, 40.0}) {
        expect_exact({1.0 + side * offset, 1.0, -1.0}, time);
        expect_exact({1.0 + side * offset, 0.25, 3.0}, time);
      }
    }
  }
}

TEST(EdgeEngagedFlow, LongTimesDecayOrKeepTurning) {
  for (const double time : {1e3, 1e5, 1e7}) expect_exact({0.0, 1.0, 0.5}, time);
  const EngagedFlow::State rest = EngagedFlow{0.5, 1.0, 1.0}.at(1e9);
  EXPECT_EQ(rest.position, 0.0);
  EXPECT_EQ(rest.speed, 0.0);
  // Slow decay of an overdamped servo: e^{−t/2000} is left.
  expect_exact({1000.0, 1.0, 0.0}, 2000.0);
  expect_exact({1000.0, 1.0, 0.0}, 1e-4);
}

TEST(PropertyEngagedFlow, Semigroup) {
  constexpr std::uint64_t seed = 272;
  SCOPED_TRACE(seed);
  SeededDraws draws(seed);
  for (int i = 0; i < 20000; ++i) {
    const EngagedFlow flow{random_damping(draws), draws.uniform(-1.0, 1.0),
                           draws.uniform(-1.0, 1.0)};
    const double first = draws.log_uniform(1e-6, 20.0);
    const double second = draws.log_uniform(1e-6, 20.0);
    const EngagedFlow::State middle = flow.at(first);
    const EngagedFlow::State split =
        EngagedFlow{flow.damping, middle.position, middle.speed}.at(second);
    const EngagedFlow::State whole = flow.at(first + second);
    const Scale scale = scale_of(flow, first + second);
    // The middle state carries its own error through the second flow, whose terms are no larger
    // than those of scale_of for a state of the same bound; the sum first + second is rounded too.
    const Scale at_first = scale_of(flow, first);
    const Scale carried = scale_of({flow.damping, at_first.position, at_first.speed}, second);
    ASSERT_NEAR(split.position, whole.position,
                2.0 * flow_epsilons * epsilon * (scale.position + carried.position))
        << flow.damping << " " << first << " " << second;
    ASSERT_NEAR(split.speed, whole.speed,
                2.0 * flow_epsilons * epsilon * (scale.speed + carried.speed))
        << flow.damping << " " << first << " " << second;
  }
}

// ---- first_zero ---------------------------------------------------------------------------------

/// The exact zero nearest to `time` by Newton's method in fifty digits.
Wide refined_zero(double damping, double value, double slope, double time) {
  Wide root = time;
  for (int i = 0; i < 4; ++i) {
    const WideState x = wide_at({damping, value, slope}, root);
    root -= x.position / x.speed;
  }
  return root;
}

/// An epsilon in value or slope moves x(t) by an epsilon of each response, and the zero by that
/// over the slope there.
double zero_scale(double damping, double value, double slope, double zero) {
  const WideMatrix<2> m = wide_flow(damping, zero);
  const Wide moved = abs(value * m[0][0]) + abs(slope * m[0][1]);
  const Wide rate = abs(m[1][0] * value + m[1][1] * slope);
  return zero + static_cast<double>(moved / rate);
}

void expect_first_zero(double damping, double value, double slope) {
  SCOPED_TRACE(testing::Message() << "damping " << damping << " value " << value << " slope "
                                  << slope);
  const double zero = first_zero(damping, value, slope);
  ASSERT_GT(zero, 0.0);
  const double beyond = std::isinf(zero) ? 200.0 : zero;
  const double start_sign = value != 0.0 ? value : slope;
  const EngagedFlow flow{damping, value, slope};
  for (int k = 1; k < 400; ++k) {
    // Rounding decides the sign in the last few parts before the zero.
    const double time = beyond * k / 400.0 * (1.0 - 1e-9);
    const double x = flow.at(time).position;
    const double noise = flow_epsilons * epsilon * scale_of(flow, time).position;
    ASSERT_FALSE(x * start_sign < 0.0 && std::abs(x) > noise) << "missed a zero before " << time;
  }
  if (std::isinf(zero)) return;
  const Wide exact = refined_zero(damping, value, slope, zero);
  EXPECT_LE(epsilons_of(zero, exact, zero_scale(damping, value, slope, zero)), 8.0);
}

TEST(OracleFirstZero, RandomAgainstFiftyDigitRoots) {
  constexpr std::uint64_t seed = 273;
  SCOPED_TRACE(seed);
  SeededDraws draws(seed);
  for (int i = 0; i < 1500 && !testing::Test::HasFailure(); ++i) {
    const double damping = random_damping(draws);
    const double value = draws.either_sign(1e-12, 1.0);
    const double slope = draws.either_sign(1e-12, 1.0) * std::max(1.0, damping);
    expect_first_zero(damping, value, slope);
  }
}

TEST(EdgeFirstZero, StartingOnTheZeroItIsNotCounted) {
  for (const double damping : {0.0, 0.5, 0.999}) {
    expect_first_zero(damping, 0.0, 1.0);
    expect_first_zero(damping, 0.0, -1.0);
  }
  EXPECT_EQ(first_zero(1.0, 0.0, 1.0), infinity);
  EXPECT_EQ(first_zero(2.0, 0.0, -1.0), infinity);
  EXPECT_EQ(first_zero(0.2, 0.0, 0.0), infinity);
  EXPECT_EQ(first_zero(1.0, 0.0, 0.0), infinity);
  EXPECT_EQ(first_zero(5.0, 0.0, 0.0), infinity);
}

TEST(EdgeFirstZero, TinyValuesOnEitherSide) {
  expect_first_zero(0.2, 1e-300, -1.0);
  expect_first_zero(0.2, 1e-300, 1.0);
  expect_first_zero(0.2, -1e-300, 1.0);
  expect_first_zero(1.0, 1e-300, -1.0);
  expect_first_zero(10.0, 1e-300, -1.0);
  expect_first_zero(0.0, 1.0, 0.0);
  expect_first_zero(0.0, 1.0, 1e-300);
  EXPECT_EQ(first_zero(1.0, 1.0, 1e-300), infinity);
}

TEST(EdgeFirstZero, OverdampedHasOneOnlyBeyondTheFastDirection) {
  // x = e^{−λ₂t} exactly along the fast direction: no zero; a little steeper: one.
  for (const double damping : {1.0, 1.0 + 1e-12, 1.5, 4.0, 1000.0}) {
    const double fast = damping + std::sqrt((damping - 1.0) * (damping + 1.0));
    EXPECT_EQ(first_zero(damping, 1.0, -0.999 * fast), infinity) << damping;
    EXPECT_EQ(first_zero(damping, 1.0, 0.0), infinity) << damping;
    EXPECT_EQ(first_zero(damping, 1.0, 5.0), infinity) << damping;
    expect_first_zero(damping, 1.0, -1.001 * fast);
    expect_first_zero(damping, 1.0, -100.0 * fast);
  }
}

TEST(EdgeFirstZero, ContinuousThroughCriticalDamping) {
  for (const double offset : {1e-3, 1e-6, 1e-9, 1e-12, 1e-15, 1e-16, 0.0}) {
    for (const double side : {-1.0, 1.0}) {
      const double damping = 1.0 + side * offset;
      expect_first_zero(damping, 1.0, -2.0);
      expect_first_zero(damping, -0.3, 10.0);
      // At ζ = 1 the zero is at −x₀/(ẋ₀ + x₀) = 1; the derivative there by ζ is of order one.
      EXPECT_NEAR(first_zero(damping, 1.0, -2.0), 1.0, 2.0 * offset + 4.0 * epsilon);
    }
  }
}

}  // namespace
}  // namespace gearlash::engaged_flow_test
