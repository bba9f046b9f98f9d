// Registers of common motor firmwares, as their makers' tools show them.
#pragma once

#include <optional>
#include <variant>

namespace gearlash {

// A register is a number without a unit: the firmware's manual states its unit.
// docs/reference/drives.md has the conversions with their sources.
//
// tracking_time: s, ≥ 0, as that of PID and CascadeController; it stands for the firmware's own
// anti-windup, which has another form. 0: none. If it is not given, that of ODrive's decay, and the
// proportional gain over the integral one of the others.

/// ROBOTIS DYNAMIXEL X in Position Control Mode. Errors count 4096 a turn of the horn, the output
/// 885 for the supply voltage, which is Motor::limit of a motor driven by a voltage. The sums and
/// differences are from sample to sample, so that Sampling::period is a part of the conversion.
struct DynamixelX {
  double position_p_gain = 0.0;           ///< Position P Gain (84), 128 for 1, ≥ 0
  double position_i_gain = 0.0;           ///< Position I Gain (82), 65536 for 1 per sample, ≥ 0
  double position_d_gain = 0.0;           ///< Position D Gain (80), 16 for 1 sample, ≥ 0
  std::optional<double> tracking_time{};  ///< s, as of PID; that of the integral if not given

  bool operator==(const DynamixelX&) const = default;
};

/// ODrive, axis.controller.config, position control of a torque-controlled motor.
struct ODrive {
  double pos_gain = 0.0;                  ///< (turn/s)/turn, ≥ 0
  double vel_gain = 0.0;                  ///< N m/(turn/s), ≥ 0
  double vel_integrator_gain = 0.0;       ///< N m/((turn/s) s), ≥ 0
  std::optional<double> tracking_time{};  ///< s, as of PID; that of the integral if not given

  bool operator==(const ODrive&) const = default;
};

/// mjbots moteus, servo.pid_position, position mode of a torque-controlled motor.
struct Moteus {
  double kp = 0.0;  ///< N m per turn of the output, ≥ 0
  double ki = 0.0;  ///< N m/s per turn, ≥ 0
  double kd = 0.0;  ///< N m per turn/s, ≥ 0
  /// Output turns per rotor turn, as the firmware counts them, > 0. "Output" above is the shaft
  /// with the position sensor, if that is not the motor's.
  double rotor_to_output_ratio = 1.0;
  std::optional<double> tracking_time{};  ///< s, as of PID; that of the integral if not given

  bool operator==(const Moteus&) const = default;
};

/// SimpleFOC, angle control. Its output is V, or A for a torque-controlled motor.
struct SimpleFOC {
  double angle_p = 0.0;                   ///< P_angle.P, (rad/s)/rad, ≥ 0
  double velocity_p = 0.0;                ///< PID_velocity.P, output/(rad/s), ≥ 0
  double velocity_i = 0.0;                ///< PID_velocity.I, output/rad, ≥ 0
  double velocity_filter = 0.0;           ///< LPF_velocity.Tf, s, ≥ 0
  std::optional<double> tracking_time{};  ///< s, as of PID; that of the integral if not given

  bool operator==(const SimpleFOC&) const = default;
};

using Firmware = std::variant<DynamixelX, ODrive, Moteus, SimpleFOC>;

}  // namespace gearlash
