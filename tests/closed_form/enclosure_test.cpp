// What is enclosed of a servo holds what is exact, and what can be decided is.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "base/seeded_draws.hpp"
#include "closed_form/limit_cycle.hpp"
#include "exact_half_cycle.hpp"

namespace gearlash::enclosure_test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Damping over seven decades, or about 1; ratios over twelve; frictions next to 0 and to 1.
NormalizedServo drawn_servo(SeededDraws& draws) {
  const double kind = draws.uniform(0.0, 1.0);
  const double damping = kind < 0.7    ? draws.log_uniform(1e-4, 1e3)
                         : kind < 0.9  ? draws.uniform(0.0, 2.0)
                         : kind < 0.95 ? 1.0 + draws.either_sign(1e-15, 1e-3)
                                       : 1.0;
  const double share = draws.log_uniform(1e-12, 1.0);
  const double side = draws.uniform(0.0, 1.0);
  return {.damping = damping,
          .inertia_ratio = draws.log_uniform(1e-6, 1e6),
          .friction_ratio = side < 0.4   ? draws.uniform(0.0, 1.0)
                            : side < 0.7 ? share
                                         : 1.0 - share,
          .backlash = 1.0};
}

/// Of enclosures, in epsilons.
struct Widths {
  const char* name;
  std::vector<double> all = {};

  void add(const Bounds& bounds, const Digits& exact) {
    ASSERT_TRUE(Digits(bounds.low) <= exact && exact <= Digits(bounds.high))
        << name << " " << exact << " is not in " << bounds.low << " … " << bounds.high;
    if (exact == 0) return;
    all.push_back((bounds.high - bounds.low) / static_cast<double>(exact) / 0x1p-52);
  }
  double median() {
    const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
    std::nth_element(all.begin(), middle, all.end());
    return *middle;
  }
};

class OracleEnclosure : public testing::TestWithParam<std::uint64_t> {};

TEST_P(OracleEnclosure, HoldsWhatIsExactAndIsNarrow) {
  SeededDraws draws(GetParam());
  Widths growth{"growth at rest"};
  Widths amplitude{"amplitude"};
  Widths period{"period"};
  Widths multiplier{"multiplier"};
  constexpr int count = 5000;
  int undecided = 0;
  int without_cycle = 0;
  for (int i = 0; i < count && !HasFatalFailure(); ++i) {
    const NormalizedServo servo = drawn_servo(draws);
    if (servo.friction_ratio == 0.0 || servo.friction_ratio == 1.0) continue;
    SCOPED_TRACE(testing::Message()
                 << servo.damping << " " << servo.inertia_ratio << " " << servo.friction_ratio);
    const LimitCycleAnalysis analysis = enclose_limit_cycles(servo, Reading::exact);
    const ExactHalfCycle exact(servo.damping, servo.inertia_ratio, servo.friction_ratio);
    const Digits exact_growth = exact.growth_at_rest();
    growth.add(analysis.bounds->growth_at_rest, exact_growth);
    if (abs(exact_growth - 1) > Digits(1e-9)) undecided += !analysis.is_proved();
    if (!analysis.is_proved()) continue;
    ASSERT_EQ(analysis.verdict, exact_growth > 1 ? Verdict::hunts : Verdict::cannot_hunt);
    if (analysis.verdict != Verdict::hunts) continue;
    const auto cycle = exact.cycle(0.5 * analysis.cycles.front().separated_time);
    if (!cycle || !analysis.bounds->has_cycle) {
      ++without_cycle;
      continue;
    }
    amplitude.add(analysis.bounds->amplitude, cycle->amplitude_over_backlash);
    period.add(analysis.bounds->period, cycle->period);
    multiplier.add(analysis.bounds->multiplier, cycle->multiplier);
  }
  RecordProperty("median width of growth at rest, epsilons", std::to_string(growth.median()));
  RecordProperty("of amplitude", std::to_string(amplitude.median()));
  RecordProperty("of period", std::to_string(period.median()));
  RecordProperty("of multiplier", std::to_string(multiplier.median()));
  EXPECT_LE(undecided, count / 1000);
  EXPECT_LE(without_cycle, count / 1000);
  EXPECT_GT(amplitude.all.size(), std::size_t{2500});
  EXPECT_LT(growth.median(), 100.0);
  EXPECT_LT(amplitude.median(), 1000.0);
  EXPECT_LT(period.median(), 300.0);
}

INSTANTIATE_TEST_SUITE_P(Seeds, OracleEnclosure, testing::Values(1831, 1832, 1833, 1834));

TEST(PropertyEnclosure, DecimalsAndDrivetrainsHoldTheServoToo) {
  constexpr std::uint64_t seed = 1835;
  SCOPED_TRACE(seed);
  SeededDraws draws(seed);
  for (int i = 0; i < 2000; ++i) {
    const NormalizedServo servo = drawn_servo(draws);
    if (servo.friction_ratio == 0.0 || servo.friction_ratio == 1.0) continue;
    const ExactHalfCycle exact(servo.damping, servo.inertia_ratio, servo.friction_ratio);
    const Digits growth = exact.growth_at_rest();
    for (const Reading reading : {Reading::decimal, Reading::converted}) {
      const Bounds bounds = enclose_limit_cycles(servo, reading).bounds->growth_at_rest;
      ASSERT_TRUE(Digits(bounds.low) <= growth && growth <= Digits(bounds.high));
    }
  }
}

TEST(EdgeEnclosure, FrictionOnOneSideOnlyIsATheorem) {
  for (const double share : {0.0, 1.0}) {
    const NormalizedServo servo{
        .damping = 0.3, .inertia_ratio = 2.0, .friction_ratio = share, .backlash = 0.3};
    const LimitCycleAnalysis analysis = enclose_limit_cycles(servo, Reading::decimal);
    EXPECT_EQ(analysis.verdict, Verdict::hunts);
    EXPECT_EQ(analysis.certainty, Certainty::theorem);
    EXPECT_EQ(analysis.bounds->growth_at_rest.low, infinity);
    const Bounds amplitude = analysis.bounds->amplitude;
    EXPECT_TRUE(amplitude.contains(analysis.cycles.front().amplitude / servo.backlash));
    EXPECT_LT(amplitude.high / amplitude.low - 1.0, 1e-12);
  }
}

TEST(EdgeEnclosure, MasslessSidesAreEnclosed) {
  for (const double ratio : {0.0, infinity}) {
    for (const double damping : {0.05, 0.3, 1.0, 3.0, 100.0}) {
      for (const double friction : {0.001, 0.1, 0.5, 0.9, 0.999}) {
        const NormalizedServo servo{.damping = damping,
                                    .inertia_ratio = ratio,
                                    .friction_ratio = friction,
                                    .backlash = 1.0};
        const LimitCycleAnalysis analysis = enclose_limit_cycles(servo, Reading::exact);
        ASSERT_TRUE(analysis.is_proved());
        const CycleBounds& bounds = *analysis.bounds;
        EXPECT_TRUE(bounds.growth_at_rest.contains(analysis.growth_at_rest));
        if (analysis.verdict != Verdict::hunts) continue;
        // Computed to some 1e-14, enclosed to as much.
        EXPECT_NEAR(analysis.cycles.front().amplitude,
                    0.5 * (bounds.amplitude.low + bounds.amplitude.high),
                    1e-11 * bounds.amplitude.high);
        EXPECT_LT(bounds.amplitude.high / bounds.amplitude.low - 1.0, 1e-9);
        EXPECT_NEAR(analysis.cycles.front().multiplier,
                    0.5 * (analysis.bounds->multiplier.low + analysis.bounds->multiplier.high),
                    1e-11);
      }
    }
  }
}

TEST(EdgeEnclosure, DecimalsStandForThemselves) {
  // 0.25 is a double, 0.1 is not: its neighbours hold the decimal.
  const NormalizedServo servo{
      .damping = 0.25, .inertia_ratio = 2.0, .friction_ratio = 0.1, .backlash = 0.3};
  const ServoBox box = box_of(servo, Reading::decimal);
  EXPECT_EQ(box.damping, (Bounds{0.25, 0.25}));
  const ServoBox exact = box_of(servo, Reading::exact);
  EXPECT_LE(box.load_rate.low, exact.load_rate.low);
  EXPECT_GE(box.load_rate.high, exact.load_rate.high);
  EXPECT_GT(box.load_rate.high - box.load_rate.low, exact.load_rate.high - exact.load_rate.low);
}

}  // namespace
}  // namespace gearlash::enclosure_test
