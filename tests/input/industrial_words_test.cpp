// The words of industrial drives: Kp, Tn, Kv, gains in currents, bits and lines, the stiffness of a
// gearbox; and what is suggested for words that no drive file has.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>
#include <string>
#include <vector>

#include "gearlash/input.hpp"
#include "gearlash/parameter.hpp"
#include "input/foreign_words.hpp"
#include "input/text_of_drive.hpp"
#include "model/parameters.hpp"

namespace gearlash::industrial_words_test {
namespace {

using test::drive_of_text;
using test::refusals_of_text;
using test::replaced;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr double rpm = 2.0 * std::numbers::pi / 60.0;            // rad/s
constexpr double arcminute = std::numbers::pi / (180.0 * 60.0);  // rad
constexpr double torque_constant = 0.35;                         // N m/A

const std::string plant = R"([motor]
kind = "torque-controlled"
inertia = "0.3 kg cm2"
friction = "0.01 mNm/rpm"
torque_constant = "0.35 Nm/A"
current_limit = "8 A"
[gearbox]
ratio = 10
backlash = "10 arcmin"
[load]
inertia = "50 kg cm2"
friction = 0
[sensor]
position = "motor"
[sampling]
period = "250 us"
[controller]
shaft = "motor"
)";

Drive with(const std::string& controller, const std::vector<Setting>& settings = {}) {
  return drive_of_text(plant + controller, settings);
}
CascadeController cascade_with(const std::string& keys, const std::vector<Setting>& settings = {}) {
  return std::get<CascadeController>(with("kind = \"cascade\"\n" + keys, settings).controller.law);
}
PID pid_with(const std::string& keys, const std::vector<Setting>& settings = {}) {
  return std::get<PID>(with(keys, settings).controller.law);
}
std::vector<std::string> refusals(const std::string& controller,
                                  const std::vector<Setting>& settings = {}) {
  return refusals_of_text(plant + controller, settings);
}

const std::string printed = "Kv = \"1.2 (m/min)/mm\"\nKp = \"0.05 Nm s/rad\"\nTn = \"10 ms\"\n";

TEST(IndustrialWords, OfACascadeAreItsGains) {
  const CascadeController cascade = cascade_with(printed);
  EXPECT_DOUBLE_EQ(cascade.position, 1.2 * 1000.0 / 60.0);
  EXPECT_DOUBLE_EQ(cascade.speed, 0.05);
  EXPECT_DOUBLE_EQ(cascade.speed_integral, 0.05 / 0.010);
  for (const std::string position : {"20 1/s", "20/s", "1200/min", "20 (rev/s)/rev"}) {
    EXPECT_DOUBLE_EQ(cascade_with(replaced(printed, "1.2 (m/min)/mm", position)).position, 20.0)
        << position;
  }
}

/// In whatever order they stand, and in either case of their letters.
TEST(IndustrialWords, AreReadInAnyOrderAndCase) {
  const CascadeController cascade = cascade_with(printed);
  EXPECT_EQ(cascade_with("Ti = \"10 ms\"\nkp = \"50 mNm s/rad\"\nkv = \"1.2 (m/min)/mm\"\n"),
            cascade);
  EXPECT_EQ(cascade_with("position = \"20 1/s\"\nspeed = \"0.05 Nm/(rad/s)\"\nki = \"5 Nm/rad\"\n"),
            cascade);
}

TEST(IndustrialWords, OfAPIDAreTimesOfItsGain) {
  const std::string keys =
      "kind = \"PID\"\nKp = \"2 Nm/rad\"\nTn = \"40 ms\"\nTv = \"5 ms\"\nfilter = \"1 ms\"\n";
  const PID pid = pid_with(keys);
  EXPECT_DOUBLE_EQ(pid.proportional, 2.0);
  EXPECT_DOUBLE_EQ(pid.integral, 2.0 / 0.040);
  EXPECT_DOUBLE_EQ(pid.derivative, 2.0 * 0.005);
  EXPECT_EQ(pid_with(replaced(replaced(keys, "Tn", "Ti"), "Tv", "Td")), pid);
}

TEST(IndustrialWords, AreParametersOfADrive) {
  Drive drive = with("kind = \"cascade\"\n" + printed);
  EXPECT_DOUBLE_EQ(get(drive, "controller.Tn"), 0.010);
  EXPECT_DOUBLE_EQ(get(drive, "controller.Kp"), 0.05);
  set(drive, "controller.Tn", "20 ms");
  EXPECT_DOUBLE_EQ(get(drive, "controller.speed_integral"), 0.05 / 0.020);
  set(drive, "controller.Kp", "0.2 A s/rad");
  EXPECT_DOUBLE_EQ(get(drive, "controller.speed"), 0.2 * torque_constant);
  set(drive, "sensor.bits", 17.0);
  EXPECT_EQ(get(drive, "sensor.counts_per_turn"), 131072.0);
  set(drive, "sensor.lines", "2500");
  EXPECT_EQ(get(drive, "sensor.counts_per_turn"), 10000.0);
  EXPECT_EQ(read_axis(split_axis("--x", "controller.Tn=5 ms,10 ms"), drive).values,
            (std::vector<double>{0.005, 0.010}));
}

/// Of a file with Tn the time is kept, of one with an integral gain the gain.
TEST(IndustrialWords, ASettingReplacesTheKeyOfAnyName) {
  EXPECT_DOUBLE_EQ(cascade_with(printed, {{"controller.speed", "0.1 N m s/rad"}}).speed_integral,
                   0.1 / 0.010);
  EXPECT_EQ(cascade_with(printed, {{"controller.Tn", "none"}}).speed_integral, 0.0);
  EXPECT_DOUBLE_EQ(
      cascade_with(printed, {{"controller.speed_integral", "3 N m/rad"}}).speed_integral, 3.0);
  const std::string own =
      "position = \"20 1/s\"\nspeed = \"0.05 Nm s/rad\"\nspeed_integral = \"5 Nm/rad\"\n";
  EXPECT_DOUBLE_EQ(cascade_with(own, {{"controller.Kp", "0.1 Nm s/rad"}}).speed, 0.1);
  EXPECT_DOUBLE_EQ(cascade_with(own, {{"controller.Tn", "20 ms"}}).speed_integral, 0.05 / 0.020);
}

TEST(IndustrialWords, ThatContradictEachOtherAreRefused) {
  EXPECT_THAT(refusals("kind = \"cascade\"\n" + printed + "kp = \"1 Nm s/rad\"\n"),
              ElementsAre(HasSubstr("controller.kp = 1 Nm s/rad: must not stand beside Kp")));
  EXPECT_THAT(
      refusals("kind = \"cascade\"\n" + printed + "speed_integral = \"1 Nm/rad\"\n"),
      ElementsAre(HasSubstr("controller.Tn = 10 ms: must not stand beside speed_integral")));
  EXPECT_THAT(refusals("kind = \"cascade\"\n" + replaced(printed, "10 ms", "0")),
              ElementsAre(HasSubstr("controller.Tn = 0: must not be 0: leave it out")));
  // The gain of the position is no gain of the speed.
  EXPECT_THAT(refusals("kind = \"cascade\"\n" + replaced(printed, "0.05 Nm s/rad", "30 1/s")),
              ElementsAre(HasSubstr("controller.Kp = 30 1/s: must be a torque per angular speed")));
  EXPECT_THAT(refusals("kind = \"cascade\"\n" + replaced(printed, "10 ms", "10 ms ± 10 %")),
              ElementsAre(HasSubstr("must have no tolerance in this form: give it as "
                                    "controller.speed_integral")));
}

TEST(Currents, AreTorquesByTheTorqueConstant) {
  const auto speed = [](const std::string& gain) {
    return cascade_with(replaced(printed, "0.05 Nm s/rad", gain)).speed;
  };
  EXPECT_DOUBLE_EQ(speed("0.2 A s/rad"), 0.2 * torque_constant);
  EXPECT_DOUBLE_EQ(speed("0.2 A/(rad/s)"), 0.2 * torque_constant);
  EXPECT_NEAR(speed("0.02 A/rpm"), 0.02 / rpm * torque_constant, 1e-15);
  EXPECT_NEAR(speed("20 mA/rpm"), 0.02 / rpm * torque_constant, 1e-15);
  const PID pid = pid_with("kind = \"PI\"\nKp = \"3 A/deg\"\nKi = \"4 A/(rad s)\"\n");
  EXPECT_NEAR(pid.proportional, 3.0 * 180.0 / std::numbers::pi * torque_constant, 1e-12);
  EXPECT_DOUBLE_EQ(pid.integral, 4.0 * torque_constant);
}

TEST(Currents, KeepTheirTolerance) {
  const auto written = parse_drive(
      plant + "kind = \"cascade\"\n" + replaced(printed, "0.05 Nm s/rad", "0.2 A s/rad ± 10 %"),
      "joint.toml", {}, {});
  ASSERT_EQ(written.tolerances.size(), 1U);
  EXPECT_EQ(written.tolerances[0].path, "controller.speed");
  const auto& about = std::get<UniformAbout>(written.tolerances[0].distribution);
  EXPECT_DOUBLE_EQ(about.nominal, 0.2 * torque_constant);
  EXPECT_DOUBLE_EQ(about.tolerance, 0.02 * torque_constant);
}

TEST(Currents, NeedATorqueConstantAndTheMotorsTorque) {
  const std::string keys = "kind = \"P\"\nKp = \"3 A/rad\"\n";
  EXPECT_THAT(refusals(keys, {{"motor.torque_constant", "none"}, {"motor.current_limit", "none"}}),
              ElementsAre(AllOf(HasSubstr("controller.Kp = 3 A/rad: must stand beside "
                                          "motor.torque_constant"),
                                EndsWith("or be a torque per angle, such as 20 N m/rad"))));
  EXPECT_THAT(refusals(keys, {{"controller.shaft", "load"}}),
              ElementsAre(HasSubstr("because a current is the motor's")));
  EXPECT_THAT(refusals("kind = \"P\"\nKp = \"3 A\"\n"),
              ElementsAre(HasSubstr("controller.Kp = 3 A: must be a torque per angle")));
}

TEST(Encoders, HaveBitsOrLinesOrCounts) {
  const auto counts = [](const std::string& key) {
    return drive_of_text(replaced(plant, "position = \"motor\"", key) +
                         "kind = \"P\"\nKp = \"1 Nm/rad\"\n")
        .sensor;
  };
  EXPECT_EQ(counts("bits = 20").encoder.counts_per_turn, 1048576.0);
  EXPECT_EQ(counts("lines = 2500").encoder.counts_per_turn, 10000.0);
  EXPECT_EQ(counts("speed_bits = 13").speed_encoder.counts_per_turn, 8192.0);
  EXPECT_EQ(counts("speed_lines = 1024").speed_encoder.counts_per_turn, 4096.0);
}

TEST(Encoders, HaveOneOfThem) {
  const auto refused = [](const std::string& keys) {
    return refusals_of_text(replaced(plant, "position = \"motor\"", keys) +
                            "kind = \"P\"\nKp = \"1 Nm/rad\"\n");
  };
  EXPECT_THAT(refused("bits = 20\nlines = 2500"),
              ElementsAre(HasSubstr("sensor.lines = 2500: must not stand beside bits")));
  EXPECT_THAT(refused("bits = 20\ncounts_per_turn = 4096"),
              ElementsAre(HasSubstr("sensor.bits = 20: must not stand beside counts_per_turn")));
  EXPECT_THAT(refused("resolution = \"1 arcmin\"\nlines = 20"),
              ElementsAre(HasSubstr("sensor.resolution = 1 arcmin: must not stand beside lines")));
  EXPECT_THAT(refused("speed_bits = 20\nspeed_resolution = \"1 arcmin\""),
              ElementsAre(HasSubstr("must not stand beside speed_bits")));
  for (const char* bits : {"20.5", "0", "65", "-3"}) {
    EXPECT_THAT(refused("bits = " + std::string(bits)),
                ElementsAre(HasSubstr("must be a whole number of bits, from 1 to 64")));
  }
}

TEST(TorsionalStiffness, OfTheGearboxIsThatOfTheFaces) {
  const std::string text = plant + "kind = \"P\"\nKp = \"1 Nm/rad\"\n";
  const std::string stiff =
      replaced(text, "ratio = 10", "ratio = 10\ntorsional_stiffness = \"1.5 N m/arcmin\"");
  const auto contact = [](const std::string& file, const std::vector<Setting>& settings) {
    return std::get<CompliantContact>(drive_of_text(file, settings).contact);
  };
  EXPECT_DOUBLE_EQ(contact(stiff, {}).stiffness, 1.5 / arcminute);
  EXPECT_DOUBLE_EQ(contact(text, {{"gearbox.torsional_stiffness", "1.5 N m/arcmin"}}).stiffness,
                   1.5 / arcminute);
  EXPECT_DOUBLE_EQ(contact(stiff, {{"contact.stiffness", "2 N m/rad"}}).stiffness, 2.0);
  const CompliantContact damped =
      contact(stiff + "[contact]\nkind = \"compliant\"\ndamping = \"3 N m s/rad\"\n", {});
  EXPECT_DOUBLE_EQ(damped.stiffness, 1.5 / arcminute);
  EXPECT_DOUBLE_EQ(damped.damping, 3.0);
  EXPECT_THAT(refusals_of_text(stiff + "[contact]\nstiffness = \"2 N m/rad\"\n"),
              ElementsAre(HasSubstr("contact.stiffness = 2 N m/rad: must not stand beside "
                                    "gearbox.torsional_stiffness")));
  EXPECT_THAT(refusals_of_text(stiff + "[contact]\nkind = \"rigid\"\n"),
              ElementsAre(HasSubstr("must not stand beside contact.kind = \"rigid\"")));
  EXPECT_THAT(refusals_of_text(stiff + "[contact]\nrestitution = 0.5\n"),
              ElementsAre(HasSubstr("contact.restitution = 0.5: must not stand beside stiffness")));
}

TEST(DataSheets, PrintLimitsThatAreNoValues) {
  const std::string text = plant + "kind = \"P\"\nKp = \"1 Nm/rad\"\n";
  for (const std::string limit : {"≤ 10 arcmin", "<10 arcmin", "<= 10 arcmin"}) {
    EXPECT_THAT(refusals_of_text(replaced(text, "10 arcmin", limit)),
                ElementsAre(EndsWith("a limit is a range, { min = \"…\", max = \"…\" }")))
        << limit;
  }
}

// ---- suggestions --------------------------------------------------------------------------------

TEST(ForeignWords, LeadToParametersAndAreNoneThemselves) {
  for (const ForeignWords& foreign : all_foreign_words()) {
    const Parameter* parameter = find_parameter(foreign.path);
    ASSERT_NE(parameter, nullptr) << foreign.path;
    const std::string section(foreign.path.substr(0, foreign.path.find('.')));
    for (const std::string_view word : split(foreign.words, " ")) {
      EXPECT_EQ(find_parameter(section + "." + std::string(word)), nullptr) << word;
      EXPECT_EQ(word.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_"), word.npos) << word;
    }
  }
}

TEST(ForeignWords, AreAnsweredInASection) {
  const auto answer = [](const std::string& section, const std::string& key) {
    const std::string header = "[" + section + "]\n";
    const std::vector<std::string> lines = refusals_of_text(
        replaced(plant + "kind = \"P\"\nKp = \"1 Nm/rad\"\n", header, header + key + " = \"3\"\n"));
    EXPECT_EQ(lines.size(), 1U) << key;
    return lines.empty() ? "" : lines.front().substr(lines.front().rfind("(did"));
  };
  EXPECT_EQ(answer("motor", "rotor_inertia"), "(did you mean inertia?)");
  EXPECT_EQ(answer("motor", "max_current"), "(did you mean current_limit?)");
  EXPECT_EQ(answer("motor", "stall_torque"), "(did you mean torque_limit?)");
  EXPECT_EQ(answer("motor", "Kt"), "(did you mean torque_constant?)");
  EXPECT_EQ(answer("motor", "gear_ratio"), "(did you mean gearbox.ratio?)");
  EXPECT_EQ(answer("motor", "backlash"), "(did you mean gearbox.backlash?)");
  EXPECT_EQ(answer("gearbox", "lost_motion"), "(did you mean backlash?)");
  EXPECT_EQ(answer("gearbox", "stiffness"), "(did you mean torsional_stiffness?)");
  EXPECT_EQ(answer("load", "damping"), "(did you mean friction?)");
  EXPECT_EQ(answer("sensor", "encoder_resolution"),
            "(did you mean counts_per_turn, lines or bits?)");
  EXPECT_EQ(answer("controller", "p1460"), "(did you mean speed?)");
  EXPECT_EQ(answer("sampling", "cycle_time"), "(did you mean period?)");
  EXPECT_EQ(answer("motor", "inertai"), "(did you mean inertia?)");
}

TEST(ForeignWords, AreAnsweredWithoutASection) {
  const auto of_setting = [](const std::string& text) {
    const auto lines = test::faults_of([&] { (void)read_setting(text); });
    return lines.empty() ? "" : lines.front();
  };
  EXPECT_THAT(of_setting("inertia=3"),
              EndsWith("(did you mean motor.inertia, gearbox.inertia or load.inertia?)"));
  EXPECT_THAT(of_setting("max_current=3 A"), EndsWith("(did you mean motor.current_limit?)"));
  EXPECT_THAT(of_setting("motor.rotor_inertia=3"), EndsWith("(did you mean motor.inertia?)"));
  EXPECT_THAT(of_setting("load.torque_constant=3"),
              EndsWith("(did you mean motor.torque_constant?)"));
  EXPECT_THAT(refusals_of_text("inertia = 3\n" + plant + "kind = \"P\"\nKp = \"1 Nm/rad\"\n"),
              ElementsAre(AllOf(HasSubstr("inertia = 3: must stand in a section"),
                                EndsWith("(did you mean motor.inertia, gearbox.inertia or "
                                         "load.inertia?)"))));
}

TEST(Kinds, WithoutAKeySayWhichHaveIt) {
  EXPECT_THAT(refusals("kind = \"P\"\nKp = \"1 Nm/rad\"\nkd = \"1 Nm s/rad\"\n"),
              ElementsAre(EndsWith("controller.kd = 1 Nm s/rad: is not a key of [controller] with "
                                   "kind = \"P\", but with \"PD\" or \"PID\"")));
  EXPECT_THAT(refusals("kind = \"P\"\nKp = \"1 Nm/rad\"\nvel_gain = 0.1\n"),
              ElementsAre(EndsWith("with kind = \"P\", but with \"odrive\"")));
}

// ---- all faults at once -------------------------------------------------------------------------

TEST(UnknownKind, HidesNoOtherFaultOfTheController) {
  const std::string keys =
      "position = \"30 rad\"\nspeed = \"0.05 N m s/rad\"\nlaw = 3\nnum = \"x\"\n"
      "tracking_time = \"-1 ms\"\nderivative_of = \"spede\"\nvel_gain = -2\n"
      "friction_compensation = 3\nnonsense = 1\n";
  const auto faults_beside = [&](const std::string& kind, const std::string& fault) {
    EXPECT_THAT(
        refusals(kind + keys),
        ::testing::UnorderedElementsAre(
            HasSubstr(fault), HasSubstr("controller.position = 30 rad: must be a rate"),
            HasSubstr("controller.law = 3: is not a key of any kind of [controller]"),
            HasSubstr("controller.num = x: must be a list"),
            HasSubstr("controller.tracking_time = -1 ms: must be zero or positive"),
            HasSubstr("controller.derivative_of = spede: must be one of error, speed"),
            HasSubstr("controller.vel_gain = -2: must be zero or positive"),
            HasSubstr("controller.friction_compensation = 3: must be a torque with its unit"),
            HasSubstr("controller.nonsense = 1: is not a key of any kind of [controller]")));
  };
  faults_beside("kind = \"cascad\"\n", "controller.kind = cascad: must be one of");
  faults_beside("", "controller.kind is missing");
}

TEST(UnknownKind, AddsNoFaultsToASoundSection) {
  for (const std::string& keys :
       {printed, std::string("A = [[-1]]\nB = [[0.1]]\nC = [1]\nD = [2]\ngain = \"3 N m/rad\"\n"),
        std::string("Kp = \"2 Nm/rad\"\nTn = \"40 ms\"\nTv = \"5 ms\"\n"),
        std::string("pid_position_kp = 4\nrotor_to_output_ratio = 0.1\n"),
        std::string("level = \"2 N m\"\nhysteresis = \"1 arcmin\"\n")}) {
    EXPECT_THAT(refusals("kind = \"nosuch\"\n" + keys),
                ElementsAre(HasSubstr("controller.kind = nosuch")))
        << keys;
  }
}

TEST(UnknownKind, OfTheMotorHidesNoFaultOfItsKeys) {
  const std::string motor =
      replaced(replaced(plant, "\"torque-controlled\"", "\"servo\""), "current_limit = \"8 A\"",
               "resistance = \"-2 ohm\"\nnone = 1");
  EXPECT_THAT(refusals_of_text(motor + "kind = \"P\"\nKp = \"1 Nm/rad\"\n"),
              ElementsAre(HasSubstr("motor.kind = servo"),
                          HasSubstr("motor.resistance = -2 ohm: must be positive"),
                          HasSubstr("motor.none = 1: is not a key of any kind of [motor]")));
  const auto of_gain = [&](const std::string& gain) {
    return refusals_of_text(replaced(plant, "\"torque-controlled\"", "\"servo\"") +
                            "kind = \"P\"\nKp = \"" + gain + "\"\n");
  };
  for (const char* gain : {"1 Nm/rad", "3 V/deg", "2 A/rad"}) {
    EXPECT_THAT(of_gain(gain), ElementsAre(HasSubstr("motor.kind = servo"))) << gain;
  }
  EXPECT_THAT(of_gain("2 kg"),
              ElementsAre(HasSubstr("motor.kind = servo"),
                          EndsWith("controller.Kp = 2 kg: must be a voltage per angle, such as "
                                   "10 V/rad, or a torque per angle, such as 20 N m/rad")));
}

}  // namespace
}  // namespace gearlash::industrial_words_test
