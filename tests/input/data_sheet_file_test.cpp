// Data sheets and normalised servos from TOML: what is read, and every way it can be refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <numbers>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "closed_form/limit_cycle.hpp"
#include "gearlash/input.hpp"
#include "input/servo_of_file.hpp"
#include "input/text_of_drive.hpp"

namespace gearlash::data_sheet_file_test {
namespace {

using test::replaced;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr double epsilon = std::numeric_limits<double>::epsilon();
const std::filesystem::path source_directory = GEARLASH_SOURCE_DIRECTORY;

constexpr const char* sample = R"toml([motor]
kind = "armature-controlled"
inertia = "0.61 oz in2"
friction = "0.00064 ozf in/(rad/s)"
torque_constant = "28.2 ozf in/A"
back_emf_constant = "0.233 V/(rad/s)"
resistance = "282 ohm"
[gearbox]
ratio = 1
backlash = "0.1 rad"
[load]
inertia = "16.4e-6 slug ft2"
friction = "0.002 ozf in/(rad/s)"
[loop]
error_gain = "10 V/rad"
)toml";

constexpr const char* normalized = R"toml([servo]
damping = 0.19
inertia_ratio = 2
friction_ratio = 0.1
backlash = "0.3 rad"
)toml";

std::vector<std::string> refusals(std::string_view text) {
  return test::faults_of([&] { parse_servo(text, "s.toml"); });
}

std::vector<std::string> file_refusals(const std::filesystem::path& path) {
  return test::faults_of([&] { read_servo(path); });
}

std::string contents(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

TEST(ServoFile, ReadsTheSampleProblem) {
  const ServoOfFile file = parse_servo(sample, "s.toml");
  ASSERT_TRUE(file.drivetrain && file.natural_frequency);
  const Drive drive = parse_drive(sample, "s.toml", {}).drive;
  const auto& motor = std::get<ArmatureControl>(drive.motor.kind);
  const double ounce_force = 0.45359237 / 16 * 9.80665;
  EXPECT_NEAR(motor.torque_constant, 28.2 * ounce_force * 0.0254, 8 * epsilon);
  EXPECT_EQ(motor.back_emf_constant, 0.233);
  EXPECT_EQ(motor.resistance, 282.0);
  EXPECT_EQ(drive.sensor.position, SensorPlace::load);
  EXPECT_EQ(std::get<RigidContact>(drive.contact).restitution, 0.0);
  EXPECT_EQ(file.drivetrain, proportional_servo(drive).value().drivetrain);
  EXPECT_EQ(file.servo, normalize(*file.drivetrain));
  EXPECT_EQ(file.backlash_unit.name, "rad");
  // Appendix B rounds every step to two or three digits.
  EXPECT_NEAR(file.servo.damping, 0.19, 0.005);
  EXPECT_NEAR(file.servo.inertia_ratio, 2.0, 0.05);
  EXPECT_NEAR(file.servo.friction_ratio, 0.077, 0.0005);
  EXPECT_NEAR(*file.natural_frequency, 14.5, 0.05);
  EXPECT_NEAR(analyse_limit_cycles(file.servo).cycles.at(0).amplitude, 0.083, 0.002);  // of a chart
}

TEST(ServoFile, ReadsTheNormalisedServo) {
  const ServoOfFile file = parse_servo(normalized, "s.toml");
  EXPECT_EQ(file.servo,
            (NormalizedServo{
                .damping = 0.19, .inertia_ratio = 2.0, .friction_ratio = 0.1, .backlash = 0.3}));
  EXPECT_FALSE(file.drivetrain || file.natural_frequency);
}

TEST(ServoFile, ReadsFractionsInfinityAndContact) {
  const ServoOfFile file = parse_servo(R"toml(servo.damping = "1/5"
servo.inertia_ratio = inf
servo.friction_ratio = "1/4"
servo.backlash = "12 arcmin"
servo.natural_frequency = "2 Hz"
contact.restitution = 1
)toml",
                                       "s.toml");
  EXPECT_EQ(file.servo.damping, 0.2);
  EXPECT_EQ(file.servo.inertia_ratio, std::numeric_limits<double>::infinity());
  EXPECT_EQ(file.servo.restitution, 1.0);
  EXPECT_NEAR(*file.natural_frequency, 4 * std::numbers::pi, 16 * epsilon);
  EXPECT_EQ(file.backlash_unit.name, "arcmin");
  EXPECT_NEAR(file.backlash_unit.from_radians(file.servo.backlash), 12.0, 24 * epsilon);
}

TEST(ServoFile, ReadsTheOtherMotors) {
  const auto drive_of = [](const std::string& text) {
    return parse_drive(text, "s.toml", {}).drive;
  };
  const std::string rest = R"toml([gearbox]
ratio = "3/2"
backlash = "1 deg"
[load]
inertia = "1 kg m2"
friction = "1 N m s"
[loop]
error_gain = "1 V/rad"
sensor = "load"
)toml";
  const Drive field = drive_of(
      "[motor]\nkind = 'field-controlled'\ninertia = '1 kg m2'\nfriction = '2 N m s'\n"
      "torque_constant = '3 N m/A'\nresistance = '4 ohm'\n" +
      rest);
  EXPECT_EQ(field.motor, (Motor{FieldControl{3.0, 4.0}, 1.0, {.viscous = 2.0}}));
  EXPECT_EQ(field.gearbox.ratio, 1.5);
  const Drive two_phase = drive_of(
      "[motor]\nkind = 'two-phase'\ninertia = '1 kg m2'\nfriction = '2 N m s'\n"
      "torque_per_volt = '3 N m/V'\ntorque_per_speed = '4 N m s'\n" +
      rest);
  EXPECT_EQ(two_phase.motor, (Motor{TwoPhase{3.0, 4.0}, 1.0, {.viscous = 2.0}}));
}

TEST(ServoFile, ByteOrderMarkAndLineEndingsChangeNothing) {
  const ServoOfFile expected = parse_servo(sample, "s.toml");
  std::string crlf;
  for (const char c : std::string(sample))
    crlf += c == '\n' ? std::string("\r\n") : std::string(1, c);
  EXPECT_EQ(parse_servo(crlf, "s.toml"), expected);
  EXPECT_EQ(parse_servo("\xEF\xBB\xBF" + crlf, "s.toml"), expected);
  EXPECT_THAT(refusals("\xEF\xBB\xBF" + replaced(crlf, "\"282 ohm\"", "282")),
              ElementsAre("s.toml:7:14: motor.resistance = 282: must be an electrical resistance "
                          "with its unit as text: \"2.8 ohm\""));
}

TEST(ServoFile, TheExampleIsTheSampleProblem) {
  EXPECT_EQ(read_servo(source_directory / "examples/elinco-fd162.toml"),
            parse_servo(sample, "s.toml"));
}

/// A number of SI units in text that reads back exactly.
std::string written(double value, const char* unit) {
  std::ostringstream text;
  text.precision(17);
  text << '"' << value << ' ' << unit << '"';
  return text.str();
}

TEST(ServoFileProperty, TheServoDoesNotDependOnTheUnits) {
  std::mt19937_64 random(1960);
  std::uniform_real_distribution<double> decades(-0.5, 0.5);
  for (int i = 0; i < 200; ++i) {
    const auto any = [&] { return std::pow(10.0, decades(random)); };
    const double values[] = {any(), any(), any(), any(), any(), any(), any(), any(), any()};
    const auto sheet = [&](bool imperial) {
      // Every imperial number is the SI one over the unit's size, written out independently.
      const double inertia = imperial ? 0.45359237 * 0.0254 * 0.0254 : 1.0;
      const double torque = imperial ? 0.45359237 * 9.80665 * 0.0254 / 16 : 1.0;
      const double rpm = imperial ? std::numbers::pi / 30 : 1.0;
      const double degree = imperial ? std::numbers::pi / 180 : 1.0;
      const auto pick = [&](const char* si, const char* other) { return imperial ? other : si; };
      std::ostringstream text;
      text << "[motor]\nkind = 'armature-controlled'\ninertia = "
           << written(values[0] / inertia, pick("kg m2", "lb-in2"))
           << "\nfriction = " << written(values[1] / torque * rpm, pick("N m s", "ozf in/rpm"))
           << "\ntorque_constant = " << written(values[2] / torque, pick("N m/A", "ozf-in/A"))
           << "\nback_emf_constant = "
           << written(values[3] * 1000 * rpm / (imperial ? 1 : 1000), pick("V s/rad", "V/krpm"))
           << "\nresistance = " << written(values[4] * (imperial ? 1e-3 : 1), pick("ohm", "kohm"))
           << "\n[gearbox]\nratio = 5\nbacklash = "
           << written(values[5] / degree, pick("rad", "deg"))
           << "\n[load]\ninertia = " << written(values[6] / inertia, pick("kg m2", "lb-in2"))
           << "\nfriction = " << written(values[7] / torque * rpm, pick("N m s", "ozf in/rpm"))
           << "\n[loop]\nerror_gain = " << written(values[8] * degree, pick("V/rad", "V/deg"))
           << "\n";
      return parse_servo(text.str(), "s.toml").servo;
    };
    const NormalizedServo si = sheet(false);
    const NormalizedServo imperial = sheet(true);
    // Some thirty roundings of half an epsilon each on the way to a ratio.
    const double tolerance = 32 * epsilon;
    EXPECT_NEAR(imperial.damping, si.damping, tolerance * si.damping);
    EXPECT_NEAR(imperial.inertia_ratio, si.inertia_ratio, tolerance * si.inertia_ratio);
    EXPECT_NEAR(imperial.friction_ratio, si.friction_ratio, tolerance * si.friction_ratio);
    EXPECT_NEAR(imperial.backlash, si.backlash, tolerance * si.backlash);
  }
}

// --- refusals ---

TEST(ServoFileRefusal, ListsEveryFaultInTheOrderOfTheFile) {
  EXPECT_THAT(
      refusals(R"toml([moter]
[motor]
kind = "armature-controlled"
inertai = "3 kg m2"
inertia = "-0.61 oz in2"
friction = 3
torque_constant = "28.2 oz in/A"
resistance = "282 volts"
[gearbox]
ratio = nan
backlash = ["a", 1,
2]
[load]
inertia = "\u0007\n16.4e-6 slug ft2"
friction = "0.002"
[loop]
error_gain = "10 V"
sensor = "motor"
[contact]
restitution = 1.5
)toml"),
      ElementsAre(
          "s.toml:1:2: moter = [moter]: is not a section: must be one of servo, motor, gearbox, "
          "load, contact, sensor, controller, sampling, reference, load_torque, specification, "
          "loop, joint, actuator (did you mean motor?)",
          "s.toml:2:1: motor.back_emf_constant is missing: must be a voltage per angular speed, "
          "such as 3.67 mV/rpm; or give speed_constant instead",
          "s.toml:4:1: motor.inertai = 3 kg m2: is not a key of [motor]: must be one of kind, "
          "inertia, friction, torque_constant, back_emf_constant, speed_constant, resistance, "
          "inductance, coulomb, no_load_current, breakaway, stribeck_speed, voltage_limit, "
          "current_limit (did you "
          "mean inertia?)",
          "s.toml:5:11: motor.inertia = -0.61 oz in2: must be zero or positive, and finite",
          "s.toml:6:12: motor.friction = 3: must be a torque per angular speed with its unit as "
          "text: \"0.05 N m s/rad\"",
          "s.toml:7:19: motor.torque_constant = 28.2 oz in/A: must be a torque per current, such "
          "as 0.35 N m/A; oz, lb, g and kg are masses, the forces are ozf, lbf, gf and kgf",
          "s.toml:8:14: motor.resistance = 282 volts: must be an electrical resistance, such as "
          "2.8 ohm",
          "s.toml:10:9: gearbox.ratio = nan: must be positive and finite",
          "s.toml:11:12: gearbox.backlash = [\"a\", 1, …: must be an angle with its unit as text: "
          "\"12 arcmin\"",
          "s.toml:14:11: load.inertia = \\x07\\n16.4e-6 slug ft2: must be a moment of inertia with "
          "its unit, such as 0.3 kg cm2",
          "s.toml:15:12: load.friction = 0.002: must be a torque per angular speed with its unit, "
          "such as 0.05 N m s/rad",
          "s.toml:17:14: loop.error_gain = 10 V: must be a voltage per angle, such as 10 V/rad; "
          "the angle must be written",
          "s.toml:20:15: contact.restitution = 1.5: must be from 0 to 1"));
}

TEST(ServoFileRefusal, EachKeyOfADataSheetIsNeeded) {
  const std::vector<std::string> keys = {
      "kind",       "inertia", "friction", "torque_constant", "back_emf_constant",
      "resistance", "ratio",   "backlash", "error_gain"};
  for (const std::string& key : keys) {
    const std::string text = replaced(sample, "\n" + key + " = ", "\n# ");
    ASSERT_EQ(refusals(text).size(), 1U) << key;
    EXPECT_THAT(refusals(text)[0], HasSubstr("." + key + " is missing: must be ")) << key;
  }
  for (const std::string key : {"damping", "inertia_ratio", "friction_ratio", "backlash"}) {
    EXPECT_THAT(refusals(replaced(normalized, "\n" + key + " = ", "\n# ")),
                ElementsAre(StartsWith("s.toml:1:1: servo." + key + " is missing: must be ")));
  }
}

TEST(ServoFileRefusal, EachSectionOfADataSheetIsNeeded) {
  for (const std::string name : {"gearbox", "load", "loop"}) {
    const std::vector<std::string> lines =
        refusals(replaced(sample, "[" + name + "]", "[contact." + name + "]"));
    ASSERT_FALSE(lines.empty());
    const std::string section = name == "loop" ? "controller" : name;
    EXPECT_THAT(lines[0], StartsWith("s.toml:1:1: " + section + " is missing: must be a section [" +
                                     section + "] with "))
        << name;
  }
}

TEST(ServoFileRefusal, OneFormOfServo) {
  EXPECT_THAT(refusals(""),
              ElementsAre("s.toml:1:1: motor is missing: must be a section [motor] with [gearbox], "
                          "[load] and [loop] or [controller], or [servo] instead"));
  EXPECT_EQ(refusals("# nothing\n").size(), 1U);
  EXPECT_THAT(refusals(std::string(sample) + normalized),
              ElementsAre("s.toml:16:1: servo = [servo]: must not stand beside [motor]: a file "
                          "describes its drive once"));
  EXPECT_THAT(refusals(std::string(normalized) + "[loop]\nerror_gain = \"1 V/rad\"\n"),
              ElementsAre("s.toml:6:1: loop = [loop]: must not stand beside [servo], which is "
                          "normalised"));
}

TEST(ServoFileRefusal, KindOfMotor) {
  EXPECT_THAT(
      refusals(replaced(sample, "\"armature-controlled\"", "\"armature controlled\"")),
      ElementsAre(
          "s.toml:2:8: motor.kind = armature controlled: must be one of "
          "armature-controlled, field-controlled, two-phase, torque-controlled, brushed-dc (did "
          "you mean armature-controlled?)"));
  EXPECT_THAT(refusals(replaced(sample, "\"armature-controlled\"", "3")),
              ElementsAre(StartsWith("s.toml:2:8: motor.kind = 3: must be one of ")));
  EXPECT_THAT(
      refusals(replaced(sample, "armature-", "field-")),
      ElementsAre(StartsWith("s.toml:6:1: motor.back_emf_constant = 0.233 V/(rad/s): is not "
                             "a key of [motor] with kind = \"field-controlled\", but with "
                             "\"armature-controlled\"")));
}

TEST(ServoFileRefusal, OtherFaultsBesideAnUnknownKind) {
  const std::string unknown = replaced(sample, "\"armature-controlled\"", "\"armature\"");
  EXPECT_THAT(refusals(replaced(unknown, "\"282 ohm\"", "\"-282 ohm\"")),
              ElementsAre(StartsWith("s.toml:2:8: motor.kind = armature: must be one of "),
                          "s.toml:7:14: motor.resistance = -282 ohm: must be positive and finite"));
  EXPECT_THAT(refusals(replaced(unknown, "\"282 ohm\"", "\"282 V\"")),
              ElementsAre(StartsWith("s.toml:2:8: motor.kind = armature: must be one of "),
                          StartsWith("s.toml:7:14: motor.resistance = 282 V: must be ")));
  EXPECT_THAT(refusals(replaced(unknown, "resistance", "voltage_limit = \"24 V\"\nresistance")),
              ElementsAre(StartsWith("s.toml:2:8: motor.kind = armature: must be one of ")));
}

TEST(ServoFileRefusal, NumbersAtTheLoadSayWhatTheyAreMadeOf) {
  EXPECT_THAT(refusals(replaced(sample, "ratio = 1", "ratio = 1e200")),
              Contains("s.toml:1:1: motor_inertia = inf kg m2: must be zero or positive, and "
                       "finite; it is (motor.inertia + gearbox.inertia) * gearbox.ratio^2"));
}

/// The sample with another value in place of its resistance.
std::vector<ParameterTolerance> varied_by(const std::string& value) {
  return parse_drive(replaced(sample, "\"282 ohm\"", value), "s.toml", {}).tolerances;
}

TEST(ServoFileTolerances, AreReadInEveryForm) {
  const auto is = [](const std::string& value, const Distribution& distribution) {
    const std::vector<ParameterTolerance> varied = varied_by(value);
    ASSERT_EQ(varied.size(), 1U) << value;
    EXPECT_EQ(varied[0].path, "motor.resistance");
    EXPECT_TRUE(varied[0].distribution == distribution) << value;
  };
  EXPECT_TRUE(varied_by("\"282 ohm\"").empty());
  is("\"200 ohm ± 10 %\"", UniformAbout{200.0, 20.0});
  is("\"200 ohm +- 10%\"", UniformAbout{200.0, 20.0});
  is("\"200 ohm +/- 8 ohm\"", UniformAbout{200.0, 8.0});
  is("\"200 ± 8 ohm\"", UniformAbout{200.0, 8.0});
  is("{ value = \"200 ohm\", tolerance = \"8 ohm\" }", UniformAbout{200.0, 8.0});
  is("{ value = \"200 ohm\", normal = \"10 %\" }", Normal{200.0, 20.0, {}, {}});
  is("{ value = \"200 ohm\", normal = \"0.02 kohm\", min = \"150 ohm\" }",
     Normal{200.0, 20.0, 150.0, {}});
  is("{ min = \"200 ohm\", max = \"300 ohm\" }", UniformBetween{200.0, 300.0});
  is("{ lots = [\"200 ohm\", { value = \"300 ohm\", weight = 3 }] }",
     DiscreteLots{{{200.0, 1.0}, {300.0, 3.0}}});
}

TEST(ServoFileTolerances, LeaveTheNominalServo) {
  const auto nominal = [](const std::string& value) {
    return parse_servo(replaced(sample, "\"282 ohm\"", value), "s.toml").servo;
  };
  EXPECT_EQ(nominal("\"282 ohm ± 10 %\""), nominal("\"282 ohm\""));
  EXPECT_EQ(nominal("{ min = \"280 ohm\", max = \"284 ohm\" }"), nominal("\"282 ohm\""));
  EXPECT_EQ(nominal("{ lots = [\"200 ohm\", { value = \"282 ohm\", weight = 3 }] }"),
            nominal("\"282 ohm\""));
}

TEST(ServoFileRefusal, OfTolerancesThatAreNone) {
  const auto fault = [](const std::string& value) {
    const auto lines = refusals(replaced(sample, "\"282 ohm\"", value));
    return lines.size() == 1 ? lines.front() : std::to_string(lines.size()) + " lines";
  };
  const std::string start = "s.toml:7:14: motor.resistance = ";
  EXPECT_EQ(fault("\"282 ohm ± -5 %\""),
            start + "282 ohm ± -5 %: must not have a tolerance below zero");
  EXPECT_THAT(fault("\"282 ohm ± 5 V\""), HasSubstr("must be "));
  EXPECT_EQ(fault("\"282 ohm ± 100 %\""), start + "282 ohm ± 100 %: must stay positive");
  EXPECT_THAT(fault("{ value = \"282 ohm\", normal = \"40 %\" }"),
              HasSubstr("must stay positive: give it a min"));
  EXPECT_THAT(fault("{ value = \"282 ohm\" }"), HasSubstr("must be { value, tolerance }, "));
  EXPECT_THAT(fault("{ ohm = 1 }"), HasSubstr("must not have this key: must be one of value, "));
  EXPECT_THAT(fault("{ min = \"3 ohm\", max = \"2 ohm\" }"), HasSubstr("must be at least min"));
  EXPECT_THAT(fault("{ lots = [] }"), HasSubstr("must be { value, tolerance }, "));
  EXPECT_THAT(fault("{ lots = [{ value = \"3 ohm\", weight = -1 }] }"), HasSubstr("must be"));
}

TEST(ServoFileRefusal, OfAnotherType) {
  for (const char* value : {"true", "3.0", "1979-05-27", "[\"1 ohm\"]"}) {
    EXPECT_THAT(
        refusals(replaced(sample, "\"282 ohm\"", value)),
        ElementsAre("s.toml:7:14: motor.resistance = " + std::string(value) +
                    ": must be an electrical resistance with its unit as text: \"2.8 ohm\""));
  }
  for (const char* value : {"true", "[1]", "\"one\"", "\"1:1:1\""}) {
    EXPECT_THAT(refusals(replaced(sample, "ratio = 1", std::string("ratio = ") + value)),
                ElementsAre(HasSubstr("must be a number without unit, such as ")))
        << value;
  }
  EXPECT_THAT(
      refusals(replaced(normalized, "\"0.3 rad\"", "nan")),
      ElementsAre(StartsWith("s.toml:5:12: servo.backlash = nan: must be 0 or from 1e-15 to ")));
  EXPECT_THAT(refusals("motor = 3\n[gearbox]\nratio = 1\nbacklash = \"1 deg\"\n")[2],
              StartsWith("s.toml:1:9: motor = 3: must be a section [motor] "));
  EXPECT_THAT(refusals("[[servo]]\ndamping = 1\n"),
              ::testing::Contains(HasSubstr("servo = [[servo]]: must be a section [servo]")));
}

TEST(ServoFile, NormalizedAnglesMayBeBareRadians) {
  const ServoOfFile bare = parse_servo(replaced(normalized, "\"0.3 rad\"", "0.3"), "s.toml");
  EXPECT_EQ(bare.servo, parse_servo(normalized, "s.toml").servo);
  EXPECT_EQ(bare.backlash_unit.name, "rad");
}

TEST(ServoFileRefusal, NormalisedNumbersOutOfRange) {
  EXPECT_THAT(
      refusals(replaced(normalized, "0.19", "nan")),
      ElementsAre(StartsWith("s.toml:2:11: servo.damping = nan: must be 0 or from 1e-15 to ")));
  EXPECT_THAT(refusals(replaced(normalized, "inertia_ratio = 2", "inertia_ratio = -inf")),
              ElementsAre(StartsWith("s.toml:3:17: servo.inertia_ratio = -inf: must be ")));
  EXPECT_THAT(refusals(std::string(normalized) + "natural_frequency = \"-2 Hz\"\n"),
              ElementsAre("s.toml:6:21: servo.natural_frequency = -2 Hz: must be positive and "
                          "finite"));
}

TEST(ServoFileRefusal, WhatOnlyTheWholeSheetShows) {
  const std::string no_inertia =
      replaced(replaced(sample, "0.61 oz in2", "0 kg m2"), "16.4e-6 slug ft2", "0 kg m2");
  EXPECT_THAT(refusals(no_inertia),
              ElementsAre(StartsWith("s.toml:12:11: load.inertia = 0 kg m2: must be positive where "
                                     "motor and gearbox have no inertia")));
  EXPECT_THAT(refusals(replaced(sample, "10 V/rad", "1e-300 V/rad")),
              ElementsAre(StartsWith("s.toml:1:1: damping = ")));
  // Not told while a value is unknown that might have made it good.
  EXPECT_THAT(refusals(replaced(replaced(sample, "10 V/rad", "1e-300 V/rad"), "282 ohm", "ohm")),
              ElementsAre(StartsWith("s.toml:7:14: motor.resistance = ohm: ")));
}

TEST(ServoFileRefusal, NamesWithoutLikenessGetNoGuess) {
  EXPECT_THAT(refusals(std::string(normalized) + "zzzzzzzzzz = 1\n"),
              ElementsAre(EndsWith("friction_ratio, backlash, natural_frequency")));
  const std::vector<std::string> lines =
      refusals(std::string(normalized) + "\"" + std::string(5000, 'x') + "\\n\" = 1\n");
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_LT(lines[0].size(), 300U);
}

TEST(ServoFileRefusal, NotToml) {
  EXPECT_THAT(refusals("[servo]\ndamping = = 1\n"),
              ElementsAre(StartsWith("s.toml:2:11: line = damping = = 1: must be TOML: ")));
  EXPECT_THAT(refusals("[servo]\ndamping = 1\ndamping = 2\n"), ElementsAre(HasSubstr("redefine")));
  EXPECT_THAT(
      refusals("[servo]\ndamping = \xC2\xBD\n"),
      ElementsAre("s.toml:2:11: line = damping = ½: must be TOML: characters beyond ASCII must be "
                  "inside closed quotes"));
  for (const char* text : {"[!]", "[[[", "[", "a = [}]", "a = 0.1'\xC2\xB2'", "a = 1e999", "\"a"}) {
    EXPECT_EQ(refusals(text).size(), 1U) << text;
  }
}

TEST(ServoFileRefusal, TooDeep) {
  const auto repeated = [](const std::string& piece, int count) {
    std::string text;
    for (int i = 0; i < count; ++i) text += piece;
    return text;
  };
  EXPECT_THAT(refusals(repeated("a.", 400000) + "a = 1\n"),
              ElementsAre(HasSubstr("must not nest keys deeper than section.key")));
  EXPECT_THAT(refusals("[" + repeated("\"#\".", 100000) + "a]\n"),
              ElementsAre(HasSubstr("must not nest keys deeper than section.key")));
  EXPECT_THAT(refusals("a = " + repeated("[", 100000)), ElementsAre(HasSubstr("must be TOML: ")));
  EXPECT_THAT(refusals("a = " + repeated("{a.b.c = ", 100000)),
              ElementsAre(HasSubstr("must be TOML: ")));
  // Dots in comments and strings are no keys.
  EXPECT_TRUE(
      refusals(replaced(sample, "ratio = 1", "ratio = 1 # " + std::string(99, '.'))).empty());
  EXPECT_TRUE(refusals("# " + std::string(99, '.') + " Ω\n" + sample).empty());
}

TEST(ServoFileRefusal, BinaryAndHugeFilesAreNotParsed) {
  EXPECT_THAT(refusals(std::string("\x7F"
                                   "ELF\0\n",
                                   6)),
              ElementsAre("s.toml:1:5: file = binary data (\\x00): must be text in UTF-8"));
  EXPECT_THAT(refusals("# a\n#\xFF\n"),
              ElementsAre("s.toml:2:2: file = binary data (\\xff): must be text in UTF-8"));
  EXPECT_THAT(refusals(std::string(10'000'000, '\0')),
              ElementsAre("s.toml:1:1: file = over 1048576 bytes: must be a data sheet of at most "
                          "1048576 bytes"));
  const std::string full = std::string(sample) + "#";
  EXPECT_TRUE(refusals(full + std::string(largest_drive_file - full.size(), 'x')).empty());
  EXPECT_EQ(refusals(full + std::string(largest_drive_file - full.size() + 1, 'x')).size(), 1U);
}

TEST(ServoFileRefusal, FilesThatCannotBeRead) {
  EXPECT_THAT(file_refusals("no/such\nfile.toml"),
              ElementsAre("file = no/such\\nfile.toml: must be a readable file (No such file or "
                          "directory)"));
  EXPECT_THAT(file_refusals(source_directory / "examples"),
              ElementsAre(EndsWith("must be a readable file (it is a directory)")));
  if (std::filesystem::exists("/dev/zero")) {
    EXPECT_THAT(file_refusals("/dev/zero"),
                ElementsAre("file = /dev/zero: must be at most 1048576 bytes long"));
  }
}

TEST(ServoFileCorpus, EveryInputIsReadOrRefusedInWholeLines) {
  std::size_t read = 0;
  std::size_t refused = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator(source_directory / "tests/input/fuzz/corpus")) {
    try {
      const WrittenDrive written = parse_drive(contents(entry.path()), "s.toml", ".", {});
      EXPECT_TRUE(faults(written.drive).empty()) << entry.path();
      ++read;
    } catch (const InvalidInput& problem) {
      ASSERT_FALSE(problem.faults().empty()) << entry.path();
      for (const Fault& fault : problem.faults()) {
        EXPECT_THAT(to_string(fault), StartsWith("s.toml:")) << entry.path();
        EXPECT_EQ(to_string(fault).find('\n'), std::string::npos) << entry.path();
      }
      ++refused;
    }
  }
  EXPECT_GE(read, 5U);
  EXPECT_GE(refused, 8U);
}

}  // namespace
}  // namespace gearlash::data_sheet_file_test
