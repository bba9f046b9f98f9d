// Gains at the joint and at the motor, and limits and frictions that currents give.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "gearlash/parameter.hpp"
#include "model/gains.hpp"
#include "model/parameters.hpp"
#include "model/proportional_servo.hpp"
#include "model/reduced_drive.hpp"

namespace gearlash::joint_gains_test {
namespace {

constexpr double ratio = 50.0;

Drive joint(const PID& pid) {
  Drive drive;
  drive.motor = {.kind = TorqueControl{}, .inertia = 2e-4, .friction = {.viscous = 1e-4}};
  drive.gearbox = {.ratio = ratio, .backlash = 0.0035};
  drive.load = {.inertia = 0.02, .friction = {.viscous = 0.01}};
  drive.controller.law = pid;
  return drive;
}

/// Load, motor or mixed.
void choose_shaft(Drive& drive, std::size_t shaft) {
  std::get<Choice>(find_parameter("controller.shaft")->slot(drive)).choose(drive, shaft);
}

TEST(JointGains, AreTorqueAtTheLoadPerAngleOfTheLoad) {
  Drive drive =
      joint({.terms = PIDTerms::PID, .proportional = 100.0, .integral = 30.0, .derivative = 2.0});
  EXPECT_EQ(drive.controller.shaft, GainShaft::mixed);  // unless another is named
  choose_shaft(drive, 0);
  const drive::ReducedDrive reduced = reduce(drive);
  EXPECT_EQ(reduced.controller.direct, (std::vector{100.0, -100.0, -2.0}));
  EXPECT_EQ(reduced.controller.input_matrix[0][0], 30.0);
  // 100 N m/rad at the joint is 2 N m at the motor per rad of the joint, 0.04 N m per rad of the
  // motor.
  Drive mixed = joint({.proportional = 2.0});
  choose_shaft(mixed, 2);
  Drive at_motor = joint({.proportional = 0.04});
  at_motor.controller.shaft = GainShaft::motor;
  for (const Drive& same : {mixed, at_motor}) {
    EXPECT_DOUBLE_EQ(gain_scale(same) * std::get<PID>(same.controller.law).proportional, 100.0);
    EXPECT_DOUBLE_EQ(proportional_servo(same)->natural_frequency,
                     std::sqrt(100.0 / (0.02 + 2e-4 * ratio * ratio)));
  }
}

TEST(JointGains, AreReportedAtBothShafts) {
  Drive drive = joint({.terms = PIDTerms::PD, .proportional = 2.0, .derivative = 0.1});
  choose_shaft(drive, 2);
  const std::vector<PlacedGain> gains = placed_gains(drive);
  ASSERT_EQ(gains.size(), 2U);
  EXPECT_EQ(gains[0].path, "controller.proportional");
  EXPECT_EQ(gains[0].unit, "N m/rad");
  EXPECT_DOUBLE_EQ(gains[0].at_joint, 100.0);
  EXPECT_DOUBLE_EQ(gains[0].at_motor, 0.04);
  EXPECT_EQ(gains[1].unit, "N m s/rad");
  EXPECT_DOUBLE_EQ(gains[1].at_joint, 5.0);
  EXPECT_DOUBLE_EQ(gains[1].at_motor, 0.002);
  Drive of_volts = drive;
  of_volts.motor.kind = TwoPhase{0.1, 0.1};
  EXPECT_TRUE(placed_gains(of_volts).empty());
  EXPECT_TRUE(placed_gains(normal_form(0.2, 1.0, 0.2)).empty());
}

TEST(JointGains, OfAMotorDrivenByAVoltageAreVolts) {
  Drive drive = joint({.proportional = 2.0});
  drive.motor.kind = ArmatureControl{0.1, 0.1, 1.0};
  EXPECT_TRUE(faults(drive).empty());
  EXPECT_DOUBLE_EQ(gain_scale(drive), 0.1 * ratio);  // N m at the load per V
  choose_shaft(drive, 1);
  EXPECT_DOUBLE_EQ(gain_scale(drive), 0.1 * ratio * ratio);
  for (const std::size_t load_or_mixed : {0U, 2U}) {
    choose_shaft(drive, load_or_mixed);
    EXPECT_TRUE(faults(drive).empty());
    EXPECT_DOUBLE_EQ(gain_scale(drive), 0.1 * ratio);
  }
}

TEST(JointGains, EnterTheClosedForm) {
  Drive drive = joint({.terms = PIDTerms::PD, .proportional = 100.0, .derivative = 2.0});
  drive.sensor.position = SensorPlace::both;
  drive.motor.kind = TorqueControl{.torque_constant = 0.03};
  EXPECT_FALSE(enters_servo(drive, "gearbox.inertia"));  // 0 as by default
  drive.gearbox.inertia = 1e-5;
  for (const std::size_t shaft : {0U, 1U, 2U}) {
    choose_shaft(drive, shaft);
    for (const char* path :
         {"gearbox.ratio", "gearbox.inertia", "controller.proportional", "controller.derivative"}) {
      EXPECT_TRUE(enters_servo(drive, path)) << path;
    }
    // Of no effect; of none by itself; no number; none of this drive.
    for (const char* path : {"motor.torque_constant", "motor.coulomb", "sensor.position",
                             "motor.resistance", "load.mass"}) {
      EXPECT_FALSE(enters_servo(drive, path)) << path;
    }
  }
}

TEST(Currents, GiveLimitAndFrictionOfATorqueControlledMotor) {
  Drive drive = joint({.proportional = 2.0});
  EXPECT_THROW(set(drive, "motor.current_limit", 6.0), InvalidInput);  // no torque constant yet
  set(drive, "motor.torque_constant", 0.0302);
  set(drive, "motor.current_limit", 6.0);
  set(drive, "motor.no_load_current", 0.137);
  const drive::ReducedDrive reduced = reduce(drive);
  EXPECT_DOUBLE_EQ(reduced.torque_limit, 0.0302 * 6.0 * ratio);
  EXPECT_DOUBLE_EQ(reduced.motor.friction.coulomb, 0.0302 * 0.137 * ratio);
  EXPECT_TRUE(faults(drive).empty());
  EXPECT_THROW(set(drive, "motor.torque_limit", 1.0), InvalidInput);
  drive.motor.limit = 1.0;
  ASSERT_EQ(faults(drive).size(), 1U);
  EXPECT_EQ(faults(drive)[0].path, "motor.torque_limit");
}

}  // namespace
}  // namespace gearlash::joint_gains_test
