// Drives of which numbers vary: what may not be drawn is refused beforehand.
#include "question/series/toleranced_drive.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "model/parameters.hpp"
#include "question/change/drives.hpp"
#include "toleranced_samples.hpp"

namespace gearlash::toleranced_drive_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr Sheet sheet{.motor_inertia = 1e-5,
                      .motor_friction = 5e-6,
                      .ratio = 2.0,
                      .backlash = 0.1,
                      .load_inertia = 2e-5,
                      .load_friction = 1e-5,
                      .error_gain = 10.0};

Drive sound_drive() {
  return drive_of(
      ArmatureControl{.torque_constant = 0.2, .back_emf_constant = 0.2, .resistance = 282.0},
      sheet);
}

TolerancedDrive with(const char* path, const Distribution& distribution) {
  return {sound_drive(), {{path, distribution}}};
}

TolerancedDrive normalised_with(const char* path, const Distribution& distribution) {
  return {normal_form(0.19, 2.0, 0.1, 0.3), {{path, distribution}}};
}

std::vector<std::string> faults_of(const TolerancedDrive& drive) {
  std::vector<std::string> lines;
  for (const Fault& fault : faults(drive)) lines.push_back(to_string(fault));
  return lines;
}

TEST(TolerancedDrive, IsTheDriveWithItsValues) {
  TolerancedDrive drive = with("motor.resistance", within_share(282.0, 0.1));
  drive.varied.push_back({"load.inertia", Normal{2e-5, 1e-6}});
  EXPECT_FALSE(is_searched(drive));
  ASSERT_THAT(faults_of(drive), IsEmpty());
  Drive expected = sound_drive();
  std::get<ArmatureControl>(expected.motor.kind).resistance = 300.0;
  expected.load.inertia = 3e-5;
  const Drivetrain drivetrain = proportional_servo(expected).value().drivetrain;
  const ProportionalServo found = drive_with(drive, std::vector{300.0, 3e-5});
  EXPECT_EQ(found.servo, normalize(drivetrain));
  EXPECT_EQ(found.natural_frequency, natural_frequency(drivetrain));
}

/// Of every parameter on which the closed form depends.
std::size_t count_varied(const Drive& nominal) {
  std::size_t numbers = 0;
  for (const Parameter& parameter : all_parameters_of_drives()) {
    if (!exists(parameter, nominal)) continue;
    const TolerancedDrive drive{nominal,
                                {{std::string(parameter.path), UniformBetween{0.01, 0.02}}}};
    if (!faults_of(drive).empty() || is_searched(drive)) continue;
    const ProportionalServo low = drive_with(drive, std::vector{0.01});
    const ProportionalServo high = drive_with(drive, std::vector{0.02});
    if (low.servo != high.servo || low.natural_frequency != high.natural_frequency) ++numbers;
  }
  return numbers;
}

TEST(TolerancedDrive, EveryNumberOfADataSheetCanBeVaried) {
  EXPECT_EQ(count_varied(sound_drive()), 13U);
  EXPECT_EQ(count_varied(drive_of(FieldControl{0.2, 282.0}, sheet)), 12U);
  EXPECT_EQ(count_varied(drive_of(TwoPhase{0.2, 1e-5}, sheet)), 12U);
  EXPECT_EQ(count_varied(drive_of(TorqueControl{}, sheet)), 10U);
  Drive with_frequency = normal_form(0.19, 2.0, 0.1, 0.3);
  EXPECT_EQ(count_varied(with_frequency), 6U);  // one of them gives it a natural frequency
  with_frequency.servo->natural_frequency = 3.0;
  EXPECT_EQ(count_varied(with_frequency), 6U);
}

// Speed fed back from the motor is friction on it, as large as the gain says.
TEST(TolerancedDrive, ATachometersGainCanBeVaried) {
  TolerancedDrive drive{sound_drive(), {{"controller.derivative", UniformBetween{0.0, 0.01}}}};
  drive.nominal.controller.law =
      PID{.terms = PIDTerms::PD, .proportional = 10.0, .derivative_of_speed = true};
  EXPECT_TRUE(is_searched(drive));  // the speed is the load's
  drive.nominal.sensor.speed = ShaftName::motor;
  EXPECT_FALSE(is_searched(drive));
  ASSERT_THAT(faults_of(drive), IsEmpty());
  Drive expected = drive.nominal;
  std::get<PID>(expected.controller.law).derivative = 0.004;
  EXPECT_EQ(drive_with(drive, std::vector{0.004}).servo, proportional_servo(expected)->servo);
}

/// Half as much Coulomb friction again would exceed a breakaway torque that stays.
TEST(TolerancedDrive, ABreakawayTorqueKeepsItsRatioToCoulombFriction) {
  TolerancedDrive drive{sound_drive(), {{"motor.coulomb", within_share(0.1, 0.5)}}};
  drive.nominal.motor.friction.coulomb = 0.1;
  drive.nominal.motor.friction.breakaway = 0.12;
  EXPECT_THAT(faults_of(drive), IsEmpty());
  EXPECT_NEAR(family_of(drive).drive_at(std::vector{0.15}).motor.friction.breakaway.value(), 0.18,
              1e-15);
  drive.varied.push_back({"motor.breakaway", within_share(0.12, 0.1)});
  EXPECT_EQ(family_of(drive).drive_at(std::vector{0.05, 0.12}).motor.friction.breakaway, 0.12);
  EXPECT_THAT(faults_of(drive), ElementsAre(HasSubstr("motor.breakaway")));
}

TEST(EdgeTolerancedDrive, OfOneNumberEveryFaultIsNamed) {
  EXPECT_THAT(
      faults_of(with("motor.resistance", Normal{282.0, 100.0})),
      ElementsAre("motor.resistance = normal with mean 282 and standard deviation 100: must "
                  "stay positive: give it a min"));
  EXPECT_THAT(faults_of(with("load.inertia", Normal{2e-5, 1e-5})),
              ElementsAre(HasSubstr("must stay positive: give it a min")));
  EXPECT_THAT(faults_of(with("load.inertia", Normal{2e-5, 1e-6})), IsEmpty());
  EXPECT_THAT(faults_of(with("motor.resistance", UniformBetween{0.0, 300.0})),
              ElementsAre("motor.resistance = uniform from 0 to 300: must stay positive"));
  EXPECT_THAT(faults_of(with("load.inertia", within_share(2e-5, 2.0))),
              ElementsAre("load.inertia = 2e-05 +- 4e-05: must not fall below zero"));
  EXPECT_THAT(
      faults_of(with("contact.restitution", UniformBetween{-0.1, 1.1})),
      ElementsAre("contact.restitution = uniform from -0.1 to 1.1: must stay within 0 to 1"));
  EXPECT_THAT(faults_of(with("contact.restitution", Normal{0.5, 0.1})),
              ElementsAre(HasSubstr("must stay within 0 to 1: give it a min and a max")));
  EXPECT_THAT(faults_of(with("contact.restitution", Normal{0.5, 0.1, 0.1, {}})),
              ElementsAre(HasSubstr("must stay within 0 to 1: give it a max")));
  EXPECT_THAT(faults_of(with("motor.torque_per_volt", ExactValue{1.0})),
              ElementsAre(AllOf(
                  HasSubstr("must be a number of this drive: motor.inertia, motor.friction, "
                            "motor.torque_constant, motor.back_emf_constant, "
                            "motor.resistance, "),
                  HasSubstr(", gearbox.backlash, "), HasSubstr(", controller.proportional"))));
  EXPECT_THAT(faults_of(normalised_with("load.inertia", ExactValue{1.0})),
              ElementsAre(HasSubstr("must be a number of this drive: servo.damping, ")));
}

TEST(EdgeTolerancedDrive, AllFaultsAreListedAtOnce) {
  TolerancedDrive drive = with("motor.resistance", UniformBetween{300.0, 200.0});
  drive.varied.push_back({"motor.resistance", ExactValue{-1.0}});
  drive.varied.push_back({"gearbox.backlash", Normal{0.1, 0.1}});
  drive.nominal.gearbox.ratio = 0.0;
  EXPECT_THAT(faults_of(drive), ElementsAre(HasSubstr("motor.resistance.max = 200"),
                                            "motor.resistance = -1: must be given once",
                                            "motor.resistance = -1: must stay positive",
                                            HasSubstr("gearbox.backlash = normal with"),
                                            HasSubstr("gearbox.ratio = 0")));
}

TEST(EdgeTolerancedDrive, ACornerThatIsNoDriveIsRefused) {
  EXPECT_THAT(
      faults_of(normalised_with("servo.inertia_ratio", UniformBetween{1e-16, 1.0})),
      ElementsAre(AllOf(HasSubstr("servo.inertia_ratio = "),
                        HasSubstr("; the tolerances permit it where servo.inertia_ratio = "))));
  EXPECT_THAT(faults_of(normalised_with("servo.inertia_ratio", UniformBetween{0.0, 1.0})),
              IsEmpty());  // a load without inertia
  EXPECT_THAT(faults_of(normalised_with("servo.damping", UniformBetween{1.0, 2000.0})),
              ElementsAre(HasSubstr("servo.damping = ")));
  EXPECT_THAT(faults_of(normalised_with("servo.backlash", UniformBetween{0.0, 1.0})), IsEmpty());
}

TEST(EdgeTolerancedDrive, NothingVariedIsTheNominalDrive) {
  const TolerancedDrive drive{sound_drive(), {}};
  EXPECT_THAT(faults_of(drive), IsEmpty());
  EXPECT_EQ(drive_with(drive, {}).servo, proportional_servo(sound_drive())->servo);
  EXPECT_EQ(place_of_backlash(drive), std::nullopt);
}

TEST(EdgeTolerancedDrive, WithoutAClosedFormItIsSearched) {
  TolerancedDrive drive = with("motor.resistance", within_share(282.0, 0.1));
  EXPECT_FALSE(is_searched(drive));
  drive.nominal.motor.friction.coulomb = 1e-4;
  EXPECT_TRUE(is_searched(drive));
  EXPECT_THAT(faults_of(drive), IsEmpty());
  EXPECT_TRUE(is_searched(with("motor.coulomb", UniformBetween{0.0, 1e-4})));
  EXPECT_THAT(faults_of(with("motor.coulomb", UniformBetween{0.0, 1e-4})), IsEmpty());
}

}  // namespace
}  // namespace gearlash::toleranced_drive_test
