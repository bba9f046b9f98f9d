// The drive that a TOML file describes: controller, friction, contact, sensors, signals.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "analysis/design/toleranced_drive.hpp"
#include "gearlash/drive.hpp"
#include "input/servo_file.hpp"
#include "input/toml_document.hpp"
#include "model/drive.hpp"

namespace gearlash {

/// What a file says of a drive.
struct WrittenDrive {
  Drive drive;      ///< sound
  AngleUnit angle;  ///< in which the file gives the backlash
  /// Parameters with tolerances, in the order of the file; the drive has their nominal values.
  std::vector<ParameterTolerance> tolerances;
};

/// Reads a drive. The keys are in docs/drives.md; `settings` take the place of what the text says.
/// Tables of signals are files beside the text, in `folder`. Throws InvalidInput as parse_servo()
/// does; faults of settings are located at "--set".
WrittenDrive parse_drive(std::string_view toml, std::string_view source_name,
                         const std::filesystem::path& folder,
                         const std::vector<Setting>& settings = {});

/// The text with its settings applied, as parse_drive() reads it.
TomlDocument document_with(std::string_view toml, std::string_view source_name,
                           const std::vector<Setting>& settings);

/// "PATH=VALUE"; "PATH=none" takes a key, or "SECTION=none" a section, out of the file. Throws
/// InvalidInput for text without "=" and for a path of no parameter, with the nearest one.
Setting read_setting(const std::string& text);

struct DriveFile {
  drive::ReducedDrive drive{};  ///< sound, all referred to the load's shaft
  double gear_ratio = 1.0;      ///< motor turns per load turn
  AngleUnit backlash_unit;      ///< in which the file gives the backlash
  bool has_reference = false;   ///< there is a [reference]
  bool is_normalized = false;   ///< times are in units of 1/ω_n, all else likewise
};

/// A file is a servo's where the closed form answers for it (closed_form_servo()) and it has no
/// reference of its own; else a drive's.
using ServoOrDriveFile = std::variant<ServoFile, DriveFile>;

/// As parse_servo(), for either. Tables of signals are files beside the text, in `folder`. The keys
/// are in docs/drives.md.
ServoOrDriveFile parse_servo_or_drive(std::string_view toml, std::string_view source_name,
                                      const std::filesystem::path& folder,
                                      const std::vector<Setting>& settings = {});

/// As read_servo_file(), for either.
ServoOrDriveFile read_servo_or_drive_file(const std::filesystem::path& path,
                                          const std::vector<Setting>& settings = {});

/// The servo of 1960 that the drive is; nothing where it is none. Precondition: it is sound.
std::optional<ServoFile> servo_file_of(const WrittenDrive& written);

/// The drive that a servo is, in SI; without a natural frequency with one of 1 rad/s, and then with
/// inertias that add up to 1 kg m². Throws InvalidInput for a servo with a massless side or without
/// a gap, which no drive is.
DriveFile drive_file_of(const ServoFile& servo);

/// The same drive with its sensors on other shafts. An encoder keeps its steps a turn, so that one
/// on the motor reads finer by the gear ratio.
DriveFile with_sensor(DriveFile file, SensorPlace place);

/// "load", "motor", "both".
const char* name_of(SensorPlace place);
std::optional<SensorPlace> sensor_named(std::string_view name);

}  // namespace gearlash
