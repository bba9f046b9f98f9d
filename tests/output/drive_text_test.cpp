// A drive that is written down reads back as the same drive.
#include "output/drive_text.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "gearlash/input.hpp"
#include "gearlash/parameter.hpp"
#include "model/parameters.hpp"
#include "model/reduced_drive.hpp"
#include "output/json_writer.hpp"

namespace gearlash::drive_text_test {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

const std::filesystem::path examples =
    std::filesystem::path(GEARLASH_SOURCE_DIRECTORY) / "examples";

Drive read(const std::string& text, const std::vector<Setting>& settings = {}) {
  return parse_drive(text, "drive.toml", examples, settings).drive;
}

TEST(DriveText, EveryExampleReadsBackAsTheSameDrive) {
  for (const auto& entry : std::filesystem::recursive_directory_iterator(examples)) {
    if (entry.path().extension() != ".toml" || entry.path().stem() == "sweep") continue;
    if (entry.path().parent_path().stem() == "faulty") continue;
    const Drive drive = read(read_text_file(entry.path(), largest_drive_file));
    const std::string text = to_toml(drive);
    const Drive again = read(text);
    EXPECT_EQ(to_toml(again), text) << entry.path();
    EXPECT_EQ(parameter_values(again), parameter_values(drive)) << entry.path();
  }
}

const std::string plant =
    "[motor]\nkind = \"torque-controlled\"\ninertia = \"1e-4 kg m2\"\n"
    "friction = \"1e-4 N m s/rad\"\ntorque_limit = \"0.1 N m\"\n"
    "torque_constant = \"0.1 N m/A\"\n"
    "[gearbox]\nratio = 3\nbacklash = \"0.1 deg\"\n"
    "[load]\ninertia = \"0.02 kg m2\"\nfriction = \"0.01 N m s/rad\"\n";

const std::vector<std::string> controllers = {
    "kind = \"P\"\nproportional = \"0.1 N m/deg\"",
    "kind = \"PI\"\nkp = \"1 N m/rad\"\nintegral = \"2 N m/(rad s)\"\ntracking_time = \"3 ms\"",
    "kind = \"cascade\"\nposition = \"3 1/s\"\nspeed = \"2 N m s/rad\"\n"
    "speed_integral = \"4 N m/rad\"",
    "kind = \"cascade\"\nposition = \"3 1/s\"\nspeed = \"2 N m s/rad\"\n"
    "speed_limit = \"100 rpm\"\nspeed_feedforward = \"80 %\"\n"
    "acceleration_feedforward = \"0.2 N m s2/rad\"",
    "kind = \"odrive\"\npos_gain = 20\nvel_gain = 0.16\ntracking_time = \"0.1 s\"",
    "kind = \"moteus\"\npid_position_kp = 4\nrotor_to_output_ratio = 0.25",
    "kind = \"lead-lag\"\ngain = \"3 N m/rad\"\nzero = \"2 rad/s\"\npole = \"20 rad/s\"",
    "kind = \"transfer-function\"\ngain = \"3 N m/rad\"\nnum = [1, 0.1]\nden = [0.3, 1]",
    "kind = \"state-space\"\ngain = \"3 N m/rad\"\nA = [[-1]]\nB = [[0.1]]\nC = [1]\nD = "
    "[2]",
    "kind = \"relay\"\nshaft = \"mixed\"\nlevel = \"2 N m\"\nhysteresis = \"1 arcmin\"",
    "kind = \"relay\"\nlevel = \"2 N m\"\ninput = \"speed\"\nhysteresis = \"1 rpm\"",
    "kind = \"P\"\nkp = \"1 N m/rad\"\ndead_band = \"1 arcmin\"\ndead_band_form = \"whole\"\n"
    "hysteresis = \"0.5 arcmin\"\nfriction_compensation = \"1 N m\"\nfriction_speed = \"1 "
    "rpm\"",
    "kind = \"P\"\nkp = \"1 N m/rad\"\nbacklash_compensation = \"6 arcmin\"\n"
    "compensation_input = \"error\"\ntake_up_angle = \"1 arcmin\"",
    "kind = \"P\"\nkp = \"1 N m/rad\"\nbacklash_compensation = \"6 arcmin\"\n"
    "take_up_time = \"10 ms\""};

/// Its manual states no period.
const std::string sampled_controller =
    "kind = \"simplefoc\"\nP_angle = 20\nPID_velocity_P = 0.5\nPID_velocity_I = 10\n"
    "LPF_velocity_Tf = 0.01";

const std::vector<std::string> references = {
    "",
    "[reference]\nkind = \"constant\"\nvalue = \"1 deg\"",
    "[reference]\nkind = \"step\"\nafter = \"1 deg\"\ntime = \"1 ms\"",
    "[reference]\nkind = \"ramp\"\nvalue = \"1 deg\"\nrate = \"3 rpm\"",
    "[reference]\nkind = \"sine\"\namplitude = \"1 deg\"\nfrequency = \"3 Hz\"",
    "[reference]\nkind = \"table\"\ntimes = [0, 1]\nvalues = [0, 0.1]",
    "[reference]\nkind = \"trapezoid\"\nto = \"1 deg\"\nspeed = \"1 rad/s\"\n"
    "acceleration = \"7 rad/s2\""};

TEST(DriveText, EveryKindOfControllerAndSignalReadsBack) {
  for (const std::string& controller : controllers) {
    for (const std::string& reference : references) {
      const Drive drive = read(plant + "[controller]\n" + controller + "\n" + reference + "\n");
      EXPECT_EQ(to_toml(read(to_toml(drive))), to_toml(drive)) << controller << reference;
      EXPECT_EQ(parameter_values(read(to_toml(drive))), parameter_values(drive))
          << controller << reference;
    }
  }
}

/// Drives that have every number of the registry between them.
std::vector<Drive> drives_of_every_kind() {
  std::vector<Drive> drives;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(examples)) {
    if (entry.path().extension() != ".toml" || entry.path().stem() == "sweep") continue;
    if (entry.path().parent_path().stem() == "faulty") continue;
    drives.push_back(read(read_text_file(entry.path(), largest_drive_file)));
  }
  const std::string parts =
      "[sampling]\nperiod = '1 ms'\n[sensor]\nresolution = '1 arcmin'\n"
      "[contact]\nkind = 'compliant'\nstiffness = '100 N m/rad'\n";
  const std::vector<std::string> torques = {
      "kind = 'constant'\nvalue = '0.1 N m'", "kind = 'step'\nafter = '0.1 N m'",
      "kind = 'sine'\namplitude = '0.1 N m'\nfrequency = '1 Hz'",
      "kind = 'table'\ntimes = [0, 1]\nvalues = [0, 0.1]"};
  std::vector<std::string> all = controllers;
  all.push_back(sampled_controller);
  for (std::size_t i = 0; i < all.size(); ++i) {
    drives.push_back(read(plant + "[controller]\n" + all[i] + "\n" +
                          references[i % references.size()] + "\n" + parts + "[load_torque]\n" +
                          torques[i % torques.size()] + "\n"));
  }
  return drives;
}

// The settling time of matrices whose eigenvalues no algorithm found, as of faces of 1e60 N m/rad,
// was memory that nothing had written.
TEST(DriveText, WhatShowWritesShowsTheSameAtTheEndsOfEveryRange) {
  std::set<std::string_view> left;
  for (const Parameter& parameter : all_parameters_of_drives()) {
    const bool is_file = parameter.key() == "file";  // see tests/cli/file_names_test.cpp
    if (parameter.choices.empty() && !is_file) left.insert(parameter.path);
  }
  for (const Drive& drive : drives_of_every_kind()) {
    for (const Parameter& parameter : all_parameters_of_drives()) {
      const std::string path(parameter.path);
      if (!exists(parameter, drive)) continue;
      const Slot slot = parameter.slot(const_cast<Drive&>(drive));
      const bool is_number = std::holds_alternative<double*>(slot) ||
                             std::holds_alternative<std::optional<double>*>(slot);
      if (!is_number) {
        left.erase(parameter.path);
        continue;
      }
      for (const double value : {0.0, 1e-300, 1e-60, 1.0, 1e60, 1e300}) {
        Drive changed = drive;
        set(changed, path, value);
        if (!faults(changed).empty()) continue;
        left.erase(parameter.path);
        const std::string text = show_text(changed);
        EXPECT_EQ(show_text(read(text)), text) << path << " = " << value;
      }
    }
  }
  EXPECT_THAT(left, IsEmpty());
}

TEST(DriveText, APrintedSheetReadsBack) {
  const Drive drive = read(
      "[motor]\nkind = \"brushed-dc\"\ninertia = \"142 g cm²\"\nfriction = 0\n"
      "torque_constant = \"30.2 mNm/A\"\nspeed_constant = \"317 rpm/V\"\n"
      "resistance = \"0.299 Ω\"\ninductance = \"0.082 mH\"\nno_load_current = \"137 mA\"\n"
      "[gearbox]\nratio = \"43:1\"\nbacklash = \"0.8°\"\nefficiency = \"72 %\"\n"
      "inertia = \"15 gcm²\"\n[load]\ninertia = \"0.05 kgm²\"\nfriction = \"0\"\n"
      "[controller]\nkind = \"PID\"\nkp = \"20 V/deg\"\nki = \"1 V/(deg s)\"\n"
      "kd = \"0\"\n[sampling]\nrate = \"1 kHz\"\n");
  EXPECT_EQ(to_toml(read(to_toml(drive))), to_toml(drive));
  EXPECT_EQ(parameter_values(read(to_toml(drive))), parameter_values(drive));
  EXPECT_EQ(drive.sampling->period, 1e-3);
}

TEST(DriveText, ShowsWhatTheRegistersOfAFirmwareMean) {
  const Drive drive = read(read_text_file(examples / "dynamixel-joint.toml", largest_drive_file));
  const auto firmware = shown_drive(drive, {}).firmware.value();
  EXPECT_EQ(firmware.shaft, "load");
  ASSERT_EQ(firmware.gains.size(), 1U);
  EXPECT_EQ(firmware.gains[0].unit, "V/rad");
  EXPECT_DOUBLE_EQ(firmware.gains[0].value, 55.24564804274605);
  const std::string text = show_text(drive);
  EXPECT_THAT(text, HasSubstr("# The registers of DYNAMIXEL X mean: proportional 55.25 V/rad"));
  EXPECT_THAT(text, HasSubstr("ROBOTIS e-Manual"));
  const Drive joint = read(read_text_file(examples / "robot-joint.toml", largest_drive_file));
  EXPECT_FALSE(shown_drive(joint, {}).firmware);
}

TEST(DriveText, DefaultsAreNamed) {
  const Drive drive = read(read_text_file(examples / "elinco-fd162.toml", largest_drive_file));
  const std::vector<std::string> defaults = defaults_taken(drive);
  EXPECT_THAT(defaults, Contains("motor.coulomb"));
  EXPECT_THAT(defaults, Contains("sensor.position"));
  EXPECT_THAT(defaults, Not(Contains("motor.inertia")));
}

TEST(DriveText, EveryKindOfToleranceReadsBack) {
  const std::string text = read_text_file(examples / "robot-joint.toml", largest_drive_file);
  const Drive nominal = read(text, {{"gearbox.backlash", "1.5 mrad"},
                                    {"load.inertia", "0.03 kg m2"},
                                    {"load.friction", "0.01 N m s/rad"},
                                    {"gearbox.ratio", "20"}});
  const TolerancedDrive drive{nominal,
                              {{"gearbox.ratio", DiscreteLots{{{19.0, 1.0}, {20.0, 2.5}}}},
                               {"gearbox.backlash", UniformBetween{1e-3 / 3.0, 2e-3}},
                               {"load.inertia", UniformAbout{0.03, 0.003 / 7.0}},
                               {"load.friction", Normal{0.01, 0.001 / 3.0, 0.005, std::nullopt}}}};
  const WrittenDrive again = parse_drive(to_toml(drive), "drive.toml", examples);
  EXPECT_EQ(parameter_values(again.drive), parameter_values(nominal));
  EXPECT_EQ(again.tolerances, drive.varied);
  EXPECT_EQ(to_toml(TolerancedDrive{again.drive, again.tolerances}), to_toml(drive));
}

TEST(DriveText, ATolerancedDriveHasTheNominalValueOfItsDistribution) {
  Drive drive = normal_form(0.2, 1.0, 0.5);
  const TolerancedDrive toleranced{drive, {{"servo.damping", UniformAbout{0.3, 0.1}}}};
  EXPECT_EQ(read(to_toml(toleranced)).servo->damping, 0.3);
  const TolerancedDrive exact{drive, {{"servo.damping", ExactValue{0.4}}}};
  EXPECT_EQ(read(to_toml(exact)).servo->damping, 0.4);
}

TEST(DriveText, WhatFollowsAnotherParameterIsLeftOutWhereNoneIsGiven) {
  Drive drive = read(read_text_file(examples / "toleranced-joint.toml", largest_drive_file));
  EXPECT_THAT(to_toml(drive), HasSubstr("breakaway = \"0.02 N m\"\nstribeck"));
  const std::string text = given_toml({drive, {}});
  EXPECT_THAT(text, HasSubstr("breakaway = \"0.0034323275 N m\""));  // given
  EXPECT_THAT(text, Not(HasSubstr("breakaway = \"0.02 N m\"")));
  EXPECT_EQ(given_toml({read(text), {}}), text);
  EXPECT_EQ(to_toml(read(text)), to_toml(drive));
}

TEST(DriveText, InfinityIsText) {
  Drive drive = normal_form(0.2, std::numeric_limits<double>::infinity(), 0.5);
  EXPECT_EQ(to_toml(read(to_toml(drive))), to_toml(drive));
}

// Else a copy would be proved for the short decimals of its doubles.
TEST(DriveText, ARoundedDriveReadsBackAsOne) {
  const auto servo_with = [](const std::string& damping) {
    return read("[servo]\ndamping = " + damping +
                "\ninertia_ratio = 2\nfriction_ratio = 0.1\nbacklash = '0.3 rad'\n");
  };
  for (const char* damping : {"0.19000000000000000000001", "0.5000000000000000000001", "0.19"}) {
    const Drive drive = servo_with(damping);
    const Drive again = read(to_toml(drive));
    EXPECT_EQ(to_toml(again), to_toml(drive));
    EXPECT_EQ(again.is_rounded, drive.is_rounded) << to_toml(drive);
    EXPECT_EQ(drive.is_rounded, std::string(damping) != "0.19");
  }
  Drive exact = servo_with("0.19");
  EXPECT_FALSE(exact == servo_with("0.19000000000000000000001"));
  EXPECT_EQ(defaults_taken(exact), defaults_taken(servo_with("0.19000000000000000000001")));
  exact.is_rounded = true;
  EXPECT_EQ(exact, servo_with("0.19000000000000000000001"));
  const Drive listed = read(
      "[motor]\nkind = 'torque-controlled'\ninertia = '2 g cm2'\nfriction = '1e-6 N m "
      "s/rad'\n[gearbox]\nratio = '113/12'\n"
      "backlash = '2 mrad'\n[load]\ninertia = '0.01 kg m2'\nfriction = '0.1 N m s/rad'\n"
      "[controller]\nkind = 'state-space'\ngain = '1 N m/rad'\nA = [[-100]]\n"
      "B = [[1, -1, 0]]\nC = [1]\n"
      "D = [20.5, -20.500000000000000000001, 0]\n");
  EXPECT_TRUE(listed.is_rounded);
  EXPECT_TRUE(read(to_toml(listed)).is_rounded) << to_toml(listed);
}

}  // namespace
}  // namespace gearlash::drive_text_test
