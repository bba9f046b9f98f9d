// Derivatives of cycles with bounces against central differences of their equations in many digits.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <string>

#include "base/references.hpp"
#include "closed_form/cycle_derivatives.hpp"
#include "closed_form/limit_cycle.hpp"
#include "closed_form/return_map.hpp"

namespace gearlash::bouncing_sensitivity_test {
namespace {

struct Field {
  std::string name;
  double NormalizedServo::*present;
  double ServoGradient::*slope;
};
const Field fields[] = {
    {"damping", &NormalizedServo::damping, &ServoGradient::damping},
    {"inertia_ratio", &NormalizedServo::inertia_ratio, &ServoGradient::inertia_ratio},
    {"friction_ratio", &NormalizedServo::friction_ratio, &ServoGradient::friction_ratio},
    {"restitution", &NormalizedServo::restitution, &ServoGradient::restitution}};

void compare(const NormalizedServo& servo, const SensitiveValue& found, const std::string& quantity,
             double tolerance, const Reference& exact) {
  const Wide value = exact[quantity];
  EXPECT_NEAR(found.value, static_cast<double>(value), 1e-11 * std::abs(found.value)) << quantity;
  for (const Field& field : fields) {
    const Wide slope = exact[quantity + ":" + field.name];
    const Wide scale = std::max(std::abs(slope), std::abs(value / servo.*field.present));
    EXPECT_LE(std::abs(found.slope.*field.slope - slope), tolerance * scale)
        << quantity << " by " << field.name;
  }
}

/// Of drawn servos whose bounces settle or go on, of a pair of multipliers, of opposite ones of
/// half a period (it turns one disturbance round, and a whole period has two nearly equal ones), of
/// an asymmetric cycle that is weakly stable (the less a cycle resists, the more its derivatives
/// have of the map's second ones), and of a subharmonic one. Errors are shares of max(|derivative|,
/// |value/parameter|). The arrival that the cycle starts from is known to some epsilons/(1 − λ),
/// and hence are its derivatives.
TEST(OracleBouncingSensitivity, IsThatOfTheEquationsInManyDigits) {
  for (const Reference& exact : References("closed_form", "bouncing_slopes")) {
    const NormalizedServo servo{.damping = exact.input("damping"),
                                .inertia_ratio = exact.input("inertia_ratio"),
                                .friction_ratio = exact.input("friction_ratio"),
                                .backlash = exact.input("backlash"),
                                .restitution = exact.input("restitution")};
    SCOPED_TRACE(testing::Message() << exact.kind() << " " << servo.damping);
    const CycleSensitivity found = cycle_sensitivity(servo);
    ASSERT_TRUE(found.available());
    const double tolerance = 2048.0 * epsilon / (1.0 - std::abs(exact.input("multiplier")));
    compare(servo, found.amplitude, "amplitude", tolerance, exact);
    compare(servo, found.period, "period", tolerance, exact);
    compare(servo, found.multiplier, "multiplier", tolerance, exact);
  }
}

// ---- multipliers of every kind ------------------------------------------------------------------

constexpr NormalizedServo elastic{.damping = 0.34,
                                  .inertia_ratio = 0.94,
                                  .friction_ratio = 0.48,
                                  .backlash = 1.0,
                                  .restitution = 0.9};

NormalizedServo with_restitution(NormalizedServo servo, double restitution) {
  servo.restitution = restitution;
  return servo;
}

/// The arrival before LimitCycle::start.
Arrival arrival_of(const NormalizedServo& servo, const LimitCycle& cycle) {
  const ServoState& start = cycle.start;
  const double gap_speed = start.motor_speed - start.load_speed;
  return {start.load_position, start.load_speed + gap_speed / (1.0 + servo.inertia_ratio),
          -gap_speed / servo.restitution};
}

/// Of the map from arrival to arrival, of a symmetric cycle.
Eigen::Vector3cd eigenvalues_of(const NormalizedServo& servo) {
  const LimitCycleAnalysis analysis = analyse_limit_cycles(servo);
  const LimitCycle& cycle = analysis.cycles.at(0);
  EXPECT_EQ(cycle.kind, CycleKind::symmetric);
  return traverse(servo_dynamics(servo), arrival_of(servo, cycle)).slope.eigenvalues();
}

bool is_pair(const Eigen::Vector3cd& eigenvalues) { return !eigenvalues.imag().isZero(0.0); }

void expect_kind(const NormalizedServo& servo, CycleKind kind) {
  const LimitCycleAnalysis analysis = analyse_limit_cycles(servo);
  EXPECT_EQ(largest_stable(analysis)->kind, kind);
}

/// That the references have what their kinds say.
TEST(OracleBouncingSensitivity, IsComparedWithMultipliersOfEveryKind) {
  EXPECT_TRUE(is_pair(eigenvalues_of(elastic)));
  const Eigen::Vector3cd opposite = eigenvalues_of(with_restitution(elastic, 0.472));
  const double largest = opposite.real().maxCoeff();
  EXPECT_NEAR(opposite.real().minCoeff(), -largest, 0.02 * largest);
  expect_kind({.damping = 0.19,
               .inertia_ratio = 2.0,
               .friction_ratio = 0.1,
               .backlash = 0.3,
               .restitution = 0.6},
              CycleKind::asymmetric);
  expect_kind({.damping = 0.121354,
               .inertia_ratio = 1.80297,
               .friction_ratio = 0.686046,
               .backlash = 0.170371,
               .restitution = 0.602605},
              CycleKind::subharmonic);
}

/// Where a pair comes together its modulus has no derivative; beside, and of all else, there is.
TEST(EdgeBouncingSensitivity, ADoubleMultiplierHasNoDerivative) {
  double apart = 0.8;
  double pair = 0.85;
  ASSERT_FALSE(is_pair(eigenvalues_of(with_restitution(elastic, apart))));
  ASSERT_TRUE(is_pair(eigenvalues_of(with_restitution(elastic, pair))));
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (apart + pair);
    (is_pair(eigenvalues_of(with_restitution(elastic, middle))) ? pair : apart) = middle;
  }
  const CycleSensitivity found = cycle_sensitivity(with_restitution(elastic, pair));
  ASSERT_TRUE(found.available());
  EXPECT_TRUE(std::isfinite(found.amplitude.slope.damping));
  EXPECT_TRUE(std::isfinite(found.period.slope.restitution));
  EXPECT_TRUE(std::isnan(found.multiplier.slope.damping));
  EXPECT_TRUE(std::isnan(found.multiplier.slope.restitution));
  const CycleSensitivity beside = cycle_sensitivity(with_restitution(elastic, pair + 1e-3));
  EXPECT_TRUE(std::isfinite(beside.multiplier.slope.damping));
}

}  // namespace
}  // namespace gearlash::bouncing_sensitivity_test
