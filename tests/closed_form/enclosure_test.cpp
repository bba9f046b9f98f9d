// What is enclosed of a servo holds what is exact, and what can be decided is.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/references.hpp"
#include "closed_form/limit_cycle.hpp"

namespace gearlash::enclosure_test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Of enclosures, in epsilons.
struct Widths {
  const char* name;
  std::vector<double> all = {};

  void add(const Bounds& bounds, Wide exact) {
    EXPECT_TRUE(bounds.low <= exact && exact <= bounds.high)
        << name << " " << exact << " is not in " << bounds.low << " … " << bounds.high;
    if (exact != 0)
      all.push_back((bounds.high - bounds.low) / static_cast<double>(exact) / epsilon);
  }
  double median() {
    const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
    std::nth_element(all.begin(), middle, all.end());
    return *middle;
  }
};

NormalizedServo servo_of(const Reference& exact) {
  return {.damping = exact.input("damping"),
          .inertia_ratio = exact.input("inertia_ratio"),
          .friction_ratio = exact.input("friction_ratio"),
          .backlash = 1.0};
}

TEST(OracleEnclosure, HoldsWhatIsExactAndIsNarrow) {
  Widths growth{"growth"};
  Widths amplitude{"amplitude"};
  Widths period{"period"};
  Widths multiplier{"multiplier"};
  std::size_t undecided = 0;
  std::size_t without_cycle = 0;
  for (const Reference& exact : References("closed_form", "plastic_cycles")) {
    const NormalizedServo servo = servo_of(exact);
    SCOPED_TRACE(testing::Message()
                 << servo.damping << " " << servo.inertia_ratio << " " << servo.friction_ratio);
    const LimitCycleAnalysis analysis = enclose_limit_cycles(servo, Reading::exact);
    growth.add(analysis.bounds->growth_at_rest, exact["growth"]);
    if (std::abs(exact["growth"] - 1) > 1e-9) undecided += analysis.is_proved() ? 0U : 1U;
    if (!analysis.is_proved()) continue;
    EXPECT_EQ(analysis.verdict, exact["growth"] > 1 ? Verdict::hunts : Verdict::cannot_hunt);
    if (analysis.verdict != Verdict::hunts) continue;
    if (!analysis.bounds->has_cycle) {
      ++without_cycle;
      continue;
    }
    amplitude.add(analysis.bounds->amplitude, exact["amplitude"]);
    period.add(analysis.bounds->period, exact["period"]);
    multiplier.add(analysis.bounds->multiplier, exact["multiplier"]);
  }
  RecordProperty("median width of growth at rest, epsilons", std::to_string(growth.median()));
  RecordProperty("of amplitude", std::to_string(amplitude.median()));
  RecordProperty("of period", std::to_string(period.median()));
  RecordProperty("of multiplier", std::to_string(multiplier.median()));
  EXPECT_LE(undecided, growth.all.size() / 1000);
  EXPECT_LE(without_cycle, growth.all.size() / 1000);
  EXPECT_GT(amplitude.all.size(), growth.all.size() / 2);
  EXPECT_LT(growth.median(), 100.0);
  EXPECT_LT(amplitude.median(), 1000.0);
  EXPECT_LT(period.median(), 300.0);
}

TEST(PropertyEnclosure, DecimalsAndDrivetrainsHoldTheServoToo) {
  for (const Reference& exact : References("closed_form", "plastic_cycles")) {
    for (const Reading reading : {Reading::decimal, Reading::converted}) {
      const Bounds bounds = enclose_limit_cycles(servo_of(exact), reading).bounds->growth_at_rest;
      ASSERT_TRUE(bounds.low <= exact["growth"] && exact["growth"] <= bounds.high);
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
