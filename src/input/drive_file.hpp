// The drive that a TOML file describes: controller, friction, contact, sensors, signals.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "gearlash/drive.hpp"
#include "gearlash/tolerance.hpp"
#include "input/units.hpp"

namespace gearlash {

/// The contents of a drive file.
struct WrittenDrive {
  Drive drive;  ///< valid
  /// Parameters with tolerances, in the order of the file; the drive holds their nominal values.
  std::vector<ParameterTolerance> tolerances;
  std::string text{};  ///< TOML, of parse_drive_by_form()
  /// "motor.inertia" -> "0.61 oz in2", "reference.file" -> "steps.csv": the text values of all
  /// sections, without settings.
  std::map<std::string, std::string> texts{};
};

/// One parameter's path and its value as text: a number with its unit, a word or a TOML list.
struct Setting {
  std::string path;
  std::string text;
};

/// Whether numbers without a unit are taken, in SI, where a unit belongs: from a program, whose
/// numbers are in SI and whose text may be of any length. In a file they are a fault.
enum class BareNumbers : bool { refused, in_si };

inline constexpr std::size_t largest_drive_file = 1024 * 1024;  ///< bytes

/// Reads TOML text of at most largest_drive_file bytes. docs/reference/drives.md lists the keys,
/// their units and defaults. Error lines call the text `source_name`. `settings` replace values of
/// the text; their faults are located at "--set". Signal tables are read from files in `folder`.
///
/// Throws only InvalidInput and std::bad_alloc. InvalidInput lists every fault in the order of the
/// file: unknown sections and keys (with the nearest known one), missing ones, and values of the
/// wrong type, unit, dimension or range. Each fault is located at the value at fault; a missing key
/// is located at its section's header. Text that is not TOML, not UTF-8 or too long counts as one
/// fault.
WrittenDrive parse_drive(std::string_view toml, std::string_view source_name,
                         const std::filesystem::path& folder,
                         const std::vector<Setting>& settings = {},
                         BareNumbers bare_numbers = BareNumbers::refused);
/// The same with settings by whether the text gives the servo in its normal form, that is, has the
/// section [servo].
using SettingsOfForm = std::function<std::vector<Setting>(bool is_normal_form)>;
WrittenDrive parse_drive_by_form(std::string_view toml, std::string_view source_name,
                                 const std::filesystem::path& folder,
                                 const SettingsOfForm& settings);

/// Reads "PATH=VALUE". "PATH=none" removes a key, "SECTION=none" a section. Throws InvalidInput for
/// text without "=", and for an unknown path, with the nearest known one.
Setting read_setting(const std::string& text);

/// "load", "motor", "both".
const char* name_of(SensorPlace place);

}  // namespace gearlash
