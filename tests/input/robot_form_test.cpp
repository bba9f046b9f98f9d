// Joints in the words of MuJoCo, and keys of dead bands, relays and compensations.
#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "gearlash/input.hpp"
#include "input/text_of_drive.hpp"
#include "model/reduced_drive.hpp"

namespace gearlash::robot_form_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr char joint[] = R"toml(# armature, damping, frictionloss, kp, kv, timestep
[joint]
armature = 0.0022
damping = 0.05
frictionloss = 0.1
backlash = "15 arcmin"
[actuator]
kp = 100
kv = 2
timestep = 0.001
)toml";

using test::drive_of_text;
using test::refusals_of_text;

TEST(RobotForm, LacksTheInertiaOfTheLoad) {
  EXPECT_THAT(refusals_of_text(joint),
              ElementsAre(HasSubstr("load.inertia is missing: must be the moment of inertia that "
                                    "the joint moves")));
}

/// All numbers are at the joint.
TEST(RobotForm, IsATorqueControlledJointWithItsGains) {
  const Drive by_option = drive_of_text(joint, {{"load.inertia", "0.4"}});
  const Drive by_section = drive_of_text(std::string(joint) + "[load]\ninertia = \"0.4 kg m2\"\n");
  EXPECT_EQ(by_option, by_section);
  const drive::ReducedDrive reduced = reduce(by_option);
  EXPECT_EQ(reduced.motor.inertia, 0.0022);
  EXPECT_EQ(reduced.motor.friction.viscous, 0.05);
  EXPECT_EQ(reduced.motor.friction.coulomb, 0.1);
  EXPECT_EQ(reduced.load.inertia, 0.4);
  EXPECT_EQ(reduced.load.friction.viscous, 0.0);
  EXPECT_DOUBLE_EQ(reduced.backlash, 0.0043633231299858239);
  EXPECT_THAT(reduced.controller.direct, testing::ElementsAre(100.0, -100.0, -2.0));
  EXPECT_EQ(reduced.sampling->period, 0.001);
  EXPECT_FALSE(reduced.sampling->speed_by_differences);  // MuJoCo's speeds are exact
}

TEST(RobotForm, OtherSectionsAddToIt) {
  const std::string more = std::string(joint) +
                           "[load]\ninertia = 0.4\ncoulomb = 0.2\n"
                           "[motor]\nbreakaway = 0.15\n"
                           "[sensor]\nposition = \"motor\"\n"
                           "[sampling]\ndelay = 0.002\n";
  const drive::ReducedDrive reduced = reduce(drive_of_text(more));
  EXPECT_EQ(reduced.load.friction.coulomb, 0.2);
  EXPECT_EQ(reduced.motor.friction.breakaway, 0.15);
  EXPECT_EQ(reduced.sensing.load_share_of_position, 0.0);
  EXPECT_EQ(reduced.sampling->delay, 0.002);
  const drive::ReducedDrive limited =
      reduce(drive_of_text(more, {{"actuator.forcerange", "40"}, {"joint.armature", "0.003"}}));
  EXPECT_EQ(limited.torque_limit, 40.0);
  EXPECT_EQ(limited.motor.inertia, 0.003);
  const drive::ReducedDrive set = reduce(drive_of_text(more, {{"motor.inertia", "30 kg cm2"},
                                                              {"controller.proportional", "50"},
                                                              {"sampling.period", "2 ms"}}));
  EXPECT_DOUBLE_EQ(set.motor.inertia, 0.003);
  EXPECT_EQ(set.controller.direct[0], 50.0);
  EXPECT_EQ(set.sampling->period, 0.002);
}

TEST(RobotForm, FaultsAreNamedAsItWasWritten) {
  const std::vector<Setting> inertia = {{"load.inertia", "0.4"}};
  const auto with = [&](const char* from, const char* to) {
    return refusals_of_text(test::replaced(joint, from, to), inertia);
  };
  EXPECT_THAT(with("armature = 0.0022\n", ""), ElementsAre(HasSubstr("joint.armature is missing")));
  EXPECT_THAT(with("kp = 100\n", ""), ElementsAre(HasSubstr("actuator.kp is missing")));
  EXPECT_THAT(with("damping = 0.05", "damping = -1"),
              ElementsAre(HasSubstr("joint.damping = -1: must be zero or positive")));
  EXPECT_THAT(with("damping = 0.05", "stiffness = 0.05"),
              ElementsAre(HasSubstr("joint.stiffness = 0.05: is not a key of [joint]")));
  EXPECT_THAT(with("[actuator]", "[motor]\ninertia = 1\n[actuator]"),
              ElementsAre(HasSubstr("motor.inertia = 1: must not stand beside joint.armature")));
  EXPECT_THAT(with("[actuator]", "[loop]\nerror_gain = 1\n[actuator]"),
              ElementsAre(HasSubstr("must not stand beside [joint] and [actuator]")));
  EXPECT_THAT(with("damping = 0.05\n", ""), IsEmpty());
  EXPECT_THAT(with("kv = 2\n", ""), IsEmpty());
  EXPECT_THAT(with("timestep = 0.001\n", ""), IsEmpty());
}

constexpr char geared[] = R"toml([motor]
kind = "torque-controlled"
inertia = "0.3 kg cm2"
friction = "0.05 mN m s/rad"
[gearbox]
ratio = 50
backlash = "15 arcmin"
[load]
inertia = "0.4 kg m2"
friction = "0.1 N m s/rad"
coulomb = "0.1 N m"
breakaway = "0.2 N m"
stribeck_speed = "2 rpm"
[controller]
)toml";

TEST(NonlinearControlFile, IsRead) {
  const Drive relay = drive_of_text(
      std::string(geared) + "kind = \"relay\"\nlevel = \"3 N m\"\nhysteresis = \"1 arcmin\"\n");
  EXPECT_EQ(std::get<RelayController>(relay.controller.law).level, 3.0);
  EXPECT_GT(relay.controller.dead_band.hysteresis, 0.0);
  EXPECT_NEAR(relay.load.friction.stribeck_speed, 0.20943951, 1e-8);
  const Drive band =
      drive_of_text(std::string(geared) +
                    "kind = \"P\"\nkp = \"9 N m/rad\"\ndead_band = \"3 arcmin\"\n"
                    "dead_band_form = \"whole\"\nhysteresis = \"1 arcmin\"\n"
                    "friction_compensation = \"0.1 N m\"\nfriction_speed = \"1 rpm\"\n"
                    "backlash_compensation = \"14 arcmin\"\ntake_up_time = \"20 ms\"\n");
  EXPECT_EQ(band.controller.dead_band.form, DeadBandForm::whole);
  EXPECT_EQ(band.controller.compensation.friction, 0.1);
  EXPECT_EQ(band.controller.compensation.take_up_time, 0.02);
  const Drive of_speed = drive_of_text(std::string(geared) +
                                       "kind = \"relay\"\nlevel = \"3 N m\"\ninput = \"speed\"\n"
                                       "hysteresis = \"1 rad/s\"\n");
  EXPECT_TRUE(reduce(of_speed).error_shape.is_of_speed);
}

TEST(NonlinearControlFile, FaultsHaveTheirPlaces) {
  EXPECT_THAT(refusals_of_text(std::string(geared) + "kind = \"relay\"\nlevel = \"3 N m\"\n"),
              ElementsAre(HasSubstr("controller.hysteresis = 0: must be positive, or the "
                                    "controller sampled")));
  EXPECT_THAT(refusals_of_text(std::string(geared) + "kind = \"P\"\nkp = \"9 N m/rad\"\n"
                                                     "dead_band = \"-1 deg\"\n"),
              ElementsAre(HasSubstr("controller.dead_band = -1 deg: must be zero or positive")));
}

/// On the edge of a count the torque of a step turns the shaft back, from either side.
TEST(NonlinearControlFile, AContinuousControllerBehindACoarseEncoderIsRefused) {
  const auto text = [](const char* dry) {
    return std::string(geared) + "kind = \"P\"\nshaft = \"load\"\nkp = \"90 N m/rad\"\n" +
           "[sensor]\nposition = \"motor\"\ncounts_per_turn = 12\n" + dry;
  };
  // 90 N m/rad · 2π/12/50 = 0.942 N m at the load.
  EXPECT_THAT(refusals_of_text(text("")),
              ElementsAre(HasSubstr("sensor.counts_per_turn = 12: must stand beside [sampling]")));
  EXPECT_THAT(refusals_of_text(text("[sampling]\nperiod = \"1 ms\"\n")), IsEmpty());
  EXPECT_THAT(refusals_of_text(text(""), {{"motor.coulomb", "9 mN m"}}),
              ElementsAre(HasSubstr("0.45")));
  EXPECT_THAT(refusals_of_text(text(""), {{"motor.coulomb", "9.5 mN m"}}),
              IsEmpty());  // 0.475 N m hold
}

}  // namespace
}  // namespace gearlash::robot_form_test
