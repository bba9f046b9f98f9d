// Drives from TOML: what is read, and every way it can be refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>
#include <tuple>

#include "gearlash/input.hpp"
#include "input/servo_of_file.hpp"
#include "input/text_of_drive.hpp"
#include "model/proportional_servo.hpp"
#include "model/reduced_drive.hpp"

namespace gearlash::drive_file_test {
namespace {

using test::replaced;
using ::testing::Contains;
using ::testing::DoubleEq;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr double pi = std::numbers::pi;

constexpr const char* joint = R"toml([motor]
kind = "torque-controlled"
inertia = "2 kg cm2"
friction = "0.1 mN m s/rad"
coulomb = "3 mN m"
breakaway = "5 mN m"
torque_limit = "0.2 N m"
[gearbox]
ratio = 50
backlash = "12 arcmin"
[load]
inertia = "0.02 kg m2"
friction = "0.01 N m s/rad"
[contact]
stiffness = "500 N m/rad"
damping = "1 N m s/rad"
law = "ElastoBacklash2"
[sensor]
position = "both"
counts_per_turn = 4096
speed_counts_per_turn = 100
[controller]
kind = "PID"
shaft = "load"
proportional = "25 N m/rad"
integral = "50 N m/(rad s)"
derivative = "1 N m s/rad"
filter = "5 ms"
tracking_time = "0.1 s"
[sampling]
period = "1 ms"
delay = "0.5 ms"
method = "backward"
[reference]
kind = "trapezoid"
to = "90 deg"
speed = "1 rad/s"
acceleration = "2 rad/s2"
[load_torque]
kind = "step"
after = "0.1 N m"
time = "2 s"
)toml";

constexpr const char* plain = R"toml([motor]
kind = "armature-controlled"
inertia = "1e-5 kg m2"
friction = "1e-5 N m s/rad"
torque_constant = "0.02 N m/A"
back_emf_constant = "0.02 V s/rad"
resistance = "2 ohm"
[gearbox]
ratio = 10
backlash = "1 deg"
[load]
inertia = "1e-3 kg m2"
friction = "1e-3 N m s/rad"
)toml";

/// A drive at the load's shaft.
struct ReadDrive {
  drive::ReducedDrive drive;
  double gear_ratio;
  AngleUnit backlash_unit;
};

ReadDrive drive_of(const std::string& text, const std::filesystem::path& folder = ".") {
  const WrittenDrive written = parse_drive(text, "drive.toml", folder, {});
  return {reduce(written.drive), written.drive.gearbox.ratio, written.drive.angle_unit};
}

/// "place: field = value: permitted" of every fault.
std::vector<std::string> refusals(const std::string& text,
                                  const std::filesystem::path& folder = ".") {
  return test::faults_of([&] { parse_drive(text, "drive.toml", folder, {}); });
}

TEST(DriveFile, EveryBlockIsReadAndReferredToTheLoad) {
  const ReadDrive file = drive_of(joint);
  const drive::ReducedDrive& drive = file.drive;
  EXPECT_DOUBLE_EQ(drive.motor.inertia, 2e-4 * 2500.0);
  EXPECT_DOUBLE_EQ(drive.motor.friction.viscous, 1e-4 * 2500.0);
  EXPECT_DOUBLE_EQ(drive.motor.friction.coulomb, 0.15);
  EXPECT_DOUBLE_EQ(drive.motor.friction.breakaway, 0.25);
  EXPECT_DOUBLE_EQ(drive.torque_limit, 10.0);
  EXPECT_DOUBLE_EQ(drive.load.inertia, 0.02);
  EXPECT_EQ(drive.load.friction.breakaway, 0.0);
  EXPECT_DOUBLE_EQ(drive.backlash, 0.2 * pi / 180.0);
  const auto contact = std::get<drive::CompliantContact>(drive.contact);
  EXPECT_EQ(contact.stiffness, 500.0);
  EXPECT_EQ(contact.law, ContactDamping::full);
  EXPECT_EQ(drive.sensing.load_share_of_position, 1.0);
  EXPECT_EQ(drive.sensing.load_share_of_speed, 0.0);
  EXPECT_DOUBLE_EQ(drive.sensing.resolution, 2.0 * pi / 4096.0);
  EXPECT_DOUBLE_EQ(drive.sensing.resolution_of_speed, 2.0 * pi / 5000.0);
  // 25 + 50/s + s/(0.005 s + 1), of the error
  EXPECT_THAT(drive.controller.direct, ElementsAre(DoubleEq(225.0), DoubleEq(-225.0), 0.0));
  EXPECT_DOUBLE_EQ(drive.controller.input_matrix[0][0], 50.0);
  EXPECT_DOUBLE_EQ(drive.controller.state_matrix[1][1], -200.0);
  EXPECT_EQ(drive.sampling->method, Discretization::backward);
  EXPECT_DOUBLE_EQ(drive.sampling->delay, 5e-4);
  EXPECT_DOUBLE_EQ(std::get<drive::Trapezoid>(drive.reference).to, 0.5 * pi);
  EXPECT_DOUBLE_EQ(std::get<drive::StepSignal>(drive.load_torque).after, 0.1);
  EXPECT_EQ(file.gear_ratio, 50.0);
  EXPECT_EQ(file.backlash_unit.name, "arcmin");
}

/// A torque of the motor is a ratio of times as much at the load, an angle as many times less.
TEST(DriveFile, GainsMayBeThoseOfTheMotorOrMixed) {
  const auto proportional = [](const std::string& shaft) {
    const ReadDrive file =
        drive_of(replaced(joint, "shaft = \"load\"", "shaft = \"" + shaft + "\""));
    return file.drive.controller.direct[0] / 9.0;  // with derivative/filter
  };
  EXPECT_DOUBLE_EQ(proportional("load"), 25.0);
  EXPECT_DOUBLE_EQ(proportional("motor"), 25.0 * 2500.0);
  EXPECT_DOUBLE_EQ(proportional("mixed"), 25.0 * 50.0);
}

TEST(DriveFile, VoltsComeThroughTheArmature) {
  const ReadDrive file =
      drive_of(replaced(plain, "resistance", "voltage_limit = \"12 V\"\nresistance") +
               "[controller]\nkind = \"P\"\nproportional = \"3 V/rad\"\n");
  // K₁ n / R = 0.1 N m at the load per volt.
  EXPECT_DOUBLE_EQ(file.drive.torque_limit, 1.2);
  EXPECT_DOUBLE_EQ(file.drive.controller.direct[0], 0.3);
  EXPECT_DOUBLE_EQ(file.drive.motor.friction.viscous, 1e-3 + 0.02 * 0.02 / 2.0 * 100.0);
}

TEST(OracleDriveFile, AProportionalControllerIsTheServoOfALoop) {
  const auto file = parse_servo(plain + std::string("[controller]\nkind = \"P\"\n"
                                                    "proportional = \"3 V/rad\"\n"));
  const auto servo = parse_servo(plain + std::string("[loop]\nerror_gain = \"3 V/rad\"\n"));
  EXPECT_EQ(file, servo);
  EXPECT_EQ(drive::proportional_drivetrain(drive::drive_of(servo.drivetrain.value())),
            servo.drivetrain);
  // Whatever it has besides has no closed form.
  const auto with = [&](const std::string& more) {
    return proportional_servo(
        parse_drive(plain + std::string("[loop]\nerror_gain = \"3 V/rad\"\n") + more, "drive.toml",
                    ".")
            .drive);
  };
  EXPECT_FALSE(with("[sensor]\nposition = \"motor\"\n"));
  EXPECT_FALSE(with("[sampling]\nperiod = \"1 ms\"\n"));
  EXPECT_FALSE(with("[contact]\nstiffness = \"1 N m/rad\"\n"));
  EXPECT_FALSE(with("[load_torque]\nkind = \"constant\"\nvalue = \"1 N m\"\n"));
  EXPECT_TRUE(with("[reference]\nkind = \"constant\"\nvalue = \"1 rad\"\n"));
  // Speed fed back from the motor is friction on it; from the load it is not.
  const auto with_speed = [&](const std::string& shaft) {
    return proportional_servo(
        parse_drive(plain + ("[controller]\nkind = \"PD\"\nproportional = \"3 V/rad\"\n"
                             "derivative = \"0.5 V s/rad\"\n[sensor]\nspeed = \"" +
                             shaft + "\"\n"),
                    "drive.toml", ".")
            .drive);
  };
  ASSERT_TRUE(with_speed("motor"));
  EXPECT_DOUBLE_EQ(with_speed("motor")->drivetrain.motor_friction,
                   servo.drivetrain->motor_friction + 0.05);
  EXPECT_FALSE(with_speed("load"));
}

TEST(DriveFile, ControllersOfEveryKind) {
  const auto controller = [](const std::string& text) {
    return drive_of(plain + std::string("[controller]\n") + text).drive.controller;
  };
  const auto lead =
      controller("kind = \"lead-lag\"\ngain = \"1 V/rad\"\nzero = \"1 Hz\"\npole = \"9 rad/s\"\n");
  EXPECT_DOUBLE_EQ(lead.direct[0], 0.1 * 9.0 / (2.0 * pi));
  const auto cascade = controller(
      "kind = \"cascade\"\nposition = \"20 1/s\"\nspeed = \"0.5 V s/rad\"\n"
      "speed_integral = \"2 V/rad\"\n");
  EXPECT_THAT(cascade.direct, ElementsAre(DoubleEq(1.0), DoubleEq(-1.0), DoubleEq(-0.05)));
  EXPECT_DOUBLE_EQ(cascade.input_matrix[0][2], -0.2);
  const auto any = controller(
      "kind = \"transfer-function\"\ngain = \"10 V/rad\"\nnum = [1, 2.5]\nden = [0.5, 1, 0]\n");
  EXPECT_THAT(any.output, ElementsAre(5.0, 2.0));
  const auto state = controller(
      "kind = \"state-space\"\ngain = \"10 V/rad\"\nA = [[-1, 0], [1, -2]]\n"
      "B = [[1], [0]]\nC = [0, 1]\nD = [0.5]\n");
  EXPECT_THAT(state.input_matrix[0], ElementsAre(1.0, -1.0, 0.0));
  EXPECT_THAT(state.direct, ElementsAre(0.5, -0.5, 0.0));
  EXPECT_THAT(refusals(plain + std::string("[controller]\nkind = \"state-space\"\n"
                                           "gain = \"1 V/rad\"\nA = [[1]]\nB = [[1]]\nC = [1, 2]\n"
                                           "D = [0]\n")),
              ElementsAre(HasSubstr("controller.A = [[1]]: must have 2 rows, as many as"),
                          HasSubstr("controller.B = [[1]]: must have 2 rows, as many as")));
  EXPECT_THAT(
      refusals(plain + std::string("[controller]\nkind = \"state-space\"\n"
                                   "gain = \"1 V/rad\"\nA = [[1]]\nB = [[1, 2]]\nC = [1]\n"
                                   "D = []\n")),
      ElementsAre(HasSubstr("controller.B = [[1, 2]]: must have 1 number a row, of the error"),
                  HasSubstr("controller.D = []: must have 1 number a row, of the error")));
}

// ---- tables -------------------------------------------------------------------------------------

class DriveFileTable : public ::testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::vector<std::string> refusals_of(const std::string& table) {
    write(table);
    return refusals(text_, folder_);
  }
  void write(const std::string& table) { std::ofstream(folder_ / "move.csv") << table; }

  std::filesystem::path folder_ = std::filesystem::path(::testing::TempDir()) /
                                  ::testing::UnitTest::GetInstance()->current_test_info()->name();
  std::string text_ = plain + std::string(
                                  "[loop]\nerror_gain = \"3 V/rad\"\n"
                                  "[reference]\nkind = \"table\"\nfile = \"move.csv\"\n");
};

TEST_F(DriveFileTable, IsReadWithItsUnits) {
  write("# a move\ntime (ms), position (deg)\n0, 0\n500, 90\n1000, 45\n");
  const auto table = std::get<drive::Table>(drive_of(text_, folder_).drive.reference);
  EXPECT_THAT(table.times, ElementsAre(0.0, 0.5, 1.0));
  EXPECT_THAT(table.values, ElementsAre(0.0, 0.5 * pi, 0.25 * pi));
}

TEST_F(DriveFileTable, EdgeFaultsNameTheLine) {
  EXPECT_THAT(refusals_of("time (s),position (deg)\n0,0\n2,1\n1,1\n"),
              ElementsAre(HasSubstr("move.csv:4: time = 1: must be later than in the row before")));
  EXPECT_THAT(refusals_of("time (s),position (deg)\n0,0\n0,1\n"),
              ElementsAre(HasSubstr("move.csv:3: time = 0: must be later than in the row before")));
  EXPECT_THAT(refusals_of("time (s),position (kg)\n0,0\n"),
              ElementsAre(HasSubstr("second column")));
  EXPECT_THAT(refusals_of("time,position\n0,0\n"), ElementsAre(HasSubstr("first column = time")));
  EXPECT_THAT(refusals_of("time (s),position (deg)\n0,x\n"), ElementsAre(HasSubstr(":2: value")));
  EXPECT_THAT(refusals_of("time (s),position (deg)\n0\n"),
              ElementsAre(HasSubstr("move.csv:2: row = one column: must have two columns")));
  EXPECT_THAT(refusals_of("time (s),position (deg)\n0,1,2\n"),
              ElementsAre(HasSubstr("move.csv:2: row = more than two columns: must have two")));
  EXPECT_THAT(refusals_of("time (s),position (deg)\n"), ElementsAre(HasSubstr("without rows")));
  EXPECT_THAT(refusals_of(""), ElementsAre(HasSubstr("an empty table")));
  EXPECT_THAT(refusals_of("time (s),position (deg)\n0,0\n1,inf\n2,1\n"),
              ElementsAre(HasSubstr("move.csv:3: value = inf: must be finite")));
  std::filesystem::remove(folder_ / "move.csv");
  EXPECT_THAT(refusals(text_, folder_), ElementsAre(HasSubstr("move.csv")));
}

TEST_F(DriveFileTable, EdgeATooLongOneIsRefusedNotCut) {
  constexpr std::size_t largest = 64 * 1024 * 1024;
  std::string table = "time (s),position (deg)\n0,0\n#";
  table.resize(largest - 4, '-');
  // Cut at the limit it would end in "1,2".
  EXPECT_THAT(refusals_of(table + "\n1,20\n"),
              ElementsAre(HasSubstr("reference.file = move.csv: must be at most 67108864 bytes")));
}

TEST_F(DriveFileTable, EdgeANameIsNeeded) {
  EXPECT_THAT(
      refusals(replaced(text_, "\"move.csv\"", "\"\""), folder_),
      ElementsAre(HasSubstr("18:8: reference.file = \"\": must be the name of a CSV file")));
}

TEST_F(DriveFileTable, MayStandInTheDrivesOwnFile) {
  const std::string inline_text =
      replaced(text_, "file = \"move.csv\"", "times = [0, 0.5, 1]\nvalues = [0, 1.5, 0.75]");
  const Drive drive = parse_drive(inline_text, "drive.toml", folder_, {}).drive;
  const auto table = std::get<TableSignal>(*drive.reference);
  EXPECT_THAT(table.times, ElementsAre(0.0, 0.5, 1.0));
  EXPECT_THAT(table.values, ElementsAre(0.0, 1.5, 0.75));
  EXPECT_EQ(table.file, "");
}

TEST_F(DriveFileTable, EdgePointsAreCheckedLikeAFile) {
  write("time (s),position (deg)\n0,0\n1,1\n");
  const auto with = [&](const std::string& keys) {
    return refusals(replaced(text_, "file = \"move.csv\"", keys), folder_);
  };
  EXPECT_THAT(with("times = [0, 1]"), ElementsAre(HasSubstr("reference.values")));
  EXPECT_THAT(with("times = [0, 1]\nvalues = [0]"), ElementsAre(HasSubstr("as many as values")));
  EXPECT_THAT(with("times = [1, 0]\nvalues = [0, 1]"), ElementsAre(HasSubstr("reference.times")));
  EXPECT_THAT(with("file = \"move.csv\"\ntimes = [0]\nvalues = [0]"),
              Contains(HasSubstr("reference.times")));
  EXPECT_THAT(with("values = [0]"), Contains(HasSubstr("reference.file")));
}

TEST(BareNumbers, AreInSiWhereAProgramGivesThem) {
  const std::string text = replaced(plain, "\"1 deg\"", "0.25") + "[loop]\nerror_gain = 3\n";
  EXPECT_FALSE(refusals(text, {}).empty());
  const Drive drive = parse_drive(text, "", {}, {}, BareNumbers::in_si).drive;
  EXPECT_EQ(drive.gearbox.backlash, 0.25);
  EXPECT_EQ(std::get<PID>(drive.controller.law).proportional, 3.0);
}

// ---- faults -------------------------------------------------------------------------------------

TEST(EdgeDriveFile, EveryFaultIsToldAtOnce) {
  std::string text = joint;
  text = replaced(text, "breakaway = \"5 mN m\"", "breakaway = \"2 mN m\"");
  text = replaced(text, "stiffness = \"500 N m/rad\"", "stiffness = \"-1 N m/rad\"");
  text = replaced(text, "counts_per_turn = 4096", "counts_per_turn = 0");
  text = replaced(text, "period = \"1 ms\"", "period = \"0 s\"");
  text = replaced(text, "speed = \"1 rad/s\"", "speed = \"0 rad/s\"");
  text = replaced(text, "after = \"0.1 N m\"", "after = \"0.1 rad\"");
  EXPECT_THAT(
      refusals(text),
      ElementsAre(
          "drive.toml:6:13: motor.breakaway = 2 mN m: must be at least "
          "motor.coulomb, 0.003 N m: a shaft at rest is not easier to move than a moving one",
          HasSubstr("contact.stiffness = -1 N m/rad: must be positive"),
          HasSubstr("sensor.counts_per_turn = 0: must be positive"),
          HasSubstr("sampling.period = 0 s: must be positive"),
          HasSubstr("reference.speed = 0 rad/s: must be positive"),
          HasSubstr("load_torque.after = 0.1 rad: must be a torque")));
}

TEST(EdgeDriveFile, ControllersThatNothingCanBeGetALine) {
  const auto refusal = [](const std::string& controller, const std::string& more = "") {
    return refusals(plain +
                    std::string("[controller]\nkind = \"transfer-function\"\n"
                                "gain = \"1 V/rad\"\n") +
                    controller + more);
  };
  const std::string sampling = "[sampling]\nperiod = \"10 ms\"\n";
  std::string many = "1";
  for (int i = 0; i < 65; ++i) many += ", 1";
  EXPECT_THAT(refusal("num = [1]\nden = [" + many + "]\n"),
              ElementsAre(::testing::AllOf(HasSubstr("controller.den = [1, 1, "),
                                           HasSubstr(": must be of order at most 64 (order 65)"))));
  EXPECT_THAT(refusal("num = [1, 0, 0]\nden = [1, 1]\n"),
              ElementsAre(HasSubstr("controller.num = [1, 0, 0]: must be of no higher degree")));
  EXPECT_THAT(refusal("num = [1]\nden = [1, -2]\nvariable = \"z\"\n", sampling),
              ElementsAre(HasSubstr("controller.den = [1, -2]: must have its roots in the unit")));
  EXPECT_THAT(refusal("num = [1]\nden = [1, -0.5]\nvariable = \"z\"\n"),
              ElementsAre(HasSubstr("sampling")));
  EXPECT_THAT(refusal("num = [1, 0]\nden = [0.004, 1]\n", sampling + "method = \"forward\"\n"),
              ElementsAre(HasSubstr("sampling.period = 10 ms: must be shorter")));
  EXPECT_THAT(refusal("num = [1, 0]\nden = [0.004, 1]\n", sampling), IsEmpty());
  EXPECT_THAT(refusal("num = \"1\"\nden = [0, 0]\n").size(), 2U);
  EXPECT_THAT(refusal("num = [1, 0, 0]\nden = [1, -2]\nvariable = \"z\"\n",
                      "[sampling]\nperiod = \"0 ms\"\n"),
              ElementsAre(HasSubstr("controller.num = [1, 0, 0]: must be of no higher degree"),
                          HasSubstr("controller.den = [1, -2]: must have its roots in the unit"),
                          HasSubstr("sampling.period = 0 ms: must be positive")));
}

/// What is derived from a number at fault is not told as another fault.
TEST(EdgeDriveFile, AFaultIsToldOnce) {
  for (const std::string ratio : {"0", "inf", "nan"}) {
    EXPECT_THAT(refusals(replaced(joint, "ratio = 50", "ratio = " + ratio)),
                ElementsAre(HasSubstr("gearbox.ratio = " + ratio + ": must be positive")));
  }
  EXPECT_THAT(refusals(plain + std::string("[loop]\nerror_gain = \"3 V/rad\"\n"
                                           "[sensor]\nresolution = \"-1 deg\"\n")),
              ElementsAre(HasSubstr("sensor.resolution = -1 deg: must be zero or positive")));
}

/// The faults of `joint` with one parameter set.
std::vector<std::string> refusals_with(const Setting& setting) {
  return test::faults_of([&] { parse_drive(joint, "drive.toml", ".", {setting}); });
}

TEST(EdgeDriveFile, NumbersWhoseProductsAreNoDoublesAreRefusedByTheirKeys) {
  for (const auto& [path, number, unit] : {std::tuple("gearbox.backlash", "1e308", " rad"),
                                           {"load.inertia", "1e150", " kg m2"},
                                           {"load.friction", "1e61", " N m s/rad"},
                                           {"controller.proportional", "1e308", " N m/rad"},
                                           {"gearbox.ratio", "1e200", ""},
                                           {"reference.to", "1e308", " rad"},
                                           {"load_torque.after", "-1e100", " N m"},
                                           {"sampling.period", "1e61", " s"}}) {
    EXPECT_THAT(refusals_with({path, std::string(number) + unit}),
                ::testing::Contains(::testing::AllOf(
                    HasSubstr(std::string(path) + " = " + number + unit),
                    HasSubstr("must be at most 1e+60" + std::string(unit) + " in size"))));
  }
  EXPECT_THAT(refusals_with({"load.inertia", "1e-61 kg m2"}),
              ElementsAre("--set: load.inertia = 1e-61 kg m2: must be at least 1e-60 kg m2"));
  EXPECT_THAT(refusals_with({"load.inertia", "1e59 kg m2"}), IsEmpty());
  EXPECT_THAT(refusals_with({"load.friction", "0 N m s/rad"}), IsEmpty());
}

TEST(EdgeDriveFile, ATableOfSuchNumbersIsRefused) {
  const std::filesystem::path file = std::filesystem::temp_directory_path() / "gearlash-large.csv";
  std::ofstream(file) << "time (s),position (rad)\n0,0\n1,1e308\n";
  const std::string table = "kind = \"table\"\nfile = \"" + file.string() + "\"\n";
  const std::string text = joint;
  const std::size_t begin = text.find("kind = \"trapezoid\"");
  const std::size_t end = text.find("[load_torque]");
  EXPECT_THAT(refusals(text.substr(0, begin) + table + text.substr(end)),
              ElementsAre(HasSubstr("must hold numbers of at most 1e+60 in size, not 1e+308")));
  std::filesystem::remove(file);
}

TEST(EdgeDriveFile, ADelayOfAHundredPeriodsIsOneInSpiteOfRounding) {
  const auto with_delay = [](const char* delay) {
    return test::faults_of([&] {
      parse_drive(joint, "drive.toml", ".",
                  {{"sampling.period", "50 us"}, {"sampling.delay", delay}});
    });
  };
  EXPECT_THAT(with_delay("5 ms"), IsEmpty());
  EXPECT_THAT(with_delay("5.0001 ms"), ElementsAre(HasSubstr("sampling.delay = 5.0001 ms")));
}

TEST(EdgeDriveFile, TolerancesAreCheckedWhateverIsAsked) {
  EXPECT_THAT(
      refusals_with({"motor.inertia", "2 kg cm2 ± 1000 %"}),
      ElementsAre(HasSubstr("motor.inertia = 2 kg cm2 ± 1000 %: must not fall below zero")));
  EXPECT_THAT(refusals_with({"motor.inertia", "2 kg cm2 ± 10 %"}), IsEmpty());
}

TEST(EdgeDriveFile, ASideWithoutInertiaIsTheClosedFormsAlone) {
  const std::string massless = replaced(plain, "1e-3 kg m2", "0 kg m2") +
                               "[loop]\nerror_gain = \"3 V/rad\"\n"
                               "[reference]\nkind = \"constant\"\nvalue = \"1 rad\"\n";
  EXPECT_TRUE(servo_of(parse_drive(massless, "drive.toml", ".", {})));
}

TEST(EdgeDriveFile, WhatExcludesEachOtherIsTold) {
  EXPECT_THAT(refusals(joint + std::string("[loop]\nerror_gain = \"1 N m/rad\"\n")),
              ElementsAre(HasSubstr("loop")));
  EXPECT_THAT(refusals(replaced(joint, "law =", "restitution = 0.5\nlaw =")),
              ElementsAre(HasSubstr("contact.restitution = 0.5: must not stand beside stiffness")));
  EXPECT_THAT(refusals(joint + std::string("[servo]\ndamping = 1\n")),
              ElementsAre(HasSubstr("servo")));
  EXPECT_THAT(refusals(replaced(joint, "torque_limit = \"0.2 N m\"", "voltage_limit = \"1 V\"")),
              ElementsAre(HasSubstr("motor.voltage_limit = 1 V: is not a key of [motor]")));
  EXPECT_THAT(refusals(plain + std::string("[sensor]\nposition = \"load\"\n")),
              ElementsAre(HasSubstr("controller is missing: must be a section [controller] with")));
}

}  // namespace
}  // namespace gearlash::drive_file_test
