// The servo that a TOML file describes: a data sheet with units, or the normalised numbers.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/fault.hpp"
#include "model/drivetrain.hpp"
#include "model/normalized_servo.hpp"

namespace gearlash {

/// The unit in which an author thinks of angles.
struct AngleUnit {
  std::string name = "rad";  ///< as written: "arcmin", "deg", "mrad", …
  double radians = 1.0;      ///< one of it, > 0

  /// `angle` (rad) in this unit.
  double from_radians(double angle) const { return angle / radians; }

  bool operator==(const AngleUnit&) const = default;
};

/// Either form of file ends in a normalised servo.
struct ServoFile {
  NormalizedServo servo{};                    ///< sound: validate(servo) is empty
  std::optional<double> natural_frequency{};  ///< ω_n, rad/s: of the drivetrain, or as [servo] says
  std::optional<Drivetrain> drivetrain{};     ///< of a drive with [motor]
  AngleUnit backlash_unit{};                  ///< in which the file gives the backlash

  bool operator==(const ServoFile&) const = default;
};

/// One parameter by its path, as text: a number with its unit, a word, a TOML list.
struct Setting {
  std::string path;
  std::string text;
};

inline constexpr std::size_t largest_servo_file = 1024 * 1024;  ///< bytes

/// Reads TOML text of at most largest_servo_file bytes. The keys, their units and defaults are in
/// docs/drives.md. `source_name` is what error lines call the text; `settings` take the place of
/// what it says, and their faults are located at "--set".
///
/// Throws InvalidInput, and nothing else but std::bad_alloc. It lists every fault, in the order
/// of the file, each located at the value at fault, or at the header of the section where a key is
/// missing: unknown sections and keys (with the nearest known one), missing ones, values of another
/// type, units or dimension, values out of range. Text that is not TOML, not UTF-8 or too long is
/// one fault.
ServoFile parse_servo(std::string_view toml, std::string_view source_name,
                      const std::filesystem::path& folder = {},
                      const std::vector<Setting>& settings = {});

/// parse_servo of what the file holds, read no further than the size limit. A file that is missing,
/// unreadable or a directory is an InvalidInput too.
ServoFile read_servo_file(const std::filesystem::path& path);

}  // namespace gearlash
