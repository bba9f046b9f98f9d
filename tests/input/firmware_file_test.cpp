// Files whose controller is a motor's firmware, with its registers as the firmware has them.
#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "gearlash/analyse.hpp"
#include "gearlash/input.hpp"
#include "gearlash/parameter.hpp"
#include "input/text_of_drive.hpp"
#include "model/firmware.hpp"
#include "model/reduced_drive.hpp"
#include "question/analyse.hpp"

namespace gearlash::firmware_file_test {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr char joint[] = R"toml([motor]
kind = "brushed-dc"
inertia = "0.02 g cm2"
friction = "0"
torque_constant = "5 mN m/A"
back_emf_constant = "7 mV s/rad"
resistance = "5.2 ohm"
no_load_current = "50 mA"
voltage_limit = "12 V"
[gearbox]
ratio = 353.5
backlash = "0.25 deg"
[load]
inertia = "20 kg cm2"
friction = "0.01 N m s/rad"
[sensor]
position = "load"
counts_per_turn = 4096
[controller]
kind = "dynamixel-x"
position_p_gain = 800
position_d_gain = 200
[sampling]
period = "1 ms"
)toml";

Drive read(const std::vector<Setting>& settings = {}) {
  return test::drive_of_text(joint, settings);
}

std::vector<std::string> refusals(const std::vector<Setting>& settings) {
  return test::refusals_of_text(joint, settings);
}

TEST(FirmwareFile, IsReadWithItsRegisters) {
  const Drive drive = read();
  const auto& registers = std::get<DynamixelX>(*drive.controller.firmware);
  EXPECT_EQ(registers.position_p_gain, 800.0);
  EXPECT_EQ(registers.position_i_gain, 0.0);
  EXPECT_EQ(registers.position_d_gain, 200.0);
  EXPECT_EQ(get(read({{"controller.position_p_gain", "400"}}), "controller.position_p_gain"),
            400.0);
}

TEST(FirmwareFile, RefusesAFirmwareWithoutAPublishedConversion) {
  const auto is_the_reason = HasSubstr(
      "controller.kind = feetech-sts: must be a law with its gains in SI units: the published "
      "memory table of Feetech's STS servos lists P, D and I coefficients without a unit, and no "
      "public manual states how they convert");
  EXPECT_THAT(refusals({{"controller.kind", "feetech-sts"}}), ElementsAre(is_the_reason));
  Drive drive = read();
  EXPECT_THAT(test::faults_of([&] { set(drive, "controller.kind", "feetech-sts"); }),
              ElementsAre(is_the_reason));
}

TEST(FirmwareFile, AnUnknownWordListsThoseThereAre) {
  EXPECT_THAT(
      refusals({{"controller.kind", "odriv"}}),
      ElementsAre(AllOf(HasSubstr("must be one of P, PD, PI, PID, cascade, lead-lag, "
                                  "transfer-function, state-space, relay, dynamixel-x, odrive, "
                                  "moteus, simplefoc (did you mean odrive?)"))));
  EXPECT_THAT(refusals({{"controller.pos_gain", "20"}}),
              ElementsAre(HasSubstr("controller.pos_gain = 20: is not a key of [controller]")));
}

TEST(FirmwareFile, NamesWhatLacks) {
  EXPECT_THAT(refusals({{"motor.voltage_limit", "none"}}),
              ElementsAre(HasSubstr("motor.voltage_limit is missing: must be given: the supply "
                                    "voltage, of which the output of dynamixel-x is a share")));
  EXPECT_THAT(refusals({{"sampling", "none"}}),
              ElementsAre(HasSubstr("sampling.period is missing: must be given beside "
                                    "dynamixel-x, which is sampled")));
  EXPECT_THAT(refusals({{"controller.position_p_gain", "none"}}),
              ElementsAre(HasSubstr("controller.position_p_gain is missing: must be a number as "
                                    "the firmware has it, without a unit")));
  EXPECT_THAT(refusals({{"controller.position_p_gain", "-1"}}),
              ElementsAre(HasSubstr("controller.position_p_gain = -1: must be zero or positive")));
  const std::vector<Setting> odrive = {
      {"controller.kind", "odrive"}, {"controller.pos_gain", "20"}, {"controller.vel_gain", "1"}};
  EXPECT_THAT(refusals(odrive),
              ElementsAre(HasSubstr("controller.kind = odrive: must control a torque-controlled "
                                    "motor: its gains are torques")));
}

TEST(FirmwareFile, IsSampledAsItsManualStates) {
  std::vector<Setting> settings = {{"controller.kind", "odrive"},
                                   {"controller.pos_gain", "20"},
                                   {"controller.vel_gain", "1"},
                                   {"sampling", "none"},
                                   {"motor.kind", "torque-controlled"}};
  const Drive drive = read(settings);
  ASSERT_TRUE(drive.sampling);
  EXPECT_EQ(drive.sampling->period, 125e-6);
  settings.back() = {"sampling.period", "1 ms"};
  settings.push_back({"motor.kind", "torque-controlled"});
  settings.erase(settings.begin() + 3);
  EXPECT_EQ(read(settings).sampling->period, 1e-3);
}

/// A drive of registers and the same drive typed in SI units are answered alike.
TEST(FirmwareFile, AnswersAsTheDriveTypedInSIUnits) {
  const Drive registers = read();
  // 12 V/885 · 4096/(2π) = 8.839303686839368 V/rad for a gain of 1.
  const Drive typed = read({{"controller.kind", "PD"},
                            {"controller.position_p_gain", "none"},
                            {"controller.position_d_gain", "none"},
                            {"controller.proportional", "55.24564804274605 V/rad"},
                            {"controller.derivative", "0.1104912960854921 V s/rad"},
                            {"controller.derivative_of", "speed"}});
  const Answer one = analyse(registers);
  const Answer other = analyse(typed);
  EXPECT_EQ(one.verdict, other.verdict);
  ASSERT_EQ(one.cycles.size(), other.cycles.size());
  for (std::size_t i = 0; i < one.cycles.size(); ++i) {
    EXPECT_NEAR(one.cycles[i].amplitude, other.cycles[i].amplitude, 1e-9 * one.cycles[i].amplitude);
  }
  ASSERT_EQ(one.irregular.size(), other.irregular.size());
  EXPECT_EQ(one.rest.has_value(), other.rest.has_value());
}

}  // namespace
}  // namespace gearlash::firmware_file_test
