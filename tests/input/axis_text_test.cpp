// Axes as they are typed on the command line.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "gearlash/fault.hpp"
#include "gearlash/input.hpp"

namespace gearlash::axis_text_test {
namespace {

Axis axis(std::string_view text, const Drive& drive = normal_form(0.5, 1.0, 0.5)) {
  return read_axis(split_axis("--x", text), drive_of_axes(drive, {split_axis("--x", text)}));
}

std::string fault(std::string_view text, const Drive& drive = normal_form(0.5, 1.0, 0.5)) {
  try {
    axis(text, drive);
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "none";
}

TEST(AxisText, IsReadInItsThreeForms) {
  EXPECT_EQ(axis("damping=0.1,0.2,1/2"), (Axis{"servo.damping", {0.1, 0.2, 0.5}}));
  const Axis linear = axis("friction_ratio=0:1:5");
  EXPECT_EQ(linear, (Axis{"servo.friction_ratio", {0.0, 0.25, 0.5, 0.75, 1.0}}));
  const Axis logarithmic = axis("inertia-ratio=1/9:9:3:log");
  EXPECT_EQ(logarithmic.path, "servo.inertia_ratio");
  EXPECT_TRUE(logarithmic.logarithmic);
  EXPECT_THAT(logarithmic.values,
              testing::ElementsAre(1.0 / 9.0, testing::DoubleNear(1.0, 1e-15), 9.0));
}

TEST(AxisText, BacklashMayHaveItsUnit) {
  const Axis read = axis("backlash=6 arcmin,1 deg");
  EXPECT_THAT(read.values,
              testing::ElementsAre(testing::DoubleNear(std::numbers::pi / 1800, 1e-15),
                                   testing::DoubleNear(std::numbers::pi / 180, 1e-15)));
}

Drive joint() {
  Drive drive;
  drive.motor = {.inertia = 2e-4, .friction = {.viscous = 1e-3}};
  drive.gearbox = {.ratio = 20.0, .backlash = 0.01};
  drive.load = {.inertia = 0.05, .friction = {.viscous = 0.05}};
  drive.controller.law = PID{.terms = PIDTerms::P, .proportional = 1.0};
  return drive;
}

TEST(AxisText, AnyParameterOfTheDriveHasAnAxis) {
  EXPECT_EQ(axis("controller.proportional=1:10:2:log", joint()),
            (Axis{"controller.proportional", {1.0, 10.0}, true}));
  EXPECT_EQ(axis("controller.kp=0.5 N m/rad, 1", joint()), (Axis{"controller.kp", {0.5, 1.0}}));
  EXPECT_EQ(axis("sensor.position=motor,load", joint()), (Axis{"sensor.position", {1.0, 0.0}}));
  EXPECT_THAT(axis("sampling.frequency=1 kHz,2 kHz", joint()).values,
              testing::Pointwise(testing::DoubleEq(),
                                 {2000.0 * std::numbers::pi, 4000.0 * std::numbers::pi}));
  EXPECT_EQ(axis("sampling.period=2 kHz,1 kHz", joint()).values,
            (std::vector<double>{0.0005, 0.001}));
  const Axis backlash = axis("backlash=1 arcmin:30 arcmin:3", joint());
  EXPECT_EQ(backlash.path, "gearbox.backlash");
  EXPECT_NEAR(backlash.values[0], std::numbers::pi / 180 / 60, 1e-18);
}

/// What a data sheet does not have is varied in its normal form, whose natural frequency stays.
TEST(AxisText, NumbersOfTheNormalFormAreVariedOfADataSheetToo) {
  const Drive form = drive_of_axes(joint(), {split_axis("--x", "damping=0.1,0.2")});
  ASSERT_TRUE(form.servo.has_value());
  EXPECT_TRUE(form.servo->natural_frequency.has_value());
  EXPECT_EQ(axis("damping=0.1,0.2", joint()), (Axis{"servo.damping", {0.1, 0.2}}));
}

TEST(EdgeAxisText, FaultsOfPathsAndWordsSaySo) {
  const auto fault_of = [](std::string_view text) { return fault(text, joint()); };
  EXPECT_EQ(
      fault_of("controller.proportinal=1,2"),
      "--x = controller.proportinal: must be a number or a choice of this drive (did you mean "
      "controller.proportional?); gearlash show lists them");
  EXPECT_EQ(fault_of("sensor.position=load,moon"),
            "--x = moon: must be one of load, motor, both (did you mean motor?)");
  EXPECT_THAT(fault_of("sensor.position=0:1:2"), testing::HasSubstr("must be PATH=FROM:TO:COUNT"));
  EXPECT_THAT(fault_of("gearbox.backlash=1 kg,2 kg"),
              testing::StartsWith("--x = 1 kg: must be an angle"));
  EXPECT_EQ(fault_of("gearbox.ratio=0,2"), "--x = 0: gearbox.ratio must be positive and finite");
}

TEST(EdgeAxisText, EachFaultIsOneLine) {
  const std::string forms = "must be PATH=FROM:TO:COUNT, PATH=FROM:TO:COUNT:log or PATH=A,B,C";
  EXPECT_EQ(fault(""), "--x = \"\": " + forms);
  EXPECT_EQ(fault("damping"), "--x = damping: " + forms);
  EXPECT_EQ(fault("damping="), "--x = damping=: " + forms);
  EXPECT_EQ(fault("damping=1:2"), "--x = damping=1:2: " + forms);
  EXPECT_EQ(fault("damping=0.1:0.2:5:lin"), "--x = damping=0.1:0.2:5:lin: " + forms);
  EXPECT_EQ(
      fault("stiffness=1:2:3"),
      "--x = stiffness: must be a number or a choice of this drive; gearlash show lists them");
  EXPECT_EQ(fault("damping=0.1:0.6:0"), "--x = 0 values: must be from 1 to 1000000");
  EXPECT_EQ(fault("damping=0.1:0.6:1000000000000"),
            "--x = 1000000000000 values: must be from 1 to 1000000");
  EXPECT_EQ(fault("damping=0.1:0.6:-3"),
            "--x = -3: must be a count, a whole number from 1 to 1000000");
  EXPECT_EQ(fault("damping=0.6:0.1:5:log"), "--x = 0.6 to 0.1: must rise: the smaller value first");
  EXPECT_EQ(fault("inertia-ratio=0:9:5:log"), "--x = 0: must be positive on a logarithmic axis");
  EXPECT_EQ(fault("friction-ratio=0.5,1.5"), "--x = 1.5: servo.friction_ratio must be from 0 to 1");
  EXPECT_THAT(fault("damping=0.1,,0.3"), testing::StartsWith("--x = \"\": must be"));
  for (const std::string count : {"2.5", "99999999999999999999"}) {
    EXPECT_EQ(fault("damping=0.1:0.5:" + count),
              "--x = " + count + ": must be a count, a whole number from 1 to 1000000");
  }
  for (const std::string first : {"0.1", "0.3"}) {
    EXPECT_EQ(fault("damping=" + first + ",0.1"),
              "--x = " + first + " before 0.1: must rise from value to value");
  }
}

}  // namespace
}  // namespace gearlash::axis_text_test
