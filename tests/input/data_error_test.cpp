// Numbers of a data sheet in SI, at the load's shaft, are as near to the data as boxes take them to
// be: units, products and all, in extended precision.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "base/references.hpp"
#include "closed_form/cycle_bounds.hpp"
#include "input/servo_of_file.hpp"

namespace gearlash::data_error_test {
namespace {

// By definition: the pound, standard gravity, the inch.
const Wide ounce = 0.45359237L / 16;
const Wide gravity = 9.80665L;
const Wide inch = 0.0254L;
const Wide foot = 12 * inch;
const Wide slug = 0.45359237L * gravity / foot;
const Wide ounce_inch = ounce * gravity * inch;  // a torque
const Wide turn_per_minute = 2 * std::numbers::pi_v<Wide> / 60;

void expect_near(double actual, Wide exact) {
  const DataError error;
  EXPECT_LE(std::abs(epsilons_off(actual, exact)), error.each / epsilon / 2) << exact;
}

ServoOfFile example(const char* name) {
  return read_servo(std::string(GEARLASH_SOURCE_DIRECTORY) + "/examples/" + name);
}

TEST(OracleDataError, ArmatureControlledMotor) {
  const Drivetrain drive = example("elinco-fd162.toml").drivetrain.value();
  const Wide torque_per_volt = 28.2L * ounce_inch / 282;
  expect_near(drive.motor_inertia, 0.61L * ounce * inch * inch);
  expect_near(drive.load_inertia, 16.4e-6L * slug * foot * foot);
  expect_near(drive.motor_friction, 0.00064L * ounce_inch + torque_per_volt * 0.233L);
  expect_near(drive.load_friction, 0.002L * ounce_inch);
  expect_near(drive.stiffness, torque_per_volt * 10);
}

TEST(OracleDataError, TwoPhaseMotorBehindGears) {
  const Drivetrain drive = example("instrument-two-phase.toml").drivetrain.value();
  const Wide square = 3600;
  const Wide per_krpm = 1 / (1000 * turn_per_minute);
  expect_near(drive.motor_inertia, 1.07e-7L * square);
  expect_near(drive.load_inertia, 30e-7L);
  expect_near(drive.motor_friction, (0.004L + 0.1L) * ounce_inch * per_krpm * square);
  expect_near(drive.load_friction, 0.05L * ounce_inch);
  expect_near(drive.stiffness, 0.00522L * ounce_inch * 900 * 60);
  expect_near(drive.backlash, Wide(20) / 60 * std::numbers::pi_v<Wide> / 180);
}

}  // namespace
}  // namespace gearlash::data_error_test
