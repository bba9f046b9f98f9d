#include "model/firmware.hpp"

#include <numbers>

#include "base/overloaded.hpp"
#include "model/reduced_drive.hpp"

namespace gearlash {
namespace {

constexpr double turn = 2.0 * std::numbers::pi;  // rad

bool has_torque(const Drive& drive) {
  return std::holds_alternative<TorqueControl>(drive.motor.kind);
}

/// The shaft of the angles that the firmware counts. A torque is the motor's.
GainShaft counted_shaft(const Drive& drive) {
  if (drive.sensor.position == SensorPlace::motor) return GainShaft::motor;
  return has_torque(drive) ? GainShaft::mixed : GainShaft::load;
}

PIDTerms terms_of(double integral, double derivative) {
  if (integral == 0.0) return derivative == 0.0 ? PIDTerms::P : PIDTerms::PD;
  return derivative == 0.0 ? PIDTerms::PI : PIDTerms::PID;
}

/// The numbers that are not 0, in the unit of the motor's output.
class Gains {
 public:
  explicit Gains(const Drive& drive) : has_torque_(has_torque(drive)) {}

  void add(std::string_view name, double value, std::string_view volts, std::string_view torque) {
    if (value != 0.0) list_.push_back({name, value, has_torque_ ? torque : volts});
  }
  void add_proportional(std::string_view name, double value) {
    add(name, value, "V/rad", "N m/rad");
  }
  void add_integral(std::string_view name, double value) {
    add(name, value, "V/(rad s)", "N m/(rad s)");
  }
  void add_speed(std::string_view name, double value) { add(name, value, "V s/rad", "N m s/rad"); }
  std::vector<ConvertedGain> list() && { return std::move(list_); }

 private:
  bool has_torque_;
  std::vector<ConvertedGain> list_;
};

/// Of an anti-windup that is not given: the time constant of the integral, as is usual.
double integral_time(double proportional, double integral) {
  return integral == 0.0 ? 0.0 : proportional / integral;
}

Conversion pid_conversion(const Drive& drive, PID pid, GainShaft shaft) {
  pid.terms = terms_of(pid.integral, pid.derivative);
  if (pid.integral == 0.0) pid.tracking_time = 0.0;
  Gains gains(drive);
  gains.add_proportional("proportional", pid.proportional);
  gains.add_integral("integral", pid.integral);
  gains.add_speed("derivative", pid.derivative);
  gains.add("anti-windup time", pid.tracking_time, "s", "s");
  return {{.law = pid, .shaft = shaft}, std::move(gains).list()};
}

Conversion cascade_conversion(const Drive& drive, const CascadeController& cascade,
                              GainShaft shaft) {
  Gains gains(drive);
  gains.add("position", cascade.position, "1/s", "1/s");
  gains.add_speed("speed", cascade.speed);
  gains.add_proportional("speed integral", cascade.speed_integral);
  gains.add("anti-windup time", cascade.speed_integral == 0.0 ? 0.0 : cascade.tracking_time, "s",
            "s");
  gains.add("speed filter", cascade.filter, "s", "s");
  return {{.law = cascade, .shaft = shaft}, std::move(gains).list()};
}

Conversion convert(const DynamixelX& registers, const Drive& drive) {
  constexpr double counts = 4096.0 / turn;  // of Present Position (132), per rad of the horn
  constexpr double full = 885.0;            // PWM Limit (36): all of the supply voltage
  const double volts = drive.motor.limit.value_or(full) / full;
  const double period = drive.sampling ? drive.sampling->period : 1.0;
  const double gain = volts * counts;
  PID pid{.proportional = registers.position_p_gain / 128.0 * gain,
          .integral = registers.position_i_gain / 65536.0 * gain / period,
          .derivative = registers.position_d_gain / 16.0 * gain * period,
          .derivative_of_speed = true};
  pid.tracking_time =
      registers.tracking_time.value_or(integral_time(pid.proportional, pid.integral));
  return pid_conversion(drive, pid, GainShaft::load);
}

Conversion convert(const ODrive& registers, const Drive& drive) {
  constexpr double decay = 125e-6 / 0.01;  // s: a hundredth of the integral a sample, at the limit
  return cascade_conversion(drive,
                            {.position = registers.pos_gain,
                             .speed = registers.vel_gain / turn,
                             .speed_integral = registers.vel_integrator_gain / turn,
                             .tracking_time = registers.tracking_time.value_or(decay)},
                            counted_shaft(drive));
}

Conversion convert(const Moteus& registers, const Drive& drive) {
  const double ratio = registers.rotor_to_output_ratio;
  const double counted = counted_shaft(drive) == GainShaft::motor ? ratio : 1.0;
  const double gain = ratio * counted / turn;
  return pid_conversion(
      drive,
      {.proportional = gain * registers.kp,
       .integral = gain * registers.ki,
       .derivative = gain * registers.kd,
       .tracking_time = registers.tracking_time.value_or(integral_time(registers.kp, registers.ki)),
       .derivative_of_speed = true},
      counted_shaft(drive));
}

Conversion convert(const SimpleFOC& registers, const Drive& drive) {
  const double output = has_torque(drive) ? torque_constant_of(drive.motor).value_or(1.0) : 1.0;
  return cascade_conversion(drive,
                            {.position = registers.angle_p,
                             .speed = output * registers.velocity_p,
                             .speed_integral = output * registers.velocity_i,
                             .tracking_time = registers.tracking_time.value_or(
                                 integral_time(registers.velocity_p, registers.velocity_i)),
                             .filter = registers.velocity_filter},
                            counted_shaft(drive));
}

constexpr char of_kind[] = "controller.kind";

std::string word_of(const Firmware& firmware) {
  return std::string(all_firmwares()[firmware.index()].word);
}

/// A firmware whose output is a torque drives a torque-controlled motor, one whose output is a
/// share of the supply any other; SimpleFOC either.
std::vector<Fault> faults_of_motor(const Firmware& firmware, const Drive& drive) {
  const bool is_share = std::holds_alternative<DynamixelX>(firmware);
  const bool is_current = std::holds_alternative<SimpleFOC>(firmware);
  if (is_current) {
    if (!has_torque(drive) || torque_constant_of(drive.motor)) return {};
    return {{"motor.torque_constant", "",
             "must be given: the output of simplefoc for a torque-controlled motor is a current"}};
  }
  if (is_share && has_torque(drive)) {
    return {{of_kind, word_of(firmware),
             "must drive its motor by a voltage, which a torque-controlled motor is not"}};
  }
  if (is_share && !drive.motor.limit) {
    return {{"motor.voltage_limit", "",
             "must be given: the supply voltage, of which the output of dynamixel-x is a share"}};
  }
  if (!is_share && !has_torque(drive)) {
    return {{of_kind, word_of(firmware),
             "must control a torque-controlled motor: its gains are torques"}};
  }
  return {};
}

}  // namespace

const std::vector<FirmwareFacts>& all_firmwares() {
  static const std::vector<FirmwareFacts> all = {
      {"dynamixel-x", "DYNAMIXEL X",
       "ROBOTIS e-Manual, DYNAMIXEL X, Position PID Gain (80, 82, 84), Goal Position (116) and PWM "
       "Limit (36); emanual.robotis.com",
       "the feedforward gains, the profile, and a PWM Limit or Goal PWM below 885; in place of the "
       "anti-windup, whose gain is not published, there is one by back-calculation"},
      {"odrive", "ODrive",
       "ODrive documentation, Control Structure and Tuning; docs.odriverobotics.com",
       "vel_limit, the filter of the encoder (encoder.config.bandwidth) and gain scheduling; the "
       "decay of the integral at the torque limit is an anti-windup by back-calculation",
       Sampling{.period = 125e-6, .method = Discretization::forward}},
      {"moteus", "moteus",
       "moteus reference, servo.pid_position and Theory of Operation; mjbots.github.io/moteus",
       "the filter of the encoder, iratelimit and the limits of trajectories; in place of ilimit "
       "there is an anti-windup by back-calculation",
       Sampling{.period = 1.0 / 30000.0, .method = Discretization::backward}},
      {"simplefoc", "SimpleFOC",
       "SimpleFOC documentation, Cascade position control loop, Velocity control loop and Low-pass "
       "velocity filter; docs.simplefoc.com",
       "velocity_limit, output_ramp, LPF_angle and the derivative terms; the clamping of the "
       "integral at its limit is an anti-windup by back-calculation"}};
  return all;
}

const std::vector<RefusedFirmware>& refused_firmwares() {
  static const std::vector<RefusedFirmware> all = {
      {"feetech-sts",
       "must be a law with its gains in SI units: the published memory table of Feetech's STS "
       "servos lists P, D and I coefficients without a unit, and no public manual states how they "
       "convert"}};
  return all;
}

Conversion converted(const Drive& drive) {
  return std::visit([&](const auto& registers) { return convert(registers, drive); },
                    *drive.controller.firmware);
}

Drive without_registers(const Drive& drive) {
  Drive plain = drive;
  if (drive.controller.firmware) plain.controller = converted(drive).controller;
  return plain;
}

std::vector<Fault> firmware_faults(const Drive& drive) {
  if (drive.servo || !drive.controller.firmware) return {};
  std::vector<Fault> found = faults_of_motor(*drive.controller.firmware, drive);
  if (!drive.sampling) {
    found.push_back({"sampling.period", "",
                     "must be given beside " + word_of(*drive.controller.firmware) +
                         ", which is sampled: its manual does not state the period"});
  }
  return found;
}

}  // namespace gearlash
