// The sample problem of the 1960 thesis (Appendix B), step by step to the digits printed there, and
// Appendix A for the other two motors.
#include <gtest/gtest.h>

#include <cmath>

#include "model/datasheet.hpp"

namespace gearlash {
namespace {

// Exact by definition: the foot is 0.3048 m, the pound 0.45359237 kg, standard gravity 9.80665
// m/s². A foot pound-force is then also a slug square foot per second squared, so one factor serves
// torques and inertias alike.
constexpr double foot = 0.3048;
constexpr double pound = 0.45359237;
constexpr double gravity = 9.80665;
constexpr double foot_pound_force = pound * gravity * foot;  // N m
constexpr double slug_square_foot = foot_pound_force;        // kg m²
constexpr double ounce_inch_force = foot_pound_force / (16.0 * 12.0);
constexpr double ounce_square_inch = pound / 16.0 * (foot / 12.0) * (foot / 12.0);  // kg m²

Datasheet elinco_fd162() {
  return {.motor = ArmatureControlledMotor{.inertia = 0.61 * ounce_square_inch,
                                           .friction = 0.00064 * ounce_inch_force,
                                           .torque_constant = 28.2 * ounce_inch_force,
                                           .back_emf_constant = 0.233,
                                           .resistance = 282.0},
          .gearbox = {.ratio = 1.0, .backlash = 0.1},
          .load = {.inertia = 16.4e-6 * slug_square_foot, .friction = 0.002 * ounce_inch_force},
          .loop = {.error_gain = 10.0},
          .contact = {}};
}

/// Within half a unit of the last digit printed; the thesis cut 13.75 to 13.7, so a tie may go
/// either way, and a tie is only known to rounding.
void expect_as_printed(double value, double printed, double last_digit) {
  EXPECT_LE(std::abs(value - printed), 0.5 * last_digit * (1.0 + 1e-9))
      << value << " against " << printed;
}

TEST(OracleAppendixB, Step1Stiffness) {
  expect_as_printed(refer_to_load(elinco_fd162()).stiffness / foot_pound_force, 0.0052, 1e-4);
}

TEST(OracleAppendixB, Step2MotorInertia) {
  expect_as_printed(refer_to_load(elinco_fd162()).inertia / slug_square_foot, 8.2e-6, 1e-7);
}

TEST(OracleAppendixB, Step3NaturalFrequency) {
  expect_as_printed(natural_frequency(to_drivetrain(elinco_fd162())), 14.5, 0.1);
}

TEST(OracleAppendixB, Step4MechanicalFriction) {
  const Datasheet datasheet = elinco_fd162();
  const double total = refer_to_load(datasheet).mechanical_friction + datasheet.load.friction;
  expect_as_printed(total / foot_pound_force, 13.7e-6, 1e-7);
}

TEST(OracleAppendixB, Step5ElectricalFriction) {
  expect_as_printed(refer_to_load(elinco_fd162()).electrical_friction / foot_pound_force, 121e-6,
                    1e-6);
}

TEST(OracleAppendixB, Steps6To8Ratios) {
  const NormalizedServo servo = normalize(to_drivetrain(elinco_fd162()));
  expect_as_printed(servo.damping, 0.19, 0.01);
  expect_as_printed(servo.inertia_ratio, 2.0, 0.1);
  expect_as_printed(servo.friction_ratio, 0.077, 0.001);
  EXPECT_EQ(servo.backlash, 0.1);
  EXPECT_EQ(servo.restitution, 0.0);
}

// The numbers below are small whole numbers and powers of two, so every result is exact.
TEST(OracleAppendixA, ArmatureControlledThroughAGearbox) {
  const Datasheet datasheet{.motor = ArmatureControlledMotor{.inertia = 3.0,
                                                             .friction = 5.0,
                                                             .torque_constant = 8.0,
                                                             .back_emf_constant = 7.0,
                                                             .resistance = 2.0},
                            .gearbox = {.ratio = 4.0, .backlash = 0.25},
                            .load = {.inertia = 11.0, .friction = 13.0},
                            .loop = {.error_gain = 10.0},
                            .contact = {.restitution = 0.5}};
  const ReferredMotor motor = refer_to_load(datasheet);
  EXPECT_EQ(motor.stiffness, 160.0);            // K₁K₃n/R
  EXPECT_EQ(motor.inertia, 48.0);               // J_m n²
  EXPECT_EQ(motor.mechanical_friction, 80.0);   // f_m n²
  EXPECT_EQ(motor.electrical_friction, 448.0);  // K₁K₂n²/R
  const Drivetrain drivetrain = to_drivetrain(datasheet);
  EXPECT_EQ(drivetrain, (Drivetrain{.motor_inertia = 48.0,
                                    .load_inertia = 11.0,
                                    .motor_friction = 528.0,
                                    .load_friction = 13.0,
                                    .stiffness = 160.0,
                                    .backlash = 0.25,
                                    .restitution = 0.5}));
}

TEST(OracleAppendixA, FieldControlledHasNoElectricalFriction) {
  const Datasheet datasheet{
      .motor =
          FieldControlledMotor{
              .inertia = 3.0, .friction = 5.0, .torque_constant = 8.0, .resistance = 2.0},
      .gearbox = {.ratio = 4.0, .backlash = 0.25},
      .load = {.inertia = 11.0, .friction = 13.0},
      .loop = {.error_gain = 10.0},
      .contact = {}};
  const ReferredMotor motor = refer_to_load(datasheet);
  EXPECT_EQ(motor.stiffness, 160.0);
  EXPECT_EQ(motor.inertia, 48.0);
  EXPECT_EQ(motor.mechanical_friction, 80.0);
  EXPECT_EQ(motor.electrical_friction, 0.0);
}

TEST(OracleAppendixA, TwoPhaseBySlopes) {
  const Datasheet datasheet{
      .motor =
          TwoPhaseMotor{
              .inertia = 3.0, .friction = 5.0, .torque_per_volt = 8.0, .torque_per_speed = 2.0},
      .gearbox = {.ratio = 4.0, .backlash = 0.25},
      .load = {.inertia = 11.0, .friction = 13.0},
      .loop = {.error_gain = 10.0},
      .contact = {}};
  const ReferredMotor motor = refer_to_load(datasheet);
  EXPECT_EQ(motor.stiffness, 320.0);  // K_e K₃ n
  EXPECT_EQ(motor.inertia, 48.0);
  EXPECT_EQ(motor.mechanical_friction, 80.0);
  EXPECT_EQ(motor.electrical_friction, 32.0);  // K_N n²
}

TEST(OracleAppendixA, ThesisFormOfTheTwoPhaseMotor) {
  // The thesis writes K_e and K_N for a direct drive and one volt per radian.
  const Datasheet datasheet{
      .motor =
          TwoPhaseMotor{
              .inertia = 1.0, .friction = 1.0, .torque_per_volt = 16.0, .torque_per_speed = 2.0},
      .gearbox = {.ratio = 1.0, .backlash = 0.3},
      .load = {.inertia = 3.0, .friction = 1.0},
      .loop = {.error_gain = 1.0},
      .contact = {}};
  const Drivetrain drivetrain = to_drivetrain(datasheet);
  EXPECT_EQ(natural_frequency(drivetrain), 2.0);  // √(16/4)
  const NormalizedServo servo = normalize(drivetrain);
  EXPECT_EQ(servo.damping, 0.25);  // (4/4)/(2·2)
  EXPECT_EQ(servo.inertia_ratio, 3.0);
  EXPECT_EQ(servo.friction_ratio, 0.25);
}

}  // namespace
}  // namespace gearlash
