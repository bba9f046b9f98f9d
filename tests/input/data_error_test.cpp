// Numbers of a data sheet in SI, at the load's shaft, are as near to the data as boxes take them to
// be: units, products and all, in fifty digits.
#include <gtest/gtest.h>

#include <boost/math/constants/constants.hpp>
#include <cmath>
#include <string>

#include "base/fifty_digits.hpp"
#include "closed_form/cycle_bounds.hpp"
#include "input/servo_of_file.hpp"

namespace gearlash::data_error_test {
namespace {

// By definition: the pound, standard gravity, the inch.
const Wide ounce = Wide("0.45359237") / 16;
const Wide gravity("9.80665");
const Wide inch("0.0254");
const Wide foot = 12 * inch;
const Wide slug = Wide("0.45359237") * gravity / foot;
const Wide ounce_inch = ounce * gravity * inch;  // a torque
const Wide turn_per_minute = 2 * boost::math::constants::pi<Wide>() / 60;

void expect_near(double actual, const Wide& exact) {
  const DataError error;
  EXPECT_LE(std::abs(epsilons_off(actual, exact)), error.each / epsilon / 2) << exact;
}

ServoOfFile example(const char* name) {
  return read_servo(std::string(GEARLASH_SOURCE_DIRECTORY) + "/examples/" + name);
}

TEST(OracleDataError, ArmatureControlledMotor) {
  const Drivetrain drive = example("elinco-fd162.toml").drivetrain.value();
  const Wide torque_per_volt = Wide("28.2") * ounce_inch / 282;
  expect_near(drive.motor_inertia, Wide("0.61") * ounce * inch * inch);
  expect_near(drive.load_inertia, Wide("16.4e-6") * slug * foot * foot);
  expect_near(drive.motor_friction, Wide("0.00064") * ounce_inch + torque_per_volt * Wide("0.233"));
  expect_near(drive.load_friction, Wide("0.002") * ounce_inch);
  expect_near(drive.stiffness, torque_per_volt * 10);
}

TEST(OracleDataError, TwoPhaseMotorBehindGears) {
  const Drivetrain drive = example("instrument-two-phase.toml").drivetrain.value();
  const Wide square = 3600;
  const Wide per_krpm = 1 / (1000 * turn_per_minute);
  expect_near(drive.motor_inertia, Wide("1.07e-7") * square);
  expect_near(drive.load_inertia, Wide("30e-7"));
  expect_near(drive.motor_friction, (Wide("0.004") + Wide("0.1")) * ounce_inch * per_krpm * square);
  expect_near(drive.load_friction, Wide("0.05") * ounce_inch);
  expect_near(drive.stiffness, Wide("0.00522") * ounce_inch * 900 * 60);
  expect_near(drive.backlash, Wide(20) / 60 * boost::math::constants::pi<Wide>() / 180);
}

}  // namespace
}  // namespace gearlash::data_error_test
