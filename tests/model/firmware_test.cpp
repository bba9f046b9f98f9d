// Registers of firmwares beside conversions worked by hand from the makers' manuals.
#include "model/firmware.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <string>

#include "gearlash/parameter.hpp"
#include "model/gains.hpp"
#include "model/parameters.hpp"
#include "model/reduced_drive.hpp"

namespace gearlash::firmware_test {
namespace {

constexpr double turn = 2.0 * std::numbers::pi;

Drive of_volts() {
  Drive drive;
  drive.motor = {.kind = ArmatureControl{0.005, 0.007, 5.2}, .inertia = 2e-8, .limit = 12.0};
  drive.gearbox = {.ratio = 350.0, .backlash = 0.004};
  drive.load = {.inertia = 0.01, .friction = {.viscous = 0.01}};
  return drive;
}

Drive of_torque() {
  Drive drive = of_volts();
  drive.motor = {.kind = TorqueControl{}, .inertia = 1e-5, .limit = 1.0};
  drive.gearbox.ratio = 8.0;
  drive.sensor.position = SensorPlace::motor;
  return drive;
}

void choose(Drive& drive, std::string_view word) {
  const Parameter& kind = *find_parameter("controller.kind");
  std::get<Choice>(kind.slot(drive)).choose(drive, *choice_named(kind, word));
}

Drive dynamixel(double p, double i, double d) {
  Drive drive = of_volts();
  choose(drive, "dynamixel-x");
  set(drive, "sampling.period", 1e-3);
  set(drive, "controller.position_p_gain", p);
  set(drive, "controller.position_i_gain", i);
  set(drive, "controller.position_d_gain", d);
  return drive;
}

/// 4096 counts a turn, 885 for 12 V: 8.8393036868 V per rad for a gain of 1.
TEST(OracleFirmware, DynamixelX) {
  const Drive drive = dynamixel(800.0, 100.0, 1000.0);
  const Conversion conversion = converted(drive);
  const auto& pid = std::get<PID>(conversion.controller.law);
  EXPECT_EQ(pid.terms, PIDTerms::PID);
  EXPECT_DOUBLE_EQ(pid.proportional, 55.24564804274605);
  EXPECT_DOUBLE_EQ(pid.integral, 13.487707041686047);
  EXPECT_DOUBLE_EQ(pid.derivative, 0.5524564804274604);
  EXPECT_DOUBLE_EQ(pid.tracking_time, 512.0 * 800.0 / 100.0 * 1e-3);
  EXPECT_TRUE(pid.derivative_of_speed);
  EXPECT_EQ(conversion.controller.shaft, GainShaft::load);
  // 1° of the horn is 4096/360 counts, which 800/128 makes 71.11 of 885.
  EXPECT_NEAR(pid.proportional * turn / 360.0, 4096.0 / 360.0 * 6.25 / 885.0 * 12.0, 1e-14);
  EXPECT_EQ(std::get<PID>(converted(dynamixel(800, 0, 0)).controller.law).terms, PIDTerms::P);
  EXPECT_EQ(std::get<PID>(converted(dynamixel(800, 0, 9)).controller.law).terms, PIDTerms::PD);
  EXPECT_EQ(std::get<PID>(converted(dynamixel(800, 9, 0)).controller.law).terms, PIDTerms::PI);
}

/// The sampled controller gives what the registers say in counts: sums and differences from sample
/// to sample.
TEST(OracleFirmware, DynamixelXFromSampleToSample) {
  Drive drive = dynamixel(700.0, 300.0, 900.0);
  drive.sampling->method = Discretization::backward;
  const drive::ReducedDrive reduced = reduce(drive);
  const drive::LinearController sampled =
      drive::sampled_controller(reduced.controller, *reduced.sampling);
  const double torque_per_volt = refer_output(drive).torque;
  std::vector<double> states(sampled.order(), 0.0);
  double sum = 0.0;
  double last = 0.0;
  for (int k = 0; k < 20; ++k) {
    const double position = 0.02 * std::sin(0.7 * k) + 0.001 * k;
    const double reference = 0.05;
    const double speed = (position - last) / drive.sampling->period;
    const std::array input = {reference, position, speed};
    const auto row = [&](const std::vector<double>& factors, const std::vector<double>& inputs) {
      double value = 0.0;
      for (std::size_t i = 0; i < states.size(); ++i) value += factors[i] * states[i];
      for (std::size_t i = 0; i < 3; ++i) value += inputs[i] * input[i];
      return value;
    };
    const double torque = row(sampled.output, sampled.direct);
    std::vector<double> next;
    for (std::size_t i = 0; i < states.size(); ++i) {
      next.push_back(row(sampled.state_matrix[i], sampled.input_matrix[i]));
    }
    states = next;
    const double counts = 4096.0 / turn;
    const double error = counts * (reference - position);
    sum += error;
    const double pwm =
        700.0 / 128.0 * error + 300.0 / 65536.0 * sum - 900.0 / 16.0 * counts * (position - last);
    last = position;
    EXPECT_NEAR(torque, torque_per_volt * pwm / 885.0 * 12.0, 1e-12 * std::abs(torque)) << k;
  }
}

TEST(OracleFirmware, ODrive) {
  Drive drive = of_torque();
  choose(drive, "odrive");
  set(drive, "controller.pos_gain", 20.0);
  set(drive, "controller.vel_gain", 0.16);
  set(drive, "controller.vel_integrator_gain", 0.32);
  EXPECT_TRUE(faults(drive).empty());
  const Conversion conversion = converted(drive);
  const auto& cascade = std::get<CascadeController>(conversion.controller.law);
  EXPECT_EQ(cascade.position, 20.0);
  EXPECT_DOUBLE_EQ(cascade.speed, 0.025464790894703257);
  EXPECT_DOUBLE_EQ(cascade.speed_integral, 0.050929581789406514);
  EXPECT_DOUBLE_EQ(cascade.tracking_time, 0.0125);  // 0.99 of the integral is left every 125 µs
  EXPECT_EQ(conversion.controller.shaft, GainShaft::motor);
  EXPECT_EQ(drive.sampling->period, 125e-6);
  // One turn of the motor is answered by 20 · 0.16 N m.
  const double turn_of_motor_at_load = turn / 8.0;
  EXPECT_NEAR(reduce(drive).controller.direct[0] * turn_of_motor_at_load, 8.0 * 20.0 * 0.16, 1e-12);
  drive.sensor.position = SensorPlace::both;
  EXPECT_EQ(converted(drive).controller.shaft, GainShaft::mixed);
}

TEST(OracleFirmware, Moteus) {
  Drive drive = of_torque();
  choose(drive, "moteus");
  set(drive, "controller.pid_position_kp", 4.0);
  set(drive, "controller.pid_position_ki", 1.0);
  set(drive, "controller.pid_position_kd", 0.05);
  set(drive, "controller.rotor_to_output_ratio", 0.125);
  EXPECT_TRUE(faults(drive).empty());
  const auto pid = std::get<PID>(converted(drive).controller.law);
  EXPECT_DOUBLE_EQ(pid.proportional, 0.009947183943243459);
  EXPECT_DOUBLE_EQ(pid.integral, 0.0024867959858108648);
  EXPECT_DOUBLE_EQ(pid.derivative, 0.00012433979929054323);
  EXPECT_DOUBLE_EQ(pid.tracking_time, 4.0);
  EXPECT_DOUBLE_EQ(drive.sampling->period, 1.0 / 30000.0);
  // With the ratio of the gearbox one turn of the output is answered by 4 N m at the output.
  const std::vector<PlacedGain> gains = placed_gains(drive);
  ASSERT_EQ(gains.size(), 3U);
  EXPECT_NEAR(gains[0].at_joint * turn, 4.0, 1e-14);
  EXPECT_NEAR(gains[2].at_joint * turn, 0.05, 1e-15);
  drive.sensor.position = SensorPlace::load;
  EXPECT_DOUBLE_EQ(std::get<PID>(converted(drive).controller.law).proportional,
                   0.07957747154594767);
  EXPECT_NEAR(placed_gains(drive)[0].at_joint * turn, 4.0, 1e-14);
}

TEST(OracleFirmware, SimpleFOCWithoutFilter) {
  Drive drive = of_volts();
  choose(drive, "simplefoc");
  set(drive, "sampling.period", 1e-3);
  set(drive, "controller.P_angle", 20.0);
  set(drive, "controller.PID_velocity_P", 0.5);
  set(drive, "controller.PID_velocity_I", 10.0);
  EXPECT_EQ(converted(drive).controller.law,
            decltype(Controller::law)(CascadeController{20.0, 0.5, 10.0, 0.05}));
  drive.motor = {.kind = TorqueControl{.torque_constant = 0.03}, .inertia = 1e-5};
  EXPECT_EQ(converted(drive).controller.law,
            decltype(Controller::law)(CascadeController{20.0, 0.015, 0.3, 0.05}));
  set(drive, "controller.tracking_time", 0.0);
  EXPECT_EQ(std::get<CascadeController>(converted(drive).controller.law).tracking_time, 0.0);
}

/// u = P (w − f) + I ∫(w − f), w = P_angle e, f = v/(Tf s + 1): the response to r, y and v at one
/// frequency.
TEST(OracleFirmware, SimpleFOCWithItsFilter) {
  constexpr double angle = 20.0;
  constexpr double proportional = 0.5;
  constexpr double filter = 0.005;
  for (const double integral : {0.0, 10.0}) {
    Drive drive = of_volts();
    choose(drive, "simplefoc");
    set(drive, "sampling.period", 1e-3);
    set(drive, "controller.P_angle", angle);
    set(drive, "controller.PID_velocity_P", proportional);
    set(drive, "controller.PID_velocity_I", integral);
    set(drive, "controller.LPF_velocity_Tf", filter);
    EXPECT_TRUE(faults(drive).empty());
    const auto linear = reduce(drive).controller;
    using Complex = std::complex<double>;
    const Complex s(0.0, 37.0);
    const Complex pi_part = proportional + integral / s;
    const std::array<Complex, 3> wanted = {angle * pi_part, -angle * pi_part,
                                           -pi_part / (filter * s + 1.0)};
    for (std::size_t input = 0; input < 3; ++input) {
      // The integral, if any, and the filter after it.
      const auto& A = linear.state_matrix;
      const auto& B = linear.input_matrix;
      const std::size_t last = linear.order() - 1;
      const Complex filtered = B[last][input] / (s - A[last][last]);
      Complex output = linear.output[last] * filtered + linear.direct[input];
      if (last == 1) output += linear.output[0] * (A[0][1] * filtered + B[0][input]) / s;
      EXPECT_EQ(last == 1, integral != 0.0);
      const double per_volt = refer_output(drive).torque;
      EXPECT_NEAR(std::abs(output / per_volt - wanted[input]), 0.0, 1e-12) << input;
    }
  }
}

// ---- what is lacking ----------------------------------------------------------------------------

std::vector<std::string> paths_at_fault(const Drive& drive) {
  std::vector<std::string> paths;
  for (const Fault& fault : faults(drive)) paths.push_back(fault.path);
  return paths;
}

using Paths = std::vector<std::string>;

TEST(Firmware, NamesWhatItsConversionLacks) {
  Drive drive = dynamixel(800.0, 0.0, 0.0);
  EXPECT_EQ(paths_at_fault(drive), Paths{});
  drive.motor.limit.reset();
  EXPECT_EQ(paths_at_fault(drive), Paths{"motor.voltage_limit"});
  drive.sampling.reset();
  EXPECT_EQ(paths_at_fault(drive), (Paths{"motor.voltage_limit", "sampling.period"}));
  drive = dynamixel(800.0, 0.0, 0.0);
  drive.motor.kind = TorqueControl{};
  EXPECT_EQ(paths_at_fault(drive), Paths{"controller.kind"});
  for (const char* word : {"odrive", "moteus"}) {
    Drive of_torque_gains = of_volts();
    choose(of_torque_gains, word);
    EXPECT_EQ(paths_at_fault(of_torque_gains), Paths{"controller.kind"}) << word;
  }
  Drive of_current = of_torque();
  choose(of_current, "simplefoc");
  set(of_current, "controller.PID_velocity_P", 0.5);
  EXPECT_EQ(paths_at_fault(of_current), (Paths{"motor.torque_constant", "sampling.period"}));
}

TEST(Firmware, RegistersAreNotNegative) {
  Drive drive = dynamixel(800.0, 0.0, 0.0);
  set(drive, "controller.position_d_gain", -1.0);
  EXPECT_EQ(paths_at_fault(drive), Paths{"controller.position_d_gain"});
}

// ---- the registry -------------------------------------------------------------------------------

TEST(Firmware, HasItsRegistersAndNoOtherKeys) {
  Drive drive = dynamixel(800.0, 0.0, 0.0);
  EXPECT_EQ(get(drive, "controller.position_p_gain"), 800.0);
  for (const char* path : {"controller.proportional", "controller.shaft", "controller.pos_gain",
                           "controller.filter"}) {
    EXPECT_THROW(set(drive, path, 1.0), InvalidInput) << path;
  }
  const Drive firmware = drive;
  choose(drive, "PID");
  EXPECT_FALSE(drive.controller.firmware);
  EXPECT_NO_THROW(set(drive, "controller.proportional", 1.0));
  EXPECT_NE(drive, firmware);
  choose(drive, "odrive");
  set(drive, "controller.tracking_time", 0.1);
  EXPECT_EQ(std::get<CascadeController>(converted(drive).controller.law).tracking_time, 0.1);
  EXPECT_EQ(drive.sampling->period, 1e-3);  // the drive has its own
}

TEST(Firmware, EveryOneStatesItsSource) {
  ASSERT_EQ(all_firmwares().size(), std::variant_size_v<Firmware>);
  const Parameter& kind = *find_parameter("controller.kind");
  for (const FirmwareFacts& facts : all_firmwares()) {
    EXPECT_GT(facts.source.rfind('.'), facts.source.rfind("; ")) << facts.source;  // an address
    Drive drive = of_volts();
    choose(drive, facts.word);
    EXPECT_EQ(all_firmwares()[drive.controller.firmware->index()].word, facts.word);
    EXPECT_EQ(kind.choices[std::get<Choice>(kind.slot(drive)).chosen(drive)], facts.word);
  }
}

/// The same drive typed in SI units reduces to the same numbers, bit for bit.
TEST(Firmware, IsTheDriveTypedInSIUnits) {
  const Drive registers = dynamixel(800.0, 50.0, 200.0);
  const Drive typed = without_registers(registers);
  EXPECT_FALSE(typed.controller.firmware);
  const auto one = reduce(registers).controller;
  const auto other = reduce(typed).controller;
  EXPECT_EQ(one.direct, other.direct);
  EXPECT_EQ(one.output, other.output);
  EXPECT_EQ(one.input_matrix, other.input_matrix);
  EXPECT_EQ(reduce(registers).torque_limit, reduce(typed).torque_limit);
}

}  // namespace
}  // namespace gearlash::firmware_test
