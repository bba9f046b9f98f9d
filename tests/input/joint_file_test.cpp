// Files of robot joints: gains at the joint, currents, gravity, and a spring without a gap.
#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "gearlash/input.hpp"
#include "input/text_of_drive.hpp"
#include "model/reduced_drive.hpp"

namespace gearlash::joint_file_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr char joint[] = R"toml([motor]
kind = "torque-controlled"
inertia = "0.3 kg cm2"
friction = "0.05 mN m s/rad"
torque_constant = "30 mN m/A"
current_limit = "20 A"
[gearbox]
ratio = 50
backlash = "15 arcmin"
[load]
inertia = "0.4 kg m2"
friction = "0.1 N m s/rad"
gravity = "8 N m"
gravity_angle = "-30 deg"
[controller]
kind = "PD"
shaft = "load"
kp = "100 N m/rad"
kd = "2 N m s/rad"
)toml";

Drive read(const std::vector<Setting>& settings = {}) {
  return test::drive_of_text(joint, settings);
}

std::vector<std::string> refusals(const std::vector<Setting>& settings) {
  return test::refusals_of_text(joint, settings);
}

TEST(JointFile, IsReadAndReferredToTheLoad) {
  const drive::ReducedDrive reduced = reduce(read());
  EXPECT_EQ(reduced.controller.direct[0], 100.0);
  EXPECT_DOUBLE_EQ(reduced.torque_limit, 0.03 * 20.0 * 50.0);
  // 30° below the horizontal: −8 cos 30° N m, and it rights itself with 8 sin 30° N m/rad.
  EXPECT_NEAR(std::get<double>(reduced.load_torque), -6.92820323, 1e-8);
  EXPECT_NEAR(reduced.gravity.stiffness, 4.0, 1e-14);
}

TEST(JointFile, LimitIsGivenOnce) {
  EXPECT_THAT(
      refusals({{"motor.torque_limit", "1 N m"}}),
      ElementsAre(HasSubstr("motor.current_limit = 20 A: must not stand beside torque_limit")));
  EXPECT_THAT(
      refusals({{"motor.torque_constant", "none"}}),
      ElementsAre(HasSubstr("motor.current_limit = 20 A: must stand beside the torque_constant")));
  EXPECT_THAT(refusals({{"motor.current_limit", "0"}}),
              ElementsAre(HasSubstr("motor.current_limit = 0: must be positive and finite")));
  EXPECT_THAT(refusals({{"motor.current_limit", "none"}, {"motor.torque_limit", "1 N m"}}),
              IsEmpty());
}

TEST(JointFile, ShaftIsOneOfThree) {
  EXPECT_THAT(
      refusals({{"controller.shaft", "elbow"}}),
      ElementsAre(HasSubstr("controller.shaft = elbow: must be one of load, motor, mixed")));
}

TEST(JointFile, GravityIsLinearisedWhereTheReferenceEnds) {
  const Drive drive = read({{"reference.kind", "step"}, {"reference.after", "120 deg"}});
  const drive::ReducedDrive reduced = reduce(drive);
  EXPECT_EQ(std::get<double>(reduced.load_torque), 0.0);  // upright, within rounding of the angle
  EXPECT_DOUBLE_EQ(reduced.gravity.stiffness, -8.0);
  EXPECT_THAT(
      refusals({{"reference.kind", "ramp"}, {"reference.rate", "1 rad/s"}}),
      ElementsAre(HasSubstr("load.gravity = 8 N m: must be 0 with a reference that is a ramp")));
  EXPECT_THAT(refusals({{"load.gravity", "8 N"}}),
              ElementsAre(HasSubstr("load.gravity = 8 N: must be a torque, such as 2 N m")));
}

TEST(JointFile, GravityBesideAReferenceThatCannotBeReadIsNoFault) {
  EXPECT_THAT(refusals({{"reference.kind", "table"}, {"reference.file", "missing.csv"}}),
              ElementsAre(HasSubstr("reference.file = missing.csv")));
}

TEST(JointFile, GravityAddsToEveryLoadTorque) {
  const std::vector<Setting> horizontal = {{"load.gravity_angle", "0"}};
  const auto with = [&](std::vector<Setting> settings) {
    settings.insert(settings.end(), horizontal.begin(), horizontal.end());
    return reduce(read(settings)).load_torque;
  };
  EXPECT_EQ(with({}), Signal(-8.0));
  EXPECT_EQ(with({{"load_torque.kind", "step"}, {"load_torque.after", "3 N m"}}),
            Signal(StepSignal{-8.0, -5.0, 0.0}));
  EXPECT_EQ(with({{"load_torque.kind", "sine"},
                  {"load_torque.amplitude", "3 N m"},
                  {"load_torque.frequency", "1 rad/s"}}),
            Signal(SineSignal{-8.0, 3.0, 1.0, 0.0}));
}

TEST(JointFile, ASpringNeedsNoGap) {
  EXPECT_THAT(refusals({{"gearbox.backlash", "0"}}),
              ElementsAre(HasSubstr("gearbox.backlash = 0: must be positive and finite; without a "
                                    "gap the faces need a contact.stiffness")));
  const std::vector<Setting> spring = {{"gearbox.backlash", "0"},
                                       {"contact.stiffness", "3e4 N m/rad"}};
  EXPECT_THAT(refusals(spring), IsEmpty());
  EXPECT_TRUE(is_joined(reduce(read(spring))));
}

}  // namespace
}  // namespace gearlash::joint_file_test
