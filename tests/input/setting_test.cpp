// --set PATH=VALUE: any parameter of a file by its path.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "gearlash/input.hpp"
#include "gearlash/parameter.hpp"
#include "question/faults_of.hpp"

namespace gearlash::setting_test {
namespace {

using ::testing::HasSubstr;

constexpr const char* sheet = R"([motor]
kind = "armature-controlled"
inertia = "1e-5 kg m2"
friction = "1e-6 N m s/rad"
torque_constant = "0.2 N m/A"
back_emf_constant = "0.2 V s/rad"
resistance = "282 ohm"
[gearbox]
ratio = 20
backlash = "0.1 rad"
[load]
inertia = "0.01 kg m2"
friction = "0.001 N m s/rad"
[loop]
error_gain = "28 V/rad"
)";

Drive with(const std::vector<Setting>& settings) {
  return parse_drive(sheet, "servo.toml", {}, settings).drive;
}

std::string fault_of(const std::vector<Setting>& settings) {
  try {
    with(settings);
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "";
}

TEST(Settings, TakeThePlaceOfTheFile) {
  EXPECT_EQ(get(with({{"gearbox.ratio", "50"}}), "gearbox.ratio"), 50.0);
  EXPECT_EQ(get(with({{"gearbox.ratio", "43:1"}}), "gearbox.ratio"), 43.0);
  EXPECT_DOUBLE_EQ(get(with({{"load.inertia", "20 kg cm2"}}), "load.inertia"), 2e-3);
  EXPECT_EQ(get(with({{"motor.coulomb", "3 mN m"}}), "motor.breakaway"), 3e-3);
}

TEST(Settings, GiveWhatTheFileHasByAnotherName) {
  EXPECT_EQ(get(with({{"controller.proportional", "30 V/rad"}}), "loop.error_gain"), 30.0);
  EXPECT_EQ(get(with({{"controller.kp", "30 V/rad"}}), "loop.error_gain"), 30.0);
  const Drive drive = with({{"motor.speed_constant", "100 rpm/V"}});
  EXPECT_NEAR(get(drive, "motor.back_emf_constant"), 0.0954929658551372, 1e-15);
}

TEST(Settings, InverseFormsAreKeysToo) {
  EXPECT_NEAR(get(with({{"motor.back_emf_constant", "100 rpm/V"}}), "motor.back_emf_constant"),
              0.0954929658551372, 1e-15);
}

TEST(Settings, ChangeTheKindOfAPart) {
  const Drive drive = with({{"contact.kind", "compliant"}, {"contact.stiffness", "500 N m/rad"}});
  EXPECT_EQ(get(drive, "contact.stiffness"), 500.0);
  EXPECT_THAT(fault_of({{"contact.kind", "compliant"}}), HasSubstr("contact.stiffness"));
}

TEST(Settings, TakeKeysAndSectionsOut) {
  const std::string sampled =
      std::string(sheet) + "[sensor]\ncounts_per_turn = 1024\n[sampling]\nperiod = \"1 ms\"\n";
  const Drive drive = parse_drive(sampled, "servo.toml", {},
                                  {{"sensor.counts_per_turn", "none"}, {"sampling", "none"}})
                          .drive;
  EXPECT_FALSE(drive.sampling);
  EXPECT_FALSE(drive.sensor.encoder.counts_per_turn);
  EXPECT_EQ(read_setting("sampling=none").path, "sampling");
  EXPECT_THROW(read_setting("sampling=1 ms"), InvalidInput);
}

TEST(Settings, OfAKindLeaveTheKeysOfTheOtherKind) {
  const std::string field = "field-controlled";
  EXPECT_EQ(get(with({{"motor.kind", field}}), "motor.resistance"), 282.0);
  EXPECT_THROW(static_cast<void>(get(with({{"motor.kind", field}}), "motor.back_emf_constant")),
               InvalidInput);
}

TEST(Settings, AreLocatedWhereTheyWereGiven) {
  EXPECT_EQ(fault_of({{"gearbox.ratio", "-2"}}),
            "--set: gearbox.ratio = -2: must be positive and finite");
  EXPECT_THAT(fault_of({{"load.inertia", "20 apples"}}), HasSubstr("--set: load.inertia"));
}

TEST(Settings, OfNoParameterAreRefusedWithTheNearest) {
  EXPECT_THAT(test::faults_of([] { read_setting("motor.inertai=3 kg m2"); }),
              testing::ElementsAre(HasSubstr("did you mean motor.inertia?")));
  EXPECT_THROW(read_setting("motor.inertia"), InvalidInput);
}

TEST(Settings, AreUtf8AsTheTextOfAFileIs) {
  EXPECT_THAT(test::faults_of([] { read_setting("reference.kind=t\xE9"); }),
              testing::ElementsAre(HasSubstr("reference.kind=t\\xe9: must be UTF-8")));
  EXPECT_EQ(read_setting("reference.file=té.csv").text, "té.csv");
  // Names of files are bytes.
  EXPECT_EQ(read_setting("reference.file=t\xE9.csv").text, "t\xE9.csv");
  EXPECT_EQ(read_setting("load_torque.file=\xFF").text, "\xFF");
}

TEST(Settings, OfAProgramAreRefusedByTheirPath) {
  EXPECT_EQ(fault_of({{"gearbox.rtio", "50"}}),
            "gearbox.rtio = 50: must be a parameter of a drive (did you mean gearbox.ratio?)");
}

TEST(Settings, MayHaveATolerance) {
  for (const char* text : {"50 ± 2", "{ value = 50, tolerance = 2 }"}) {
    const WrittenDrive written = parse_drive(sheet, "servo.toml", {}, {{"gearbox.ratio", text}});
    EXPECT_EQ(written.drive.gearbox.ratio, 50.0);
    ASSERT_EQ(written.tolerances.size(), 1U);
    EXPECT_EQ(written.tolerances.front(),
              (ParameterTolerance{"gearbox.ratio", UniformAbout{50.0, 2.0}}));
  }
}

TEST(SetByText, TakesUnitsWordsAndLists) {
  Drive drive = with({});
  set(drive, "gearbox.backlash", "30 arcmin");
  EXPECT_NEAR(get(drive, "gearbox.backlash"), 0.5 * std::acos(-1.0) / 180.0, 1e-17);
  set(drive, "sampling.period", "1 kHz");
  EXPECT_DOUBLE_EQ(get(drive, "sampling.period"), 1e-3);
  set(drive, "motor.speed_constant", "100 rpm/V");
  EXPECT_NEAR(get(drive, "motor.back_emf_constant"), 0.0954929658551372, 1e-15);
  set(drive, "sensor.position", "both");
  EXPECT_EQ(drive.sensor.position, SensorPlace::both);
  set(drive, "controller.kind", "state-space");
  set(drive, "controller.A", "[[0, 1], [-2, -3]]");
  set(drive, "controller.C", "[1, 0.5]");
  set(drive, "controller.A[1][0]", "-4");
  EXPECT_EQ(get(drive, "controller.A[1][0]"), -4.0);
  EXPECT_EQ(get(drive, "controller.C[1]"), 0.5);
  for (const auto& [path, text] :
       {std::pair("sensor.position", "gear"), std::pair("load.inertia", "3"),
        std::pair("controller.C", "1"), std::pair("controller.A", "[1, 2]"),
        std::pair("controller.C[7]", "1"), std::pair("motor.colour", "red")}) {
    EXPECT_THROW(set(drive, path, text), InvalidInput) << path;
  }
}

}  // namespace
}  // namespace gearlash::setting_test
