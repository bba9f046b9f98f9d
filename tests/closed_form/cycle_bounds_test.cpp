// Bounds of a box hold for servos drawn from it, and close in on them as the box shrinks.
#include "closed_form/cycle_bounds.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/traced_draws.hpp"
#include "closed_form/limit_cycle.hpp"

namespace gearlash::cycle_bounds_test {
namespace {

/// Servos between two, of each number.
struct Range {
  NormalizedServo low;
  NormalizedServo high;

  NormalizedServo at(double damping, double inertia_ratio, double friction_ratio) const {
    return {.damping = low.damping + damping * (high.damping - low.damping),
            .inertia_ratio =
                std::isinf(low.inertia_ratio)
                    ? low.inertia_ratio
                    : low.inertia_ratio + inertia_ratio * (high.inertia_ratio - low.inertia_ratio),
            .friction_ratio =
                low.friction_ratio + friction_ratio * (high.friction_ratio - low.friction_ratio),
            .backlash = 1.0};
  }
  ServoBox box() const {
    const auto motor_rate = [](double damping, double ratio, double friction_ratio) {
      return 2.0 * damping * (1.0 - friction_ratio) * (1.0 + ratio);
    };
    const auto load_rate = [](double damping, double ratio, double friction_ratio) {
      return 2.0 * damping * friction_ratio * (1.0 + 1.0 / ratio);
    };
    return {.damping = {low.damping, high.damping},
            .motor_inertia = {1.0 / (1.0 + high.inertia_ratio), 1.0 / (1.0 + low.inertia_ratio)},
            .load_inertia = {1.0 / (1.0 + 1.0 / low.inertia_ratio),
                             1.0 / (1.0 + 1.0 / high.inertia_ratio)},
            .motor_rate = {motor_rate(low.damping, low.inertia_ratio, high.friction_ratio),
                           motor_rate(high.damping, high.inertia_ratio, low.friction_ratio)},
            .load_rate = {load_rate(low.damping, high.inertia_ratio, low.friction_ratio),
                          load_rate(high.damping, low.inertia_ratio, high.friction_ratio)}};
  }
};

/// One in ten has no load inertia, one in ten no motor inertia.
double drawn_inertia_ratio(SeededDraws& draws) {
  const double kind = draws.uniform(0.0, 1.0);
  if (kind < 0.1) return 0.0;
  return kind < 0.2 ? std::numeric_limits<double>::infinity() : draws.log_uniform(1e-3, 1e3);
}

Range drawn_range(SeededDraws& draws, double width) {
  const NormalizedServo low{.damping = draws.log_uniform(0.005, 300.0),
                            .inertia_ratio = drawn_inertia_ratio(draws),
                            .friction_ratio = draws.uniform(0.01, 0.99)};
  NormalizedServo high = low;
  high.damping *= 1.0 + width * draws.uniform(0.0, 1.0);
  high.inertia_ratio *= 1.0 + width * draws.uniform(0.0, 1.0);
  high.friction_ratio += width * (1.0 - low.friction_ratio) * draws.uniform(0.0, 1.0);
  return {low, high};
}

double flight_time_of(const LimitCycleAnalysis& analysis) {
  if (analysis.cycles.empty()) return std::numeric_limits<double>::quiet_NaN();
  return 0.5 * analysis.cycles.front().separated_time;
}

void expect_within(const Bounds& bounds, double value) {
  EXPECT_GE(value, bounds.low);
  EXPECT_LE(value, bounds.high);
}

class PropertyCycleBounds : public testing::TestWithParam<double> {};

TEST_P(PropertyCycleBounds, HoldForEveryServoOfTheBox) {
  TracedDraws draws(20261121);
  for (int i = 0; i < 2000; ++i) {
    const Range range = drawn_range(draws, GetParam());
    const double guess = flight_time_of(analyse_limit_cycles(range.at(0.5, 0.5, 0.5)));
    const CycleBounds bounds = bound_cycles(range.box(), guess);
    for (int k = 0; k < 5; ++k) {
      const LimitCycleAnalysis analysis = analyse_limit_cycles(
          range.at(draws.uniform(0.0, 1.0), draws.uniform(0.0, 1.0), draws.uniform(0.0, 1.0)));
      expect_within(bounds.growth_at_rest, analysis.growth_at_rest);
      const bool hunts = analysis.verdict == Verdict::hunts;
      EXPECT_FALSE(hunts ? bounds.none_hunt() : bounds.all_hunt());
      if (!hunts) continue;
      expect_within(bounds.amplitude, analysis.cycles.front().amplitude);
      expect_within(bounds.period, analysis.cycles.front().period);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Widths, PropertyCycleBounds, testing::Values(1.0, 0.1, 1e-2, 1e-4, 1e-8));

TEST(PropertyCycleBounds, CloseInInProportionToTheWidth) {
  TracedDraws draws(1966);
  int compared = 0;
  for (int i = 0; i < 1000; ++i) {
    constexpr double width = 1e-6;
    const Range range = drawn_range(draws, width);
    const LimitCycleAnalysis middle = analyse_limit_cycles(range.at(0.5, 0.5, 0.5));
    const CycleBounds bounds = bound_cycles(range.box(), flight_time_of(middle));
    // Else hunting ends nearby, where everything changes faster.
    if (middle.growth_at_rest > 0.9 && middle.growth_at_rest < 1.1) continue;
    ++compared;
    ASSERT_TRUE(bounds.all_hunt() || bounds.none_hunt());
    if (bounds.none_hunt()) continue;
    EXPECT_LT(bounds.amplitude.high / bounds.amplitude.low - 1.0, 2e4 * width);
    EXPECT_LT(bounds.period.high / bounds.period.low - 1.0, 2e4 * width);
  }
  EXPECT_GT(compared, 800);
}

TEST(EdgeCycleBounds, AreTrueWithoutAGuessAndWithABadOne) {
  const Range range{{.damping = 0.19, .inertia_ratio = 2.0, .friction_ratio = 0.1},
                    {.damping = 0.191, .inertia_ratio = 2.01, .friction_ratio = 0.101}};
  const LimitCycle cycle = analyse_limit_cycles(range.at(0.3, 0.6, 0.1)).cycles.at(0);
  for (const double guess : {std::numeric_limits<double>::quiet_NaN(), 0.0, 1e-9, 0.1, 10.0, 1e9}) {
    const CycleBounds bounds = bound_cycles(range.box(), guess);
    EXPECT_TRUE(bounds.all_hunt());
    expect_within(bounds.amplitude, cycle.amplitude);
    expect_within(bounds.period, cycle.period);
  }
}

}  // namespace
}  // namespace gearlash::cycle_bounds_test
