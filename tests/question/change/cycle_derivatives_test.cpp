// Derivatives of the closed form against those of its equations in many digits.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "base/described.hpp"
#include "base/references.hpp"
#include "closed_form/return_map.hpp"
#include "question/change/derivatives.hpp"
#include "question/change/drives.hpp"

namespace gearlash::cycle_derivatives_test {
namespace {

struct Column {
  std::string name;
  std::string path;
  double NormalizedServo::*present;
};
const std::vector<Column> columns = {
    {"damping", "servo.damping", &NormalizedServo::damping},
    {"inertia_ratio", "servo.inertia_ratio", &NormalizedServo::inertia_ratio},
    {"friction_ratio", "servo.friction_ratio", &NormalizedServo::friction_ratio},
    {"restitution", "contact.restitution", &NormalizedServo::restitution}};

constexpr std::array quantities = {Quantity::amplitude, Quantity::period, Quantity::multiplier,
                                   Quantity::growth_at_rest};
enum Row : std::size_t { amplitude, period, multiplier, growth };

Jacobian jacobian_of(const NormalizedServo& servo) {
  std::vector<std::string_view> paths;
  for (const Column& column : columns) paths.emplace_back(column.path);
  return derivatives(drive_of(servo), quantities, paths);
}

NormalizedServo servo_of(const Reference& exact, double backlash, double restitution) {
  return {.damping = exact.input("damping"),
          .inertia_ratio = exact.input("inertia_ratio"),
          .friction_ratio = exact.input("friction_ratio"),
          .backlash = backlash,
          .restitution = restitution};
}

/// Any servos, and those that hunt, also next to the boundary, of light damping (∂ ln ρ, of order
/// ζ, is a sum of terms of order t₂ ~ (8πζ)^¼), about critical damping, and with a massless side.
class OracleCycleDerivatives : public testing::Test {
 protected:
  void compare(const Reference& exact) {
    const NormalizedServo servo = servo_of(exact, 1.0, 0.0);
    SCOPED_TRACE(exact.kind() + ": " + described(servo));
    const Jacobian found = jacobian_of(servo);
    ASSERT_EQ(found.reason.empty(), !std::isnan(exact["amplitude"]));
    compare(found, growth, "growth", servo, exact);
    if (!found.reason.empty()) return;
    compare(found, amplitude, "amplitude", servo, exact);
    compare(found, period, "period", servo, exact);
    compare(found, multiplier, "multiplier", servo, exact);
  }
  void TearDown() override {
    for (const auto& [kind, of] : kinds_) {
      RecordProperty(kind, std::to_string(of.worst * 1e9) + "e-9, missing " +
                               std::to_string(of.missing) + " of " + std::to_string(of.slopes));
      // Where a number changes all within rounding of the boundary no steps agree.
      EXPECT_LE(of.missing, kind == "boundary" ? of.slopes / 3 : 0) << kind << ' ' << of.slopes;
    }
  }

 private:
  struct OfKind {
    double worst = 0.0;  ///< error as a share of max(|derivative|, |value/parameter|)
    int slopes = 0;
    int missing = 0;
  };

  void compare(const Jacobian& found, std::size_t row, const std::string& quantity,
               const NormalizedServo& servo, const Reference& exact) {
    // A slope is left out where its steps agree to less than a millionth.
    const bool is_hard = exact.kind() == "boundary" || exact.kind() == "light";
    const double allowed = is_hard ? 2e-6 : 1e-9;
    OfKind& of = kinds_[exact.kind()];
    for (std::size_t j = 0; j < 3; ++j) {
      const double at = servo.*columns[j].present;
      if (std::isinf(at)) continue;
      ++of.slopes;
      const auto slope = found.slope(row, j);
      if (!slope) {
        ++of.missing;
        EXPECT_TRUE(is_hard) << quantity << " by " << columns[j].name;
        continue;
      }
      const Wide true_slope = exact[quantity + ":" + columns[j].name];
      // What a light side does it does by J/F.
      const double unit = at == 0.0 ? 2.0 * servo.damping * servo.friction_ratio : at;
      const Wide per_number = std::abs(exact[quantity] / Wide{unit});
      const Wide scale = std::max(std::abs(true_slope), per_number);
      const Wide away = std::abs(*slope - true_slope);
      const auto error = static_cast<double>(away == 0.0 ? away : away / scale);
      of.worst = std::max(of.worst, error);
      EXPECT_LE(error, allowed) << quantity << " by " << columns[j].name;
    }
  }

  std::map<std::string, OfKind> kinds_;
};

TEST_F(OracleCycleDerivatives, AreThoseOfTheEquationsInManyDigits) {
  for (const Reference& exact : References("question", "plastic_slopes")) compare(exact);
}

// ---- with bounces -------------------------------------------------------------------------------

/// Of drawn servos whose bounces settle or go on, of a pair of multipliers, of opposite ones of
/// half a period, of an asymmetric cycle that is weakly stable (the less a cycle resists, the more
/// its derivatives have of the map's second ones), and of a subharmonic one.
TEST(OracleBouncingDerivatives, AreThoseOfTheEquationsInManyDigits) {
  for (const Reference& exact : References("question", "bouncing_slopes")) {
    const NormalizedServo servo =
        servo_of(exact, exact.input("backlash"), exact.input("restitution"));
    SCOPED_TRACE(exact.kind() + ": " + described(servo));
    const Jacobian found = jacobian_of(servo);
    ASSERT_EQ(found.reason, "");
    const double tolerance = 5e-10 / (1.0 - std::abs(exact.input("multiplier")));
    for (const auto& [row, quantity] : {std::pair{amplitude, std::string("amplitude")},
                                        {period, "period"},
                                        {multiplier, "multiplier"}}) {
      const Wide value = exact[quantity];
      EXPECT_NEAR(*found.values[row], static_cast<double>(value),
                  1e-11 * std::abs(*found.values[row]));
      for (std::size_t j = 0; j < columns.size(); ++j) {
        const Wide slope = exact[quantity + ":" + columns[j].name];
        const Wide scale = std::max(std::abs(slope), std::abs(value / servo.*columns[j].present));
        ASSERT_TRUE(found.slope(row, j)) << quantity << " by " << columns[j].name;
        EXPECT_LE(std::abs(*found.slope(row, j) - slope), tolerance * scale)
            << quantity << " by " << columns[j].name;
      }
    }
  }
}

constexpr NormalizedServo elastic{.damping = 0.34,
                                  .inertia_ratio = 0.94,
                                  .friction_ratio = 0.48,
                                  .backlash = 1.0,
                                  .restitution = 0.9};

NormalizedServo with_restitution(NormalizedServo servo, double restitution) {
  servo.restitution = restitution;
  return servo;
}

/// Of the map from arrival to arrival, of a symmetric cycle.
Eigen::Vector3cd eigenvalues_of(const NormalizedServo& servo) {
  const LimitCycleAnalysis analysis = analyse_limit_cycles(servo);
  const LimitCycle& cycle = analysis.cycles.at(0);
  EXPECT_EQ(cycle.kind, CycleKind::symmetric);
  const ServoState& start = cycle.start;
  const double gap_speed = start.motor_speed - start.load_speed;
  const Arrival arrival(start.load_position,
                        start.load_speed + gap_speed / (1.0 + servo.inertia_ratio),
                        -gap_speed / servo.restitution);
  return traverse(servo_dynamics(servo), arrival).slope.eigenvalues();
}

bool is_pair(const Eigen::Vector3cd& eigenvalues) { return !eigenvalues.imag().isZero(0.0); }

void expect_kind(const NormalizedServo& servo, CycleKind kind) {
  const LimitCycleAnalysis analysis = analyse_limit_cycles(servo);
  EXPECT_EQ(largest_stable(analysis)->kind, kind);
}

constexpr NormalizedServo sample{
    .damping = 0.19, .inertia_ratio = 2.0, .friction_ratio = 0.1, .backlash = 0.3};

/// That the references have what their kinds say.
TEST(OracleBouncingDerivatives, AreComparedWithMultipliersOfEveryKind) {
  EXPECT_TRUE(is_pair(eigenvalues_of(elastic)));
  const Eigen::Vector3cd opposite = eigenvalues_of(with_restitution(elastic, 0.472));
  const double largest = opposite.real().maxCoeff();
  EXPECT_NEAR(opposite.real().minCoeff(), -largest, 0.02 * largest);
  expect_kind(with_restitution(sample, 0.6), CycleKind::asymmetric);
  expect_kind({.damping = 0.121354,
               .inertia_ratio = 1.80297,
               .friction_ratio = 0.686046,
               .backlash = 0.170371,
               .restitution = 0.602605},
              CycleKind::subharmonic);
}

/// Where a pair comes together its modulus has no derivative; beside, and of all else, there is.
TEST(EdgeBouncingDerivatives, ADoubleMultiplierHasNone) {
  double apart = 0.8;
  double pair = 0.85;
  ASSERT_FALSE(is_pair(eigenvalues_of(with_restitution(elastic, apart))));
  ASSERT_TRUE(is_pair(eigenvalues_of(with_restitution(elastic, pair))));
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (apart + pair);
    (is_pair(eigenvalues_of(with_restitution(elastic, middle))) ? pair : apart) = middle;
  }
  const Jacobian found = jacobian_of(with_restitution(elastic, pair));
  ASSERT_EQ(found.reason, "");
  EXPECT_TRUE(found.slope(amplitude, 0));
  EXPECT_TRUE(found.slope(period, 3));
  EXPECT_FALSE(found.slope(multiplier, 0));
  EXPECT_FALSE(found.slope(multiplier, 3));
  EXPECT_TRUE(jacobian_of(with_restitution(elastic, pair + 1e-3)).slope(multiplier, 0));
}

// ---- edges --------------------------------------------------------------------------------------

TEST(EdgeCycleDerivatives, FrictionOnOneSideAloneHasACycleAndNoGrowthToDifferentiate) {
  for (const double friction_ratio : {0.0, 1.0}) {
    NormalizedServo servo = sample;
    servo.friction_ratio = friction_ratio;
    const Jacobian found = jacobian_of(servo);
    ASSERT_EQ(found.reason, "");
    EXPECT_TRUE(std::isinf(*found.values[growth]));
    EXPECT_FALSE(found.slope(growth, 0) || found.slope(growth, 2) || found.slope(growth, 3));
    EXPECT_TRUE(found.slope(amplitude, 0) && found.slope(amplitude, 2));
  }
}

TEST(EdgeCycleDerivatives, WithoutACycleTheGrowthAloneHasThem) {
  NormalizedServo servo = sample;
  servo.damping = 0.9;
  servo.friction_ratio = 0.5;
  Jacobian found = jacobian_of(servo);
  EXPECT_THAT(found.reason, testing::HasSubstr("no limit cycle"));
  EXPECT_LT(*found.values[growth], 1.0);
  EXPECT_LT(*found.slope(growth, 0), 0.0);
  EXPECT_FALSE(found.values[amplitude] || found.slope(amplitude, 0));
  servo = sample;
  servo.backlash = 0.0;
  found = jacobian_of(servo);
  EXPECT_THAT(found.reason, testing::HasSubstr("no limit cycle"));
  EXPECT_GT(*found.values[growth], 1.0);
  // Motion that does not repeat.
  found = jacobian_of(with_restitution(sample, 0.9));
  EXPECT_THAT(found.reason, testing::HasSubstr("no limit cycle"));
  EXPECT_FALSE(found.values[amplitude]);
  EXPECT_TRUE(found.slope(growth, 3));
}

TEST(EdgeCycleDerivatives, AreNotThereWithoutDamping) {
  NormalizedServo servo = sample;
  servo.damping = 0.0;
  const Jacobian found = jacobian_of(servo);
  EXPECT_EQ(found.reason, "not computed without damping");
  EXPECT_FALSE(found.values[growth] || found.slope(growth, 0));
}

/// Amplitude, period, multiplier and growth at rest go back to those of e = 0 as e³, so that the
/// derivative from above is 0: with half the restitution an eighth is left.
TEST(PropertyCycleDerivatives, SmallRestitutionActsToThirdOrder) {
  for (const NormalizedServo& servo :
       {sample, NormalizedServo{0.3, 2.0, 0.3, 0.3}, NormalizedServo{0.1, 1.0, 0.2, 1.0}}) {
    SCOPED_TRACE(described(servo));
    const Jacobian found = jacobian_of(servo);
    const Answer coarse = closed_answer(drive_of(with_restitution(servo, 0.01)));
    const Answer fine = closed_answer(drive_of(with_restitution(servo, 0.005)));
    for (std::size_t row = 0; row < quantities.size(); ++row) {
      EXPECT_EQ(found.slope(row, 3), 0.0);
      const double at_zero = *found.values[row];
      const double away = std::abs(*coarse.value(quantities[row]) - at_zero);
      EXPECT_LE(std::abs(*fine.value(quantities[row]) - at_zero), 0.15 * away + 1e-9 * at_zero);
      EXPECT_LE(away, 1e-4 * at_zero);
    }
  }
}

}  // namespace
}  // namespace gearlash::cycle_derivatives_test
