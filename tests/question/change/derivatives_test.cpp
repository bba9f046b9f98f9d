// Derivatives of drives: against differences of analyse_limit_cycles(), and by identities of scale.
#include "question/change/derivatives.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "base/range_check.hpp"
#include "base/traced_draws.hpp"
#include "closed_form/growth_at_rest.hpp"
#include "question/change/drives.hpp"
#include "question/change/target.hpp"

namespace gearlash::drive_sensitivity_test {
namespace {

constexpr Sheet sheet{.motor_inertia = 1e-5,
                      .motor_friction = 2e-5,
                      .ratio = 20.0,
                      .backlash = 0.01,
                      .load_inertia = 8e-3,
                      .load_friction = 4e-3,
                      .error_gain = 60.0};

Drive armature_drive() {
  return drive_of(
      ArmatureControl{.torque_constant = 0.05, .back_emf_constant = 0.05, .resistance = 8.0},
      sheet);
}

Drive field_drive() {
  Drive drive = drive_of(FieldControl{.torque_constant = 0.05, .resistance = 8.0}, sheet);
  drive.motor.friction.viscous = 1e-4;
  return drive;
}

Drive two_phase_drive() {
  return drive_of(TwoPhase{.torque_per_volt = 6e-3, .torque_per_speed = 2e-4}, sheet);
}

/// With speed fed back from the motor, gains per radian of the motor.
Drive fed_back(Drive drive, double derivative) {
  drive.controller = {.law = PID{.terms = PIDTerms::PD,
                                 .proportional = 3.0,
                                 .derivative = derivative,
                                 .derivative_of_speed = true},
                      .shaft = GainShaft::motor};
  drive.sensor.speed = ShaftName::motor;
  return drive;
}

Drive cascade_drive() {
  Drive drive = armature_drive();
  drive.controller.law = CascadeController{.position = 300.0, .speed = 0.2};
  drive.sensor.speed = ShaftName::motor;
  return drive;
}

Drive lead_lag_drive() {
  Drive drive = two_phase_drive();
  drive.controller.law = LeadLagController{.gain = 60.0, .zero = 10.0, .pole = 10.0};
  return drive;
}

/// A quantity of a drive, without derivatives; NaN where there is none.
double value_of(Quantity quantity, const Drivetrain& drive) {
  const LimitCycleAnalysis analysis = analyse_limit_cycles(normalize(drive));
  if (quantity == Quantity::growth_at_rest) return analysis.growth_at_rest;
  const LimitCycle* cycle = largest_stable(analysis);
  if (cycle == nullptr) return std::numeric_limits<double>::quiet_NaN();
  if (quantity == Quantity::amplitude) return cycle->amplitude;
  if (quantity == Quantity::multiplier) return cycle->multiplier;
  const double period = cycle->period / natural_frequency(drive);
  return quantity == Quantity::period ? period : 1.0 / period;
}

/// Central differences with a step of 1e-3, twice extrapolated (error step⁶ and rounding/step):
/// some 1e-11 of the largest of value/parameter and derivative, or more where it changes fast.
double difference(const std::function<double(double)>& value_at, double present, double scale) {
  const auto at = [&](double h) {
    return (value_at(present + h) - value_at(present - h)) / (2 * h);
  };
  const double h = 1e-3 * scale;
  const double whole = at(h);
  const double half = at(0.5 * h);
  const double quarter = at(0.25 * h);
  const double first = (4.0 * half - whole) / 3.0;
  const double second = (4.0 * quarter - half) / 3.0;
  return (16.0 * second - first) / 15.0;
}

/// Every slope of one column against differences.
void expect_slopes(const Jacobian& found, const Drive& drive, std::size_t column, double scale,
                   double tolerance) {
  const std::string& name = found.paths[column];
  const ServoLine line = line_of(drive, name);
  for (std::size_t row = 0; row < found.quantities.size(); ++row) {
    const Quantity quantity = found.quantities[row];
    const double exact =
        difference([&](double value) { return value_of(quantity, line.at(value)->drivetrain); },
                   found.present[column], scale);
    ASSERT_TRUE(found.slope(row, column) && found.values[row]) << name;
    const double slope = *found.slope(row, column);
    const double value = *found.values[row];
    EXPECT_NEAR(slope, exact, tolerance * (std::abs(exact) + std::abs(value) / scale))
        << name << ": " << name_of(quantity);
    EXPECT_DOUBLE_EQ(*found.elasticity(row, column) * value, slope * found.present[column]);
  }
}

Jacobian derivatives_by(const Drive& drive, const std::vector<std::string>& names) {
  const std::vector<std::string_view> paths(names.begin(), names.end());
  return derivatives(drive, differentiable, paths);
}

void expect_slopes(const Drive& drive, const std::vector<std::string>& names, double tolerance) {
  const Jacobian found = derivatives_by(drive, names);
  ASSERT_EQ(found.reason, "");
  for (std::size_t column = 0; column < names.size(); ++column) {
    if (names[column] == "contact.restitution") continue;
    // Feedback that is 0 at present has the scale of one that would damp like the motor itself.
    const double present = found.present[column];
    const double scale =
        present == 0.0 ? 1.0 / (line_of(drive, names[column]).at(1.0)->drivetrain.motor_friction /
                                    drivetrain_of(drive).motor_friction -
                                1.0)
                       : std::abs(present);
    expect_slopes(found, drive, column, scale, tolerance);
  }
}

std::vector<std::string> all_names(const Drive& drive) { return drive_sensitivity(drive).paths; }

TEST(DriveSensitivity, OfEachNumberAgreesWithDifferences) {
  std::size_t numbers = 0;
  for (const Drive& drive :
       {armature_drive(), field_drive(), two_phase_drive(), fed_back(armature_drive(), 1e-3),
        fed_back(two_phase_drive(), -1e-3), cascade_drive(), lead_lag_drive()}) {
    numbers += all_names(drive).size();
    expect_slopes(drive, all_names(drive), 1e-9);
  }
  EXPECT_EQ(numbers, 12U + 11U + 11U + 13U + 12U + 13U + 11U);
}

TEST(PropertyDriveSensitivity, OfRandomServosAgreesWithDifferences) {
  TracedDraws draws(2301);
  for (int compared = 0; compared < 100;) {
    const NormalizedServo servo{.damping = draws.log_uniform(0.02, 2.0),
                                .inertia_ratio = draws.log_uniform(0.03, 30.0),
                                .friction_ratio = draws.uniform(0.02, 0.98),
                                .backlash = draws.log_uniform(1e-3, 1.0)};
    if (growth_at_rest(servo_dynamics(servo)) < 1.2) continue;  // where it is steep
    ++compared;
    const Drive drive = drive_of(servo, draws.log_uniform(1.0, 100.0));
    expect_slopes(drive, all_names(drive), 1e-8);
  }
}

TEST(DriveSensitivity, NamesTheNumbersOfADataSheetByTheirPaths) {
  EXPECT_THAT(all_names(armature_drive()),
              testing::ElementsAre("motor.inertia", "motor.friction", "motor.torque_constant",
                                   "motor.back_emf_constant", "motor.resistance", "gearbox.ratio",
                                   "gearbox.backlash", "load.inertia", "load.friction",
                                   "contact.restitution", "controller.proportional",
                                   "controller.motor_speed_feedback"));
  EXPECT_THAT(all_names(field_drive()), testing::Not(testing::Contains("motor.back_emf_constant")));
}

// ---- identities of scale ------------------------------------------------------------------------

TEST(PropertyDriveSensitivity, KnowsTheScalesOfTorqueTimeAndAngle) {
  const std::vector<std::string> names = {"motor.inertia",           "load.inertia",
                                          "motor.friction",          "load.friction",
                                          "controller.proportional", "gearbox.backlash"};
  TracedDraws draws(2302);
  for (int compared = 0; compared < 300;) {
    const double restitution = compared % 10 == 0 ? draws.uniform(0.05, 0.5) : 0.0;
    const Drive drive = drive_of(TorqueControl{}, {.motor_inertia = draws.log_uniform(1e-4, 1e-1),
                                                   .motor_friction = draws.log_uniform(1e-4, 1e-1),
                                                   .ratio = 1.0,
                                                   .backlash = draws.log_uniform(1e-4, 1e-1),
                                                   .load_inertia = draws.log_uniform(1e-4, 1e-1),
                                                   .load_friction = draws.log_uniform(1e-4, 1e-1),
                                                   .error_gain = draws.log_uniform(1e-1, 1e2),
                                                   .restitution = restitution});
    if (growth_at_rest(servo_dynamics(normalize(drivetrain_of(drive)))) < 1.01) continue;
    const Jacobian found = derivatives_by(drive, names);
    if (!found.reason.empty()) continue;
    ++compared;
    for (std::size_t row = 0; row < found.quantities.size(); ++row) {
      const Quantity quantity = found.quantities[row];
      SCOPED_TRACE(name_of(quantity));
      std::vector<double> by;
      double parts = 1.0;
      for (std::size_t column = 0; column < names.size(); ++column) {
        by.push_back(found.elasticity(row, column).value_or(not_a_number));
        parts += std::abs(by.back());
      }
      const double tolerance = 1e-9 * parts;
      // The unit of torque.
      EXPECT_NEAR(by[0] + by[1] + by[2] + by[3] + by[4], 0.0, tolerance);
      // The unit of time: inertia as its square, friction with it.
      const double power = quantity == Quantity::period      ? 1.0
                           : quantity == Quantity::frequency ? -1.0
                                                             : 0.0;
      EXPECT_NEAR(2.0 * (by[0] + by[1]) + by[2] + by[3], power, tolerance);
      // The unit of angle.
      EXPECT_NEAR(by[5], quantity == Quantity::amplitude ? 1.0 : 0.0, tolerance);
    }
  }
}

// ---- edges --------------------------------------------------------------------------------------

TEST(EdgeDriveSensitivity, WithoutACycleSaysSo) {
  const NormalizedServo servo{
      .damping = 0.9, .inertia_ratio = 2.0, .friction_ratio = 0.5, .backlash = 0.1};
  EXPECT_THAT(drive_sensitivity(drive_of(servo)).reason,
              testing::HasSubstr("there is no limit cycle"));
  const Jacobian found =
      derivatives(drive_of(servo), {Quantity::period, Quantity::growth_at_rest}, {"servo.damping"});
  EXPECT_FALSE(found.values[0] || found.slope(0, 0) || found.elasticity(0, 0));
  EXPECT_TRUE(found.values[1] && found.slope(1, 0) && found.elasticity(1, 0));
}

TEST(EdgeDriveSensitivity, RefusesWhatHasNoDerivatives) {
  const Drive drive = armature_drive();
  EXPECT_THROW(static_cast<void>(derivatives(drive, {Quantity::verdict}, {"load.inertia"})),
               InvalidInput);
  EXPECT_THROW(static_cast<void>(derivatives(drive, {Quantity::amplitude}, {"load.coulomb"})),
               InvalidInput);
  const Jacobian found = derivatives(drive, {Quantity::amplitude}, {"load.inertia"});
  EXPECT_THROW(static_cast<void>(found.slope(1, 0)), std::out_of_range);
  EXPECT_THROW(static_cast<void>(found.slope(0, 1)), std::out_of_range);
}

TEST(DriveSensitivity, WithBouncesAgreesWithDifferencesToo) {
  const Drive drive = drive_of(NormalizedServo{.damping = 0.3,
                                               .inertia_ratio = 2.0,
                                               .friction_ratio = 0.2,
                                               .backlash = 0.1,
                                               .restitution = 0.4});
  expect_slopes(drive, usual_parameters(drive), 1e-8);
  const Jacobian found = derivatives(drive, {Quantity::amplitude}, {"contact.restitution"});
  const double exact = difference(
      [&](double value) {
        return amplitude_in(line_of(drive, "contact.restitution").answer_at(value));
      },
      0.4, 0.4);
  EXPECT_NEAR(*found.slope(0, 0), exact, 1e-8);
  EXPECT_NE(*found.slope(0, 0), 0.0);
}

}  // namespace
}  // namespace gearlash::drive_sensitivity_test
