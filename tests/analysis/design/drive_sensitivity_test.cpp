// Derivatives of drives: against differences of performance_of(), and by identities of scale.
#include "analysis/design/drive_sensitivity.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "analysis/design/target.hpp"
#include "base/range_check.hpp"
#include "base/seeded_draws.hpp"
#include "closed_form/growth_at_rest.hpp"

namespace gearlash {
namespace {

Datasheet armature_sheet() {
  return {.motor = ArmatureControlledMotor{.inertia = 1e-5,
                                           .friction = 2e-5,
                                           .torque_constant = 0.05,
                                           .back_emf_constant = 0.05,
                                           .resistance = 8.0},
          .gearbox = {.ratio = 20.0, .backlash = 0.01},
          .load = {.inertia = 8e-3, .friction = 4e-3},
          .loop = {.error_gain = 60.0},
          .contact = {}};
}

Datasheet field_sheet() {
  Datasheet sheet = armature_sheet();
  sheet.motor = FieldControlledMotor{
      .inertia = 1e-5, .friction = 1e-4, .torque_constant = 0.05, .resistance = 8.0};
  return sheet;
}

Datasheet two_phase_sheet() {
  Datasheet sheet = armature_sheet();
  sheet.motor = TwoPhaseMotor{
      .inertia = 1e-5, .friction = 2e-5, .torque_per_volt = 6e-3, .torque_per_speed = 2e-4};
  return sheet;
}

/// The quantities of a drive, without derivatives.
ByCycleMeasure<double> quantities_of(const Drivetrain& drive) {
  const LimitCycleAnalysis analysis = analyse_limit_cycles(normalize(drive));
  ByCycleMeasure<double> values;
  values.values.fill(std::numeric_limits<double>::quiet_NaN());
  values[CycleMeasure::growth_at_rest] = analysis.growth_at_rest;
  if (const LimitCycle* cycle = largest_stable(analysis)) {
    values[CycleMeasure::size] = cycle->size;
    values[CycleMeasure::period] = cycle->period / natural_frequency(drive);
    values[CycleMeasure::frequency] = performance_of(drive).frequency;
    values[CycleMeasure::multiplier] = cycle->multiplier;
  }
  return values;
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

using WithNumber = std::function<Drivetrain(double)>;

void expect_slopes(const DriveSensitivity& found, const ParameterSensitivity& parameter,
                   const WithNumber& with, double scale, double tolerance) {
  for (const CycleMeasure quantity : all_cycle_measures) {
    const double exact =
        difference([&](double value) { return quantities_of(with(value))[quantity]; },
                   parameter.present, scale);
    const Sensitivity& sensitivity = parameter.of[quantity];
    const double value = found.values[quantity];
    EXPECT_NEAR(sensitivity.slope, exact, tolerance * (std::abs(exact) + std::abs(value) / scale))
        << parameter.name << ": " << name_of(quantity);
    EXPECT_DOUBLE_EQ(sensitivity.elasticity * value, sensitivity.slope * parameter.present);
  }
}

void expect_slopes(const ChangeableDrive& drive, double tolerance) {
  const DriveSensitivity found = drive_sensitivity(drive);
  ASSERT_EQ(found.outcome, SensitivityOutcome::available);
  ASSERT_EQ(found.parameters.size(), parameter_count);
  for (const DesignParameter parameter : all_parameters) {
    if (parameter == DesignParameter::restitution) continue;
    // Feedback that is 0 at present has the scale of one that would damp like the motor itself.
    const double friction = drive.slopes(parameter).motor_friction;
    const double scale = parameter == DesignParameter::tachometer
                             ? drive.drivetrain().motor_friction / friction
                             : drive.present_value(parameter);
    expect_slopes(
        found, *found.find(name_of(parameter)),
        [&](double value) { return drive.with(parameter, value); }, scale, tolerance);
  }
}

TEST(DriveSensitivity, OfEachMotorAgreesWithDifferences) {
  for (const Datasheet& sheet : {armature_sheet(), field_sheet(), two_phase_sheet()}) {
    expect_slopes(ChangeableDrive(sheet), 1e-9);
  }
}

TEST(PropertyDriveSensitivity, OfRandomServosAgreesWithDifferences) {
  constexpr std::uint64_t seed = 2301;
  SCOPED_TRACE(seed);
  SeededDraws draws(seed);
  for (int compared = 0; compared < 100;) {
    const NormalizedServo servo{.damping = draws.log_uniform(0.02, 2.0),
                                .inertia_ratio = draws.log_uniform(0.03, 30.0),
                                .friction_ratio = draws.uniform(0.02, 0.98),
                                .backlash = draws.log_uniform(1e-3, 1.0)};
    if (growth_at_rest(servo_dynamics(servo)) < 1.2) continue;  // where it is steep
    ++compared;
    expect_slopes(ChangeableDrive(servo, draws.log_uniform(1.0, 100.0)), 1e-8);
  }
}

// ---- every number of a data sheet ---------------------------------------------------------------

/// A data sheet's number by its dotted name.
double& number_of(Datasheet& sheet, const std::string& name) {
  if (name == "gearbox.ratio") return sheet.gearbox.ratio;
  if (name == "gearbox.backlash") return sheet.gearbox.backlash;
  if (name == "load.inertia") return sheet.load.inertia;
  if (name == "load.friction") return sheet.load.friction;
  if (name == "loop.error_gain") return sheet.loop.error_gain;
  if (name == "contact.restitution") return sheet.contact.restitution;
  if (name == "motor.inertia") {
    return std::visit([](auto& any) -> double& { return any.inertia; }, sheet.motor);
  }
  if (name == "motor.friction") {
    return std::visit([](auto& any) -> double& { return any.friction; }, sheet.motor);
  }
  if (auto* two_phase = std::get_if<TwoPhaseMotor>(&sheet.motor)) {
    return name == "motor.torque_per_volt" ? two_phase->torque_per_volt
                                           : two_phase->torque_per_speed;
  }
  if (auto* field = std::get_if<FieldControlledMotor>(&sheet.motor)) {
    return name == "motor.torque_constant" ? field->torque_constant : field->resistance;
  }
  auto& armature = std::get<ArmatureControlledMotor>(sheet.motor);
  if (name == "motor.torque_constant") return armature.torque_constant;
  if (name == "motor.back_emf_constant") return armature.back_emf_constant;
  return armature.resistance;
}

TEST(DriveSensitivity, OfEachNumberOfADataSheetAgreesWithDifferences) {
  std::size_t numbers = 0;
  for (const Datasheet& sheet : {armature_sheet(), field_sheet(), two_phase_sheet()}) {
    const DriveSensitivity found = datasheet_sensitivity(sheet);
    ASSERT_EQ(found.outcome, SensitivityOutcome::available);
    for (const ParameterSensitivity& parameter : found.parameters) {
      ++numbers;
      Datasheet changed = sheet;
      EXPECT_EQ(number_of(changed, parameter.name), parameter.present) << parameter.name;
      if (parameter.name == "contact.restitution") {
        EXPECT_EQ(parameter.of[CycleMeasure::size].slope, 0.0);
        continue;
      }
      const auto with = [&](double value) {
        number_of(changed, parameter.name) = value;
        return to_drivetrain(changed);
      };
      expect_slopes(found, parameter, with, parameter.present, 1e-9);
    }
  }
  EXPECT_EQ(numbers, 11U + 10U + 10U);
  EXPECT_EQ(datasheet_sensitivity(field_sheet()).find("motor.back_emf_constant"), nullptr);
}

TEST(DriveSensitivity, OfADataSheetAndOfItsChangeableDriveAgree) {
  const DriveSensitivity sheet = datasheet_sensitivity(armature_sheet());
  const DriveSensitivity drive = drive_sensitivity(ChangeableDrive(armature_sheet()));
  const std::pair<const char*, const char*> names[] = {
      {"gearbox.ratio", "gear_ratio"},      {"gearbox.backlash", "backlash"},
      {"loop.error_gain", "error_gain"},    {"load.friction", "load_friction"},
      {"motor.friction", "motor_friction"}, {"load.inertia", "load_inertia"},
      {"motor.inertia", "motor_inertia"},   {"contact.restitution", "restitution"}};
  for (const auto& [dotted, plain] : names) {
    for (const CycleMeasure quantity : all_cycle_measures) {
      EXPECT_DOUBLE_EQ(sheet.find(dotted)->of[quantity].slope,
                       drive.find(plain)->of[quantity].slope)
          << dotted;
    }
  }
}

// ---- identities of scale ------------------------------------------------------------------------

/// Sums of elasticities by the numbers of a drivetrain, each times its exponent.
double directional(const DrivetrainSlopes& slopes, const Drivetrain& drive, double inertia,
                   double friction, double stiffness) {
  return inertia * (slopes.motor_inertia * drive.motor_inertia +
                    slopes.load_inertia * drive.load_inertia) +
         friction * (slopes.motor_friction * drive.motor_friction +
                     slopes.load_friction * drive.load_friction) +
         stiffness * slopes.stiffness * drive.stiffness;
}

TEST(PropertyDriveSensitivity, KnowsTheScalesOfTorqueTimeAndAngle) {
  constexpr std::uint64_t seed = 2302;
  SCOPED_TRACE(seed);
  SeededDraws draws(seed);
  for (int compared = 0; compared < 500;) {
    const Drivetrain drive{.motor_inertia = draws.log_uniform(1e-4, 1e-1),
                           .load_inertia = draws.log_uniform(1e-4, 1e-1),
                           .motor_friction = draws.log_uniform(1e-4, 1e-1),
                           .load_friction = draws.log_uniform(1e-4, 1e-1),
                           .stiffness = draws.log_uniform(1e-1, 1e2),
                           .backlash = draws.log_uniform(1e-4, 1e-1)};
    if (growth_at_rest(servo_dynamics(normalize(drive))) < 1.01) continue;
    ++compared;
    const DrivetrainSensitivity found = drivetrain_sensitivity(drive);
    ASSERT_EQ(found.outcome, SensitivityOutcome::available);
    for (const CycleMeasure quantity : all_cycle_measures) {
      const DrivetrainSlopes& slopes = found.slopes[quantity];
      const double value = found.values[quantity];
      const double parts = std::abs(slopes.motor_inertia * drive.motor_inertia) +
                           std::abs(slopes.load_inertia * drive.load_inertia) +
                           std::abs(slopes.motor_friction * drive.motor_friction) +
                           std::abs(slopes.load_friction * drive.load_friction) +
                           std::abs(slopes.stiffness * drive.stiffness) + value;
      const double rounding = 64.0 * std::numeric_limits<double>::epsilon() * parts;
      // The unit of torque.
      EXPECT_NEAR(directional(slopes, drive, 1.0, 1.0, 1.0), 0.0, rounding) << name_of(quantity);
      // The unit of time: inertia as its square, friction with it.
      const double power = quantity == CycleMeasure::period      ? 1.0
                           : quantity == CycleMeasure::frequency ? -1.0
                                                                 : 0.0;
      EXPECT_NEAR(directional(slopes, drive, 2.0, 1.0, 0.0), power * value, rounding)
          << name_of(quantity);
      // The unit of angle.
      const double by_size = quantity == CycleMeasure::size ? 1.0 : 0.0;
      EXPECT_NEAR(slopes.backlash * drive.backlash, by_size * value, rounding) << name_of(quantity);
    }
  }
}

TEST(DriveSensitivity, OfSizeByBacklashIsOneForOne) {
  const DriveSensitivity found = datasheet_sensitivity(armature_sheet());
  EXPECT_DOUBLE_EQ(found.find("gearbox.backlash")->of[CycleMeasure::size].elasticity, 1.0);
  EXPECT_EQ(found.find("gearbox.backlash")->of[CycleMeasure::frequency].elasticity, 0.0);
  EXPECT_EQ(found.find("gearbox.backlash")->of[CycleMeasure::growth_at_rest].elasticity, 0.0);
  EXPECT_EQ(found.find("contact.restitution")->of[CycleMeasure::size].elasticity, 0.0);
}

// ---- edges --------------------------------------------------------------------------------------

TEST(EdgeDriveSensitivity, WithoutACycleSaysSo) {
  const NormalizedServo servo{
      .damping = 0.9, .inertia_ratio = 2.0, .friction_ratio = 0.5, .backlash = 0.1};
  const DriveSensitivity found = drive_sensitivity(ChangeableDrive(servo));
  EXPECT_EQ(found.outcome, SensitivityOutcome::no_cycle);
  EXPECT_TRUE(std::isnan(found.values[CycleMeasure::size]));
  EXPECT_TRUE(std::isnan(found.find("gear_ratio")->of[CycleMeasure::period].slope));
  EXPECT_TRUE(std::isfinite(found.find("gear_ratio")->of[CycleMeasure::growth_at_rest].elasticity));
}

TEST(DriveSensitivity, WithBouncesAgreesWithDifferencesToo) {
  const ChangeableDrive drive(NormalizedServo{.damping = 0.3,
                                              .inertia_ratio = 2.0,
                                              .friction_ratio = 0.2,
                                              .backlash = 0.1,
                                              .restitution = 0.4});
  expect_slopes(drive, 1e-8);
  const Sensitivity by_restitution =
      drive_sensitivity(drive).find("restitution")->of[CycleMeasure::size];
  const double exact = difference(
      [&](double value) {
        return performance_of(drive.with(DesignParameter::restitution, value)).size;
      },
      0.4, 0.4);
  EXPECT_NEAR(by_restitution.slope, exact, 1e-8);
  EXPECT_NE(by_restitution.slope, 0.0);
}

}  // namespace
}  // namespace gearlash
