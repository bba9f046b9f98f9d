// A firmware's registers converted to a controller in SI units, with the source of each.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "gearlash/drive.hpp"

namespace gearlash {

/// What the makers state, and what of it the model leaves out. Texts are of static storage.
struct FirmwareFacts {
  std::string_view word;      ///< "odrive", of controller.kind
  std::string_view name;      ///< "ODrive"
  std::string_view source;    ///< title and section of the manual, with its address
  std::string_view left_out;  ///< what the firmware does besides
  /// The sampling that the manual states; empty if it states none.
  std::optional<Sampling> sampling{};
};

/// In the order of the alternatives of Firmware.
const std::vector<FirmwareFacts>& all_firmwares();

/// Firmwares whose registers cannot be converted: their words, and why not.
struct RefusedFirmware {
  std::string_view word;
  std::string_view reason;  ///< "must be …"
};
const std::vector<RefusedFirmware>& refused_firmwares();

/// One number of the converted controller.
struct ConvertedGain {
  std::string_view name;  ///< "speed integral"
  double value = 0.0;     ///< SI
  std::string_view unit;
};

/// The controller that the registers are.
struct Conversion {
  Controller controller{};             ///< without a firmware
  std::vector<ConvertedGain> gains{};  ///< in the order of the registers; without those that are 0
};

/// Converts the registers of `drive.controller`, with the constants of its motor, its sampling and
/// its sensor. A missing constant counts as 1; see firmware_faults(). Precondition: it has a
/// firmware.
///
/// S: volts per unit of the output (1/885 of Motor::limit), c = 4096/2π, T: Sampling::period,
/// r: rotor_to_output_ratio with the sensor on the motor, else 1, R = rotor_to_output_ratio,
/// k: torque constant, or 1 for a motor driven by a voltage. With e, v and integrals in rad:
///   DYNAMIXEL X  S c (P/128 e + I/65536 ∫e dt/T − D/16 T v)
///   ODrive       w = pos_gain e;  (vel_gain (w − v) + vel_integrator_gain ∫(w − v) dt)/2π
///   moteus       R r (kp e + ki ∫e dt − kd v)/2π
///   SimpleFOC    w = P_angle e;  k (P (w − f) + I ∫(w − f) dt),  f = v/(Tf s + 1)
/// An anti-windup that is not given has 12.5 ms of ODrive, else the time constant of the integral.
Conversion converted(const Drive& drive);

/// The same drive with that controller; any drive without a firmware unchanged.
Drive without_registers(const Drive& drive);

/// What the conversion lacks.
std::vector<Fault> firmware_faults(const Drive& drive);

}  // namespace gearlash
