// What is refused, in which words, and that nothing is refused at the ends of the ranges.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>
#include <vector>

#include "base/range_check.hpp"
#include "model/proportional_servo.hpp"
#include "model/reduced_drive.hpp"

namespace gearlash::validation_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAre;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

std::vector<std::string> fields(const std::vector<Fault>& faults) {
  std::vector<std::string> names;
  for (const Fault& fault : faults) names.push_back(fault.path);
  return names;
}

NormalizedServo sound_servo() {
  return {.damping = 0.2,
          .inertia_ratio = 2.0,
          .friction_ratio = 0.25,
          .backlash = 0.3,
          .restitution = 0.5};
}

Drivetrain sound_drivetrain() {
  return {.motor_inertia = 1.0,
          .load_inertia = 2.0,
          .motor_friction = 0.5,
          .load_friction = 0.25,
          .stiffness = 4.0,
          .backlash = 0.1};
}

Drive sound_data_sheet() {
  Drive drive;
  drive.motor = {.kind = ArmatureControl{1.0, 1.0, 1.0}, .inertia = 1.0, .friction = {1.0}};
  drive.gearbox = {.ratio = 2.0, .backlash = 0.1};
  drive.load = {3.0, {.viscous = 0.5}};
  drive.controller.law = PID{.proportional = 2.0};
  return drive;
}

TEST(EdgeNormalizedServoRanges, EndsArePermitted) {
  const auto permitted = [](auto member, const std::vector<double>& values) {
    for (const double value : values) {
      NormalizedServo servo = sound_servo();
      servo.*member = value;
      EXPECT_THAT(faults(servo), IsEmpty()) << value;
    }
  };
  permitted(&NormalizedServo::damping, {0.0, 1e-15, 1e3});
  permitted(&NormalizedServo::inertia_ratio, {0.0, 1e-9, 1e9, infinity});
  permitted(&NormalizedServo::friction_ratio, {0.0, 1.0});
  permitted(&NormalizedServo::restitution, {0.0, 1.0});
  permitted(&NormalizedServo::backlash, {0.0, 1e-15, 1e6});
}

TEST(EdgeNormalizedServoRanges, OneStepBeyondIsRefused) {
  const auto refused = [](auto member, double value, const char* name) {
    NormalizedServo servo = sound_servo();
    servo.*member = value;
    EXPECT_THAT(fields(faults(servo)), ElementsAre(name)) << value;
  };
  const double below_zero = -5e-324;
  const double above_one = std::nextafter(1.0, 2.0);
  for (const double bad : {below_zero, std::nextafter(1e-15, 0.0), std::nextafter(1e3, 1e4), nan,
                           infinity, -infinity}) {
    refused(&NormalizedServo::damping, bad, "damping");
  }
  for (const double bad : {below_zero, 5e-324, std::nextafter(1e-9, 0.0),
                           std::nextafter(1e9, infinity), -infinity, nan}) {
    refused(&NormalizedServo::inertia_ratio, bad, "inertia_ratio");
  }
  for (const double bad : {below_zero, above_one, nan, infinity}) {
    refused(&NormalizedServo::friction_ratio, bad, "friction_ratio");
    refused(&NormalizedServo::restitution, bad, "restitution");
  }
  for (const double bad :
       {below_zero, std::nextafter(1e-15, 0.0), std::nextafter(1e6, 1e7), nan, infinity}) {
    refused(&NormalizedServo::backlash, bad, "backlash");
  }
}

TEST(EdgeNormalizedServoRanges, MasslessShaftsNeedFriction) {
  NormalizedServo servo = sound_servo();
  servo.inertia_ratio = 0.0;
  servo.friction_ratio = 0.0;
  EXPECT_THAT(fields(faults(servo)), ElementsAre("inertia_ratio"));
  servo.friction_ratio = 1.0;
  EXPECT_THAT(faults(servo), IsEmpty());
  servo.inertia_ratio = infinity;
  EXPECT_THAT(fields(faults(servo)), ElementsAre("inertia_ratio"));
  servo.friction_ratio = 0.0;
  EXPECT_THAT(faults(servo), IsEmpty());
  servo.damping = 0.0;
  EXPECT_THAT(fields(faults(servo)), ElementsAre("inertia_ratio"));
}

TEST(EdgeNormalizedServoRanges, AllFaultsAreListed) {
  const NormalizedServo servo{.damping = -1.0,
                              .inertia_ratio = -2.0,
                              .friction_ratio = 3.0,
                              .backlash = nan,
                              .restitution = 2.0};
  EXPECT_THAT(fields(faults(servo)),
              ElementsAre("damping", "inertia_ratio", "friction_ratio", "backlash", "restitution"));
}

TEST(EdgeDataSheetRanges, AllFaultsAreListedForEachMotor) {
  Drive drive = sound_data_sheet();
  drive.motor = {.kind = ArmatureControl{0.0, -1.0, 0.0}, .inertia = -1.0, .friction = {nan}};
  drive.gearbox = {.ratio = 0.0, .backlash = -1.0};
  drive.load = {-1.0, {.viscous = infinity}};
  drive.contact = RigidContact{-0.5};
  EXPECT_THAT(fields(faults(drive)),
              UnorderedElementsAre("motor.inertia", "motor.friction", "motor.torque_constant",
                                   "motor.back_emf_constant", "motor.resistance", "gearbox.ratio",
                                   "gearbox.backlash", "load.inertia", "load.friction",
                                   "contact.restitution"));
  drive.motor.kind = FieldControl{-1.0, -1.0};
  EXPECT_THAT(fields(faults(drive)),
              UnorderedElementsAre("motor.inertia", "motor.friction", "motor.torque_constant",
                                   "motor.resistance", "gearbox.ratio", "gearbox.backlash",
                                   "load.inertia", "load.friction", "contact.restitution"));
  drive.motor.kind = TwoPhase{0.0, -1.0};
  EXPECT_THAT(fields(faults(drive)),
              UnorderedElementsAre("motor.inertia", "motor.friction", "motor.torque_per_volt",
                                   "motor.torque_per_speed", "gearbox.ratio", "gearbox.backlash",
                                   "load.inertia", "load.friction", "contact.restitution"));
}

TEST(EdgeDataSheetRanges, ZerosThatArePermitted) {
  Drive drive = sound_data_sheet();
  drive.gearbox.backlash = 0.0;
  drive.load = {0.0, {.viscous = 0.5}};
  EXPECT_THAT(faults(drive), IsEmpty());
  drive.motor = {.kind = TwoPhase{1.0, 1.0}, .inertia = 0.0, .friction = {0.0}};
  drive.load = {1.0, {.viscous = 0.0}};
  EXPECT_THAT(faults(drive), IsEmpty());
}

TEST(EdgeDataSheetRanges, NoInertiaAnywhereIsRefused) {
  Drive drive = sound_data_sheet();
  drive.motor = {.kind = FieldControl{1.0, 1.0}, .inertia = 0.0, .friction = {1.0}};
  drive.load.inertia = 0.0;
  EXPECT_THAT(faults(drive), testing::SizeIs(1));
  EXPECT_FALSE(proportional_servo(drive));
}

TEST(EdgeDataSheetRanges, OverflowInReferringIsRefusedNotReturned) {
  Drive drive = sound_data_sheet();
  drive.gearbox.ratio = 1e200;  // its square is no double
  EXPECT_THAT(faults(drive), testing::Not(IsEmpty()));
  EXPECT_FALSE(proportional_servo(drive));
}

TEST(EdgeDrivetrainRanges, AllFaultsAreListed) {
  const Drivetrain drivetrain{.motor_inertia = -1.0,
                              .load_inertia = nan,
                              .motor_friction = -1.0,
                              .load_friction = infinity,
                              .stiffness = 0.0};
  EXPECT_THAT(
      fields(faults(drivetrain)),
      ElementsAre("motor_inertia", "load_inertia", "motor_friction", "load_friction", "stiffness"));
}

TEST(EdgeDrivetrainRanges, EveryFieldAtFaultIsListedAtOnce) {
  Drivetrain drivetrain = sound_drivetrain();
  drivetrain.stiffness = -1.0;
  drivetrain.backlash = -1.0;
  drivetrain.restitution = 2.0;
  EXPECT_THAT(fields(faults(drivetrain)),
              UnorderedElementsAre("stiffness", "backlash", "restitution"));
}

TEST(EdgeDrivetrainRanges, NormalizeThrowsAllOfThem) {
  Drivetrain drivetrain = sound_drivetrain();
  drivetrain.motor_friction = nan;
  drivetrain.stiffness = -1.0;
  try {
    normalize(drivetrain);
    FAIL() << "accepted";
  } catch (const InvalidInput& error) {
    EXPECT_THAT(fields(error.faults()), ElementsAre("motor_friction", "stiffness"));
    EXPECT_THAT(error.what(), HasSubstr("motor_friction = nan"));
    EXPECT_THAT(error.what(), HasSubstr("\n"));  // a line each
    EXPECT_THAT(error.what(), HasSubstr("stiffness = -1"));
  }
}

TEST(EdgeFaultText, NamesFieldValueAndWhatIsPermitted) {
  EXPECT_EQ(to_string({"motor.inertia", "-1 kg m2", "must be positive", "servo.toml:3:11"}),
            "servo.toml:3:11: motor.inertia = -1 kg m2: must be positive");
  EXPECT_EQ(to_string({"load.inertia", "", "needed", ""}), "load.inertia is missing: needed");
  for (const Fault& fault : faults(NormalizedServo{.damping = -1.0})) {
    EXPECT_FALSE(fault.value.empty());
    EXPECT_FALSE(fault.permitted.empty());
  }
}

TEST(EdgeFaultText, RequireNoneThrowsOnlyWhenThereIsOne) {
  EXPECT_NO_THROW(require_none({}));
  EXPECT_THROW(require_none({{"a", "b", "c", ""}}), InvalidInput);
}

TEST(PropertyExactText, ReadsBackAsTheSameDouble) {
  for (const double value : {0.1, 1.0 / 3.0, 5e-324, 1.7976931348623157e308, -2.5e-17, 0.0, 1e22,
                             123456789.0, std::nextafter(1.0, 2.0)}) {
    // strtod, because stod refuses the subnormal.
    EXPECT_EQ(std::strtod(exact_text(value).c_str(), nullptr), value);
  }
  EXPECT_EQ(exact_text(0.1), "0.1");
  EXPECT_EQ(exact_text(infinity), "inf");
  EXPECT_EQ(exact_text(-infinity), "-inf");
  EXPECT_EQ(exact_text(nan), "nan");
}

}  // namespace
}  // namespace gearlash::validation_test
