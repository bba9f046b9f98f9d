// The drive that a TOML file describes: controller, friction, contact, sensors, signals.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "input/servo_file.hpp"
#include "model/drive.hpp"

namespace gearlash {

struct DriveFile {
  drive::Drive drive;          ///< sound, all referred to the load's shaft
  double gear_ratio = 1.0;     ///< motor turns per load turn
  AngleUnit backlash_unit;     ///< in which the file gives the backlash
  bool has_reference = false;  ///< there is a [reference]
  bool is_normalized = false;  ///< times are in units of 1/ω_n, all else likewise
};

/// A file is a drive's where it has what the proportional servo of parse_servo() has not: a section
/// [controller], [sensor], [sampling], [reference] or [load_torque], dry friction, a limit of the
/// motor, faces that give, a motor of kind "torque-controlled", a position sensor on the motor.
using ServoOrDriveFile = std::variant<ServoFile, DriveFile>;

/// As parse_servo(), for either. Tables of signals are files beside the text, in `folder`. The keys
/// are in docs/drives.md.
ServoOrDriveFile parse_servo_or_drive(std::string_view toml, std::string_view source_name,
                                      const std::filesystem::path& folder);

/// As read_servo_file(), for either.
ServoOrDriveFile read_servo_or_drive_file(const std::filesystem::path& path);

/// The drive that a servo is, in SI; without a natural frequency with one of 1 rad/s, and then with
/// inertias that add up to 1 kg m². Throws InvalidInput for a servo with a massless side or without
/// a gap, which no drive is.
DriveFile drive_file_of(const ServoFile& servo);

/// Which shafts are measured.
enum class SensorPlace {
  load,
  motor,
  both  ///< the load's position and the motor's speed
};

/// The same drive with its sensors on other shafts. An encoder keeps its steps a turn, so that one
/// on the motor reads finer by the gear ratio.
DriveFile with_sensor(DriveFile file, SensorPlace place);

/// "load", "motor", "both".
const char* name_of(SensorPlace place);
std::optional<SensorPlace> sensor_named(std::string_view name);

}  // namespace gearlash
