// Derivatives of the plastic cycle against central differences of its equations in many digits.
#include "closed_form/cycle_derivatives.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>

#include "base/described.hpp"
#include "base/range_check.hpp"
#include "base/references.hpp"
#include "base/traced_draws.hpp"
#include "closed_form/growth_at_rest.hpp"
#include "closed_form/limit_cycle.hpp"

namespace gearlash::cycle_sensitivity_test {
namespace {

struct Field {
  std::string name;
  double NormalizedServo::*present;
  double ServoGradient::*slope;
};
const Field fields[] = {
    {"damping", &NormalizedServo::damping, &ServoGradient::damping},
    {"inertia_ratio", &NormalizedServo::inertia_ratio, &ServoGradient::inertia_ratio},
    {"friction_ratio", &NormalizedServo::friction_ratio, &ServoGradient::friction_ratio}};

/// Any servos, and those that hunt, also next to the boundary (as 1/ln μ₀ there, of which some
/// digits go), of light damping (∂ ln ρ, of order ζ, is a sum of terms of order t₂ ~ (8πζ)^¼),
/// about critical damping, and with a massless side.
class OracleCycleSensitivity : public testing::Test {
 protected:
  void compare(const Reference& exact) {
    const NormalizedServo servo{.damping = exact.input("damping"),
                                .inertia_ratio = exact.input("inertia_ratio"),
                                .friction_ratio = exact.input("friction_ratio"),
                                .backlash = draws_.log_uniform(1e-3, 1.0)};
    SCOPED_TRACE(exact.kind() + ": " + described(servo));
    const CycleSensitivity found = cycle_sensitivity(servo);
    ASSERT_EQ(found.available(), !std::isnan(exact["amplitude"]));
    compare(found.growth_at_rest, "growth", 1.0, servo, exact);
    if (!found.available()) return;
    const LimitCycleAnalysis analysis = analyse_limit_cycles(servo);
    EXPECT_EQ(found.amplitude.value, analysis.cycles.at(0).amplitude);
    EXPECT_EQ(found.period.value, analysis.cycles[0].period);
    EXPECT_EQ(found.multiplier.value, analysis.cycles[0].multiplier);
    EXPECT_EQ(found.amplitude.slope.backlash, found.amplitude.value / servo.backlash);
    compare(found.amplitude, "amplitude", servo.backlash, servo, exact);
    compare(found.period, "period", 1.0, servo, exact);
    compare(found.multiplier, "multiplier", 1.0, servo, exact);
  }
  void TearDown() override {
    for (const auto& [name, share] : worst_) RecordProperty(name, exact_text(share));
  }

 private:
  /// Of max(|derivative|, |value/parameter|). The growth of overdamped servos is a power whose
  /// exponent is a quotient of their rates.
  static double tolerance(const Reference& exact, const std::string& quantity) {
    if (quantity == "growth") return (exact["damping"] > 1 ? 192.0 : 64.0) * epsilon;
    const bool is_hard = exact.kind() == "boundary" || exact.kind() == "light";
    return (is_hard ? 8.0 : 1.0) * 512.0 * epsilon;
  }

  void compare(const SensitiveValue& found, const std::string& quantity, Wide unit,
               const NormalizedServo& servo, const Reference& exact) {
    const bool is_massless = exact.kind().starts_with("massless");
    const Wide value = exact[quantity] * unit;
    for (const Field& field : fields) {
      const Wide slope = exact[quantity + ":" + field.name] * unit;
      const bool by_inertia = field.name == "inertia_ratio";
      auto member = field.slope;
      Wide per = servo.*field.present;
      double allowed = tolerance(exact, quantity);
      if (is_massless) {
        // Of max(|derivative|, |value|), or by the inertia max(|derivative|, |value|/F): what a
        // light side does it does by J/F.
        if (by_inertia) member = &ServoGradient::load_share;
        per = by_inertia ? light_friction(servo) : 1.0;
        allowed = by_inertia ? 1e-9 : 1e-11;
      }
      const Wide scale = std::max(std::abs(slope), std::abs(value / per));
      const Wide error = std::abs(found.slope.*member - slope);
      EXPECT_LE(error, allowed * scale) << quantity << " by " << field.name;
      double& worst = worst_[exact.kind() + " " + quantity];
      if (scale > 0) worst = std::max(worst, static_cast<double>(error / scale) / allowed);
    }
  }
  static double light_friction(const NormalizedServo& servo) {
    const double share =
        servo.inertia_ratio == 0.0 ? servo.friction_ratio : 1.0 - servo.friction_ratio;
    return 2.0 * servo.damping * share;
  }

  SeededDraws draws_{2101};
  std::map<std::string, double> worst_;  ///< errors as shares of what is allowed
};

TEST_F(OracleCycleSensitivity, IsThatOfTheEquationsInManyDigits) {
  for (const Reference& exact : References("closed_form", "plastic_slopes")) compare(exact);
}

// ---- edges --------------------------------------------------------------------------------------

constexpr NormalizedServo sample{
    .damping = 0.19, .inertia_ratio = 2.0, .friction_ratio = 0.1, .backlash = 0.3};

/// By Richardson's extrapolation of central differences, good to some 1e-9 of value/parameter.
template <class Value>
double numerical_slope(const NormalizedServo& servo, double NormalizedServo::*number, double step,
                       const Value& value_of) {
  const auto at = [&](double shift) {
    NormalizedServo changed = servo;
    changed.*number += shift;
    return value_of(changed);
  };
  const auto difference = [&](double h) { return (at(h) - at(-h)) / (2.0 * h); };
  return (4.0 * difference(0.5 * step) - difference(step)) / 3.0;
}

double numerical_slope(const NormalizedServo& servo, double NormalizedServo::*number, double step,
                       double LimitCycle::*quantity) {
  return numerical_slope(servo, number, step, [&](const NormalizedServo& changed) {
    return analyse_limit_cycles(changed).cycles.at(0).*quantity;
  });
}

TEST(EdgeCycleSensitivity, EqualRatesAndExactlyCriticalDamping) {
  // c = D where the shares of friction and inertia agree.
  for (const NormalizedServo& servo :
       {NormalizedServo{0.1, 1.0, 0.5, 1.0}, NormalizedServo{0.1, 3.0, 0.75, 1.0},
        NormalizedServo{1.0, 100.0, 0.02, 1.0}, NormalizedServo{1.0, 0.01, 0.98, 1.0}}) {
    SCOPED_TRACE(described(servo));
    const CycleSensitivity found = cycle_sensitivity(servo);
    ASSERT_TRUE(found.available());
    for (const Field& field : fields) {
      const double step = 1e-3 * std::min(servo.*field.present, 1.0 - servo.friction_ratio);
      const auto expect_near = [&](const SensitiveValue& value, double LimitCycle::*quantity) {
        EXPECT_NEAR(
            value.slope.*field.slope, numerical_slope(servo, field.present, step, quantity),
            1e-8 * (std::abs(value.slope.*field.slope) + value.value / servo.*field.present))
            << field.name;
      };
      expect_near(found.amplitude, &LimitCycle::amplitude);
      expect_near(found.period, &LimitCycle::period);
      expect_near(found.multiplier, &LimitCycle::multiplier);
    }
  }
}

TEST(EdgeCycleSensitivity, FrictionOnOneSideAloneHasACycleAndNoGrowthToDifferentiate) {
  for (const double friction_ratio : {0.0, 1.0}) {
    NormalizedServo servo = sample;
    servo.friction_ratio = friction_ratio;
    const CycleSensitivity found = cycle_sensitivity(servo);
    ASSERT_TRUE(found.available());
    EXPECT_TRUE(std::isinf(found.growth_at_rest.value));
    EXPECT_TRUE(std::isnan(found.growth_at_rest.slope.damping));
    EXPECT_NEAR(found.amplitude.slope.damping,
                numerical_slope(servo, &NormalizedServo::damping, 1e-3, &LimitCycle::amplitude),
                1e-8);
    EXPECT_TRUE(std::isfinite(found.amplitude.slope.friction_ratio));
  }
}

TEST(EdgeCycleSensitivity, WithoutACycleTheGrowthAloneHasDerivatives) {
  NormalizedServo servo = sample;
  servo.damping = 0.9;
  servo.friction_ratio = 0.5;
  CycleSensitivity found = cycle_sensitivity(servo);
  EXPECT_EQ(found.outcome, SensitivityOutcome::no_cycle);
  EXPECT_LT(found.growth_at_rest.value, 1.0);
  EXPECT_LT(found.growth_at_rest.slope.damping, 0.0);
  EXPECT_TRUE(std::isnan(found.amplitude.value));
  EXPECT_TRUE(std::isnan(found.amplitude.slope.damping));
  servo = sample;
  servo.backlash = 0.0;
  found = cycle_sensitivity(servo);
  EXPECT_EQ(found.outcome, SensitivityOutcome::no_cycle);
  EXPECT_GT(found.growth_at_rest.value, 1.0);
}

TEST(EdgeCycleSensitivity, WhatIsNotWorkedOutSaysSo) {
  NormalizedServo servo = sample;
  servo.damping = 0.0;
  EXPECT_EQ(cycle_sensitivity(servo).outcome, SensitivityOutcome::undamped);
  servo.damping = -1.0;
  EXPECT_THROW(cycle_sensitivity(servo), InvalidInput);
}

/// Size, period, multiplier and growth at rest go back to those of e = 0 as e³, so that the
/// derivative from above is 0: with half the restitution an eighth is left.
TEST(PropertyCycleSensitivity, SmallRestitutionActsToThirdOrder) {
  for (const NormalizedServo& servo :
       {sample, NormalizedServo{0.3, 2.0, 0.3, 0.3}, NormalizedServo{0.1, 1.0, 0.2, 1.0}}) {
    SCOPED_TRACE(described(servo));
    EXPECT_EQ(cycle_sensitivity(servo).amplitude.slope.restitution, 0.0);
    const LimitCycleAnalysis plastic = analyse_limit_cycles(servo);
    const auto with_bounces = [&](double restitution) {
      NormalizedServo bouncing = servo;
      bouncing.restitution = restitution;
      return analyse_limit_cycles(bouncing);
    };
    const LimitCycleAnalysis coarse = with_bounces(0.01);
    const LimitCycleAnalysis fine = with_bounces(0.005);
    const auto expect_third_order = [](double at_zero, double at_fine, double at_coarse) {
      EXPECT_LE(std::abs(at_fine - at_zero), 0.15 * std::abs(at_coarse - at_zero) + 1e-9 * at_zero);
      EXPECT_LE(std::abs(at_coarse - at_zero), 1e-4 * at_zero);
    };
    const LimitCycle& rest = plastic.cycles.at(0);
    const LimitCycle& near = *largest_stable(fine);
    const LimitCycle& far = *largest_stable(coarse);
    expect_third_order(rest.amplitude, near.amplitude, far.amplitude);
    expect_third_order(rest.period, near.period, far.period);
    expect_third_order(rest.multiplier, near.multiplier, far.multiplier);
    expect_third_order(plastic.growth_at_rest, fine.growth_at_rest, coarse.growth_at_rest);
  }
}

// ---- with bounces -------------------------------------------------------------------------------

/// Of the growth at rest; bouncing_sensitivity_test.cpp has the cycle's.
TEST(PropertyCycleSensitivity, GrowthWithBouncesAgreesWithDifferences) {
  TracedDraws draws(2105);
  for (int i = 0; i < 25; ++i) {
    const NormalizedServo servo{.damping = draws.uniform(0.05, 0.5),
                                .inertia_ratio = draws.log_uniform(0.2, 5.0),
                                .friction_ratio = draws.uniform(0.1, 0.9),
                                .backlash = draws.log_uniform(0.01, 1.0),
                                .restitution = draws.uniform(0.02, 0.8)};
    SCOPED_TRACE(described(servo));
    const CycleSensitivity found = cycle_sensitivity(servo);
    const auto compare = [&](double NormalizedServo::*number, double ServoGradient::*slope) {
      const double step = 1e-4 * std::min(servo.*number, 1.0 - servo.friction_ratio);
      const double expected = numerical_slope(
          servo, number, step,
          [](const NormalizedServo& changed) { return growth_at_rest(servo_dynamics(changed)); });
      EXPECT_NEAR(found.growth_at_rest.slope.*slope, expected,
                  1e-7 * (std::abs(expected) + found.growth_at_rest.value / servo.*number));
    };
    for (const Field& field : fields) compare(field.present, field.slope);
    compare(&NormalizedServo::restitution, &ServoGradient::restitution);
  }
}

TEST(EdgeCycleSensitivity, AnIrregularMotionHasTheGrowthAlone) {
  NormalizedServo servo = sample;
  servo.restitution = 0.9;
  const CycleSensitivity found = cycle_sensitivity(servo);
  EXPECT_EQ(found.outcome, SensitivityOutcome::no_cycle);
  EXPECT_TRUE(std::isnan(found.amplitude.value));
  EXPECT_TRUE(std::isfinite(found.growth_at_rest.slope.restitution));
}

}  // namespace
}  // namespace gearlash::cycle_sensitivity_test
