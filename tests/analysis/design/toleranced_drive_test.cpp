// Drives of which numbers vary: what may not be drawn is refused beforehand.
#include "analysis/design/toleranced_drive.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "analysis/design/changeable_drive.hpp"

namespace gearlash {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

Datasheet sound_datasheet() {
  return {.motor = ArmatureControlledMotor{.inertia = 1e-5,
                                           .friction = 5e-6,
                                           .torque_constant = 0.2,
                                           .back_emf_constant = 0.2,
                                           .resistance = 282.0},
          .gearbox = {.ratio = 2.0, .backlash = 0.1},
          .load = {.inertia = 2e-5, .friction = 1e-5},
          .loop = {.error_gain = 10.0},
          .contact = {}};
}

TolerancedDrive with(DriveNumber number, const Distribution& distribution) {
  TolerancedDrive drive;
  drive.nominal = sound_datasheet();
  drive.varied = {{number, distribution}};
  return drive;
}

TolerancedDrive normalised_with(DriveNumber number, const Distribution& distribution) {
  TolerancedDrive drive;
  drive.nominal = NormalizedServo{
      .damping = 0.19, .inertia_ratio = 2.0, .friction_ratio = 0.1, .backlash = 0.3};
  drive.varied = {{number, distribution}};
  return drive;
}

std::vector<std::string> faults_of(const TolerancedDrive& drive) {
  std::vector<std::string> lines;
  for (const Fault& fault : validate(drive)) lines.push_back(to_string(fault));
  return lines;
}

TEST(TolerancedDrive, IsTheDriveWithItsValues) {
  TolerancedDrive drive = with(DriveNumber::motor_resistance, within_share(282.0, 0.1));
  drive.varied.push_back({DriveNumber::load_inertia, Normal{2e-5, 1e-6}});
  ASSERT_THAT(faults_of(drive), IsEmpty());
  Datasheet expected = sound_datasheet();
  std::get<ArmatureControlledMotor>(expected.motor).resistance = 300.0;
  expected.load.inertia = 3e-5;
  const Drivetrain drivetrain = to_drivetrain(expected);
  const TimedServo found = drive_with(drive, std::vector{300.0, 3e-5});
  EXPECT_EQ(found.servo, normalize(drivetrain));
  EXPECT_EQ(found.natural_frequency, natural_frequency(drivetrain));
  EXPECT_THROW(drive_with(drive, std::vector{300.0}), std::invalid_argument);
  EXPECT_THROW(drive_with(drive, std::vector{-300.0, 3e-5}), InvalidInput);
}

TEST(TolerancedDrive, EveryNumberOfADataSheetCanBeVaried) {
  for (const SheetMotor& motor : {SheetMotor(ArmatureControlledMotor{1e-5, 5e-6, 0.2, 0.2, 282.0}),
                                  SheetMotor(FieldControlledMotor{1e-5, 5e-6, 0.2, 282.0}),
                                  SheetMotor(TwoPhaseMotor{1e-5, 5e-6, 0.2, 1e-5})}) {
    int numbers = 0;
    for (const DriveNumber number : all_drive_numbers) {
      EXPECT_EQ(drive_number_named(name_of(number)), number);
      TolerancedDrive drive = with(number, UniformBetween{0.01, 0.02});
      std::get<Datasheet>(drive.nominal).motor = motor;
      if (!faults_of(drive).empty()) continue;
      ++numbers;
      EXPECT_NE(drive_with(drive, std::vector{0.01}), drive_with(drive, std::vector{0.02}))
          << name_of(number);
    }
    EXPECT_EQ(numbers, motor.index() == 0 ? 11 : 10);
  }
}

TEST(EdgeTolerancedDrive, OfOneNumberEveryFaultIsNamed) {
  EXPECT_THAT(
      faults_of(with(DriveNumber::motor_resistance, Normal{282.0, 100.0})),
      ElementsAre("motor.resistance = normal with mean 282 and standard deviation 100: must "
                  "stay positive: give it a min"));
  EXPECT_THAT(faults_of(with(DriveNumber::load_inertia, Normal{2e-5, 1e-5})),
              ElementsAre(HasSubstr("must stay positive: give it a min")));
  EXPECT_THAT(faults_of(with(DriveNumber::load_inertia, Normal{2e-5, 1e-6})), IsEmpty());
  EXPECT_THAT(faults_of(with(DriveNumber::motor_resistance, UniformBetween{0.0, 300.0})),
              ElementsAre("motor.resistance = uniform from 0 to 300: must stay positive"));
  EXPECT_THAT(faults_of(with(DriveNumber::load_inertia, within_share(2e-5, 2.0))),
              ElementsAre("load.inertia = 2e-05 +- 4e-05: must not fall below zero"));
  EXPECT_THAT(
      faults_of(with(DriveNumber::contact_restitution, UniformBetween{-0.1, 1.1})),
      ElementsAre("contact.restitution = uniform from -0.1 to 1.1: must stay within 0 to 1"));
  EXPECT_THAT(faults_of(with(DriveNumber::contact_restitution, Normal{0.5, 0.1})),
              ElementsAre(HasSubstr("must stay within 0 to 1: give it a min and a max")));
  EXPECT_THAT(faults_of(with(DriveNumber::contact_restitution, Normal{0.5, 0.1, 0.1, {}})),
              ElementsAre(HasSubstr("must stay within 0 to 1: give it a max")));
  EXPECT_THAT(
      faults_of(with(DriveNumber::motor_torque_per_volt, ExactValue{1.0})),
      ElementsAre(HasSubstr("must be a number of this drive: motor.inertia, motor.friction, "
                            "motor.torque_constant, motor.back_emf_constant, "
                            "motor.resistance, gearbox.ratio, gearbox.backlash, "
                            "load.inertia, load.friction, loop.error_gain, "
                            "contact.restitution")));
  EXPECT_THAT(faults_of(normalised_with(DriveNumber::load_inertia, ExactValue{1.0})),
              ElementsAre(HasSubstr("must be a number of this drive: servo.damping, ")));
}

TEST(EdgeTolerancedDrive, AllFaultsAreListedAtOnce) {
  TolerancedDrive drive = with(DriveNumber::motor_resistance, UniformBetween{300.0, 200.0});
  drive.varied.push_back({DriveNumber::motor_resistance, ExactValue{-1.0}});
  drive.varied.push_back({DriveNumber::gearbox_backlash, Normal{0.1, 0.1}});
  std::get<Datasheet>(drive.nominal).gearbox.ratio = 0.0;
  EXPECT_THAT(faults_of(drive), ElementsAre(HasSubstr("motor.resistance.max = 200"),
                                            "motor.resistance = -1: must be given once",
                                            "motor.resistance = -1: must stay positive",
                                            HasSubstr("gearbox.backlash = normal with"),
                                            HasSubstr("gearbox.ratio = 0")));
}

TEST(EdgeTolerancedDrive, ACornerThatIsNoDriveIsRefused) {
  EXPECT_THAT(
      faults_of(normalised_with(DriveNumber::servo_inertia_ratio, UniformBetween{0.0, 1.0})),
      ElementsAre(AllOf(HasSubstr("servo.inertia_ratio = "),
                        HasSubstr("; the tolerances permit it where servo.inertia_ratio = "))));
  EXPECT_THAT(faults_of(normalised_with(DriveNumber::servo_damping, UniformBetween{1.0, 2000.0})),
              ElementsAre(HasSubstr("servo.damping = ")));
  EXPECT_THAT(faults_of(normalised_with(DriveNumber::servo_backlash, UniformBetween{0.0, 1.0})),
              IsEmpty());
}

TEST(EdgeTolerancedDrive, NothingVariedIsTheNominalDrive) {
  TolerancedDrive drive;
  drive.nominal = sound_datasheet();
  EXPECT_THAT(faults_of(drive), IsEmpty());
  EXPECT_EQ(drive_with(drive, {}).servo, normalize(to_drivetrain(sound_datasheet())));
  EXPECT_EQ(nominal_backlash_of(drive), 0.1);
  EXPECT_EQ(place_of_backlash(drive), std::nullopt);
}

}  // namespace
}  // namespace gearlash
