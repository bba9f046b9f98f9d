// The sample problem of the 1960 thesis (Appendix B), step by step to the digits printed there, and
// Appendix A for the other two motors.
#include <gtest/gtest.h>

#include <cmath>

#include "model/proportional_servo.hpp"
#include "model/reduced_drive.hpp"

namespace gearlash::appendix_b_test {
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

Drive elinco_fd162() {
  Drive drive;
  drive.motor = {.kind = ArmatureControl{.torque_constant = 28.2 * ounce_inch_force,
                                         .back_emf_constant = 0.233,
                                         .resistance = 282.0},
                 .inertia = 0.61 * ounce_square_inch,
                 .friction = {.viscous = 0.00064 * ounce_inch_force}};
  drive.gearbox = {.ratio = 1.0, .backlash = 0.1};
  drive.load = {16.4e-6 * slug_square_foot, {.viscous = 0.002 * ounce_inch_force}};
  drive.controller.law = PID{.proportional = 10.0};
  return drive;
}

/// Small whole numbers and powers of two, so that every result is exact.
Drive geared(const MotorKind& kind) {
  Drive drive;
  drive.motor = {.kind = kind, .inertia = 3.0, .friction = {.viscous = 5.0}};
  drive.gearbox = {.ratio = 4.0, .backlash = 0.25};
  drive.load = {11.0, {.viscous = 13.0}};
  drive.contact = RigidContact{.restitution = 0.5};
  drive.controller.law = PID{.proportional = 10.0};
  return drive;
}

/// Within half a unit of the last digit printed; the thesis cut 13.75 to 13.7, so a tie may go
/// either way, and a tie is only known to rounding.
void expect_as_printed(double value, double printed, double last_digit) {
  EXPECT_LE(std::abs(value - printed), 0.5 * last_digit * (1.0 + 1e-9))
      << value << " against " << printed;
}

TEST(OracleAppendixB, EachStepIsAsPrinted) {
  const Drive drive = elinco_fd162();  // n = 1
  const Drivetrain drivetrain = referred_drivetrain(drive);
  expect_as_printed(drivetrain.stiffness / foot_pound_force, 0.0052, 1e-4);
  expect_as_printed(drivetrain.motor_inertia / slug_square_foot, 8.2e-6, 1e-7);
  expect_as_printed(natural_frequency(drivetrain), 14.5, 0.1);
  const double mechanical = drive.motor.friction.viscous + drive.load.friction.viscous;
  expect_as_printed(mechanical / foot_pound_force, 13.7e-6, 1e-7);
  expect_as_printed(refer_output(drive).friction / foot_pound_force, 121e-6, 1e-6);
  const NormalizedServo servo = proportional_servo(drive)->servo;
  expect_as_printed(servo.damping, 0.19, 0.01);
  expect_as_printed(servo.inertia_ratio, 2.0, 0.1);
  expect_as_printed(servo.friction_ratio, 0.077, 0.001);
  EXPECT_EQ(servo.backlash, 0.1);
  EXPECT_EQ(servo.restitution, 0.0);
}

TEST(OracleAppendixA, ArmatureControlledThroughAGearbox) {
  const Drive drive =
      geared(ArmatureControl{.torque_constant = 8.0, .back_emf_constant = 7.0, .resistance = 2.0});
  EXPECT_EQ(refer_output(drive).friction, 448.0);   // K₁K₂n²/R
  const Drivetrain expected{.motor_inertia = 48.0,  // J_m n²
                            .load_inertia = 11.0,
                            .motor_friction = 528.0,  // f_m n² = 80, and the back-EMF's
                            .load_friction = 13.0,
                            .stiffness = 160.0,  // K₁K₃n/R
                            .backlash = 0.25,
                            .restitution = 0.5};
  EXPECT_EQ(referred_drivetrain(drive), expected);
  EXPECT_EQ(proportional_servo(drive).value().drivetrain, expected);
}

TEST(OracleAppendixA, FieldControlledHasNoElectricalFriction) {
  const Drive drive = geared(FieldControl{.torque_constant = 8.0, .resistance = 2.0});
  EXPECT_EQ(refer_output(drive).friction, 0.0);
  EXPECT_EQ(referred_drivetrain(drive).stiffness, 160.0);
  EXPECT_EQ(referred_drivetrain(drive).motor_friction, 80.0);
}

TEST(OracleAppendixA, TwoPhaseBySlopes) {
  const Drive drive = geared(TwoPhase{.torque_per_volt = 8.0, .torque_per_speed = 2.0});
  EXPECT_EQ(refer_output(drive).friction, 32.0);           // K_N n²
  EXPECT_EQ(referred_drivetrain(drive).stiffness, 320.0);  // K_e K₃ n
  EXPECT_EQ(referred_drivetrain(drive).motor_friction, 112.0);
}

TEST(OracleAppendixA, ThesisFormOfTheTwoPhaseMotor) {
  // The thesis writes K_e and K_N for a direct drive and one volt per radian.
  Drive drive;
  drive.motor = {.kind = TwoPhase{.torque_per_volt = 16.0, .torque_per_speed = 2.0},
                 .inertia = 1.0,
                 .friction = {.viscous = 1.0}};
  drive.gearbox = {.ratio = 1.0, .backlash = 0.3};
  drive.load = {3.0, {.viscous = 1.0}};
  drive.controller.law = PID{.proportional = 1.0};
  const ProportionalServo found = *proportional_servo(drive);
  EXPECT_EQ(found.natural_frequency, 2.0);  // √(16/4)
  EXPECT_EQ(found.servo.damping, 0.25);     // (4/4)/(2·2)
  EXPECT_EQ(found.servo.inertia_ratio, 3.0);
  EXPECT_EQ(found.servo.friction_ratio, 0.25);
}

/// Gains per radian of the motor and speed fed back, too: both ways to the drivetrain agree.
TEST(OracleAppendixA, TheShortWayToTheDrivetrainIsThatOfTheReducedDrive) {
  Drive drive = geared(TwoPhase{.torque_per_volt = 8.0, .torque_per_speed = 2.0});
  drive.sensor.speed = ShaftName::motor;
  for (const GainShaft shaft : {GainShaft::load, GainShaft::motor}) {
    drive.controller.shaft = shaft;
    const auto expect_same = [&] {
      const auto servo = proportional_servo(drive);
      ASSERT_TRUE(servo.has_value());
      EXPECT_EQ(referred_drivetrain(drive), servo->drivetrain);
    };
    drive.controller.law = PID{.terms = PIDTerms::PD, .proportional = 4.0, .derivative = 0.5};
    expect_same();
    drive.controller.law = CascadeController{.position = 4.0, .speed = 2.0};
    expect_same();
    for (const double gain : {4.0, 45.0, 0.3}) {  // with 0.3 rounding left dynamics
      drive.controller.law = LeadLagController{.gain = gain, .zero = 10.0, .pole = 10.0};
      expect_same();
    }
    drive.controller.law =
        StateSpaceController{.gain = 2.0, .A = {}, .B = {}, .C = {}, .D = {4.0, -4.0, -0.5}};
    expect_same();
  }
}

}  // namespace
}  // namespace gearlash::appendix_b_test
