// Data sheets of motors and gearboxes as their makers print them.
#include <gmock/gmock.h>

#include <numbers>
#include <string>
#include <vector>

#include "gearlash/input.hpp"
#include "gearlash/parameter.hpp"
#include "input/text_of_drive.hpp"
#include "model/reduced_drive.hpp"

namespace gearlash::printed_sheet_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// maxon RE 40 148867 with GP 42 C 43:1.
constexpr char re_40[] = R"toml([motor]
kind = "brushed-dc"
inertia = "142 g cm²"
torque_constant = "30.2 mNm/A"
speed_constant = "317 rpm/V"
resistance = "0.299 Ω"
inductance = "0.082 mH"
no_load_current = "137 mA"
friction = "0"
[gearbox]
ratio = "43:1"
backlash = "0.8°"
efficiency = "72 %"
inertia = "15 gcm²"
[load]
inertia = "0.05 kgm²"
friction = "0.01 Nms/rad"
[loop]
error_gain = "20 V/deg"
)toml";

Drive read(const std::vector<Setting>& settings = {}) {
  return test::drive_of_text(re_40, settings, "re40.toml");
}

std::vector<std::string> refusals(const std::vector<Setting>& settings) {
  return test::refusals_of_text(re_40, settings, "re40.toml");
}

TEST(PrintedSheet, IsReadAsItStands) {
  const Drive drive = read();
  const auto& motor = std::get<ArmatureControl>(drive.motor.kind);
  EXPECT_DOUBLE_EQ(motor.torque_constant, 0.0302);
  // 317 rpm/V: 60/(2π 317) V s/rad
  EXPECT_DOUBLE_EQ(motor.back_emf_constant, 60.0 / (2.0 * std::numbers::pi * 317.0));
  EXPECT_NEAR(motor.back_emf_constant, 0.0301240, 1e-7);
  EXPECT_DOUBLE_EQ(motor.inductance, 8.2e-5);
  EXPECT_EQ(drive.motor.friction.viscous, 0.0);
  EXPECT_EQ(drive.gearbox.ratio, 43.0);
  EXPECT_EQ(drive.gearbox.efficiency, 0.72);
}

TEST(PrintedSheet, NumbersAtTheLoadAreThoseByHand) {
  const drive::ReducedDrive reduced = reduce(read());
  // 30.2 mN m/A · 137 mA = 4.1374 mN m
  EXPECT_DOUBLE_EQ(reduced.motor.friction.coulomb, 4.1374e-3 * 43.0);
  EXPECT_DOUBLE_EQ(reduced.motor.friction.breakaway, 4.1374e-3 * 43.0);
  EXPECT_DOUBLE_EQ(reduced.motor.inertia, 157e-7 * 43.0 * 43.0);
  EXPECT_DOUBLE_EQ(reduced.winding.time_constant, 8.2e-5 / 0.299);
  EXPECT_NEAR(reduced.winding.back_emf, 0.0302 * 0.030124 / 0.299 * 43.0 * 43.0, 1e-4);
  EXPECT_EQ(reduced.motor.friction.viscous, 0.0);
  // Without inductance the back-EMF is friction.
  const drive::ReducedDrive at_once = reduce(read({{"motor.inductance", "none"}}));
  EXPECT_EQ(at_once.winding.time_constant, 0.0);
  EXPECT_EQ(at_once.motor.friction.viscous, reduced.winding.back_emf);
}

TEST(PrintedSheet, EveryQuantityMayBeAPlainZero) {
  for (const char* zero : {"0", "0.0", " 0 ", "0 Nm/krpm", "-0"}) {
    EXPECT_EQ(read({{"motor.friction", zero}}).motor.friction.viscous, 0.0) << zero;
  }
  EXPECT_EQ(parse_drive("[servo]\ndamping = 0.2\ninertia_ratio = 1\nfriction_ratio = 0.2\n"
                        "backlash = 0.3\n[reference]\nkind = \"step\"\nafter = 0\n",
                        "s.toml", {}, {})
                .drive.reference,
            Signal(StepSignal{}));
  Drive drive = read();
  set(drive, "gearbox.inertia", "0");
  EXPECT_EQ(drive.gearbox.inertia, 0.0);
  EXPECT_THAT(refusals({{"motor.resistance", "0"}}),
              ElementsAre(HasSubstr("motor.resistance = 0: must be positive and finite")));
  EXPECT_THAT(refusals({{"motor.friction", "1"}}),
              ElementsAre(HasSubstr(
                  "motor.friction = 1: must be a torque per angular speed with its unit")));
  EXPECT_THAT(refusals({{"motor.speed_constant", "0"}}),
              ElementsAre(HasSubstr("motor.speed_constant = 0: must not be 0")));
}

TEST(PrintedSheet, SamplingMayBeARate) {
  for (const char* key : {"sampling.rate", "sampling.frequency", "sampling.period"}) {
    EXPECT_DOUBLE_EQ(read({{key, "4 kHz"}}).sampling->period, 2.5e-4) << key;
  }
  EXPECT_DOUBLE_EQ(read({{"sampling.period", "0.25 ms"}}).sampling->period, 2.5e-4);
  EXPECT_THAT(refusals({{"sampling.period", "0"}}),
              ElementsAre(HasSubstr("sampling.period = 0: must be positive and finite")));
}

TEST(PrintedSheet, SharesMayBeInPercent) {
  for (const char* text : {"72 %", "72%", "0.72", "18/25"}) {
    EXPECT_EQ(read({{"gearbox.efficiency", text}}).gearbox.efficiency, 0.72) << text;
  }
  EXPECT_EQ(std::get<RigidContact>(read({{"contact.restitution", "30 %"}}).contact).restitution,
            0.3);
  EXPECT_THAT(refusals({{"gearbox.efficiency", "120 %"}}),
              ElementsAre(HasSubstr("gearbox.efficiency = 120 %: must be from 0 to 1")));
  EXPECT_THAT(refusals({{"gearbox.ratio", "43 %"}}),
              ElementsAre(HasSubstr("gearbox.ratio = 43 %: must be a number without unit")));
  Drive drive = read();
  set(drive, "gearbox.efficiency", "65 %");
  EXPECT_EQ(drive.gearbox.efficiency, 0.65);
}

TEST(PrintedSheet, DryFrictionIsGivenOnce) {
  EXPECT_THAT(
      refusals({{"motor.coulomb", "3 mNm"}}),
      ElementsAre(HasSubstr("motor.no_load_current = 137 mA: must not stand beside coulomb")));
  EXPECT_EQ(
      read({{"motor.coulomb", "3 mNm"}, {"motor.no_load_current", "none"}}).motor.friction.coulomb,
      3e-3);
  EXPECT_THAT(
      refusals({{"motor.breakaway", "4 mNm"}}),
      ElementsAre(HasSubstr("motor.breakaway = 4 mNm: must be at least "
                            "motor.torque_constant * motor.no_load_current, 0.0041374 N m")));
  EXPECT_THAT(refusals({{"motor.no_load_current", "-1 A"}}),
              ElementsAre(HasSubstr("motor.no_load_current = -1 A: must be zero or positive")));
}

TEST(PrintedSheet, NoLoadCurrentNeedsAnArmature) {
  const std::string field_controlled =
      "[motor]\nkind = \"field-controlled\"\ninertia = \"1e-5 kg m2\"\nfriction = \"0\"\n"
      "torque_constant = \"1 N m/A\"\nresistance = \"1 ohm\"\nno_load_current = \"1 A\"\n"
      "[gearbox]\nratio = 1\nbacklash = \"1 deg\"\n[load]\ninertia = \"1e-5 kg m2\"\n"
      "friction = \"1e-5 N m s\"\n[loop]\nerror_gain = \"1 V/rad\"\n";
  EXPECT_THAT(test::refusals_of_text(field_controlled),
              ElementsAre(testing::AllOf(HasSubstr("motor.no_load_current = "),
                                         HasSubstr("must stand beside the torque_constant"))));
}

TEST(PrintedSheet, OtherWordsNameTheSameKind) {
  EXPECT_EQ(read(), read({{"motor.kind", "armature-controlled"}}));
  Drive drive = read();
  set(drive, "motor.kind", "two-phase");
  set(drive, "motor.kind", "brushed-dc");
  EXPECT_TRUE(std::holds_alternative<ArmatureControl>(drive.motor.kind));
  EXPECT_THAT(refusals({{"motor.kind", "brushed-d"}}),
              ElementsAre(HasSubstr("brushed-dc (did you mean brushed-dc?)")));
}

TEST(PrintedSheet, AnInductanceBelowZeroIsRefused) {
  EXPECT_THAT(refusals({{"motor.inductance", "-1 mH"}}),
              ElementsAre(HasSubstr("motor.inductance = -1 mH: must be zero or positive")));
  EXPECT_THAT(
      refusals({{"motor.inductance", "1 ohm"}}),
      ElementsAre(HasSubstr("motor.inductance = 1 ohm: must be an inductance, such as 1.2 mH")));
}

}  // namespace
}  // namespace gearlash::printed_sheet_test
