// The drive that a TOML file describes: controller, friction, contact, sensors, signals.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gearlash/drive.hpp"
#include "gearlash/tolerance.hpp"
#include "input/units.hpp"

namespace gearlash {

/// What a file says of a drive.
struct WrittenDrive {
  Drive drive;      ///< sound
  AngleUnit angle;  ///< in which the file gives the backlash
  /// Parameters with tolerances, in the order of the file; the drive has their nominal values.
  std::vector<ParameterTolerance> tolerances;
};

/// One parameter by its path, as text: a number with its unit, a word, a TOML list.
struct Setting {
  std::string path;
  std::string text;
};

inline constexpr std::size_t largest_drive_file = 1024 * 1024;  ///< bytes

/// Reads TOML text of at most largest_drive_file bytes. The keys, their units and defaults are in
/// docs/drives.md. `source_name` is what error lines call the text; `settings` take the place of
/// what it says, and their faults are located at "--set". Tables of signals are files beside the
/// text, in `folder`.
///
/// Throws InvalidInput, and nothing else but std::bad_alloc. It lists every fault, in the order
/// of the file, each located at the value at fault, or at the header of the section where a key is
/// missing: unknown sections and keys (with the nearest known one), missing ones, values of another
/// type, units or dimension, values out of range. Text that is not TOML, not UTF-8 or too long is
/// one fault.
WrittenDrive parse_drive(std::string_view toml, std::string_view source_name,
                         const std::filesystem::path& folder,
                         const std::vector<Setting>& settings = {});

/// Whether the text gives the servo in its normal form: it has the section [servo]. Throws
/// InvalidInput for text that is not TOML.
bool has_normal_form(std::string_view toml, std::string_view source_name);

/// "PATH=VALUE"; "PATH=none" takes a key, or "SECTION=none" a section, out of the file. Throws
/// InvalidInput for text without "=" and for a path of no parameter, with the nearest one.
Setting read_setting(const std::string& text);

/// "load", "motor", "both".
const char* name_of(SensorPlace place);
std::optional<SensorPlace> sensor_named(std::string_view name);

}  // namespace gearlash
