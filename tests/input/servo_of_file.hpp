// What a file's drive is to the closed form, for tests.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "gearlash/input.hpp"
#include "gearlash/units.hpp"
#include "model/proportional_servo.hpp"
#include "model/reduced_drive.hpp"

namespace gearlash {

struct ServoOfFile {
  NormalizedServo servo{};
  std::optional<double> natural_frequency{};  ///< as the file gives it, or of the drivetrain
  std::optional<Drivetrain> drivetrain{};     ///< of a drive with [motor]
  AngleUnit backlash_unit{};

  bool operator==(const ServoOfFile&) const = default;
};

inline std::optional<ServoOfFile> servo_of(const WrittenDrive& written) {
  const std::optional<ProportionalServo> closed = proportional_servo(written.drive);
  if (!closed) return std::nullopt;
  ServoOfFile found{.servo = closed->servo, .backlash_unit = written.drive.angle_unit};
  if (written.drive.servo) {
    found.natural_frequency = written.drive.servo->natural_frequency;
  } else {
    found.natural_frequency = closed->natural_frequency;
    found.drivetrain = referred_drivetrain(written.drive);
  }
  return found;
}

inline ServoOfFile parse_servo(std::string_view toml, std::string_view name = "s.toml") {
  return servo_of(parse_drive(toml, name, ".", {})).value();
}

inline WrittenDrive read_written_drive(const std::filesystem::path& path) {
  return parse_drive(read_text_file(path, largest_drive_file), path.string(), path.parent_path(),
                     {});
}

inline ServoOfFile read_servo(const std::filesystem::path& path) {
  return servo_of(read_written_drive(path)).value();
}

}  // namespace gearlash
