// Writes drives and answers as text.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <string_view>

#include "gearlash/answer.hpp"
#include "gearlash/drive.hpp"
#include "gearlash/tolerance.hpp"

namespace gearlash {

/// A file of the drive with all defaults filled in, in SI units. Numbers read back exactly.
[[nodiscard]] std::string to_toml(const Drive& drive);

/// The same with tolerances, as read_toleranced_drive() takes them. A file has one nominal value:
/// of a distribution about a value, or of lots, it is that of the distribution.
[[nodiscard]] std::string to_toml(const TolerancedDrive& drive);

/// The output of `gearlash limit-cycle --format json`.
[[nodiscard]] std::string to_json(const Drive& drive, const Answer& answer);

/// The answer in one line, as `gearlash limit-cycle` prints it, in the unit of angles of the drive:
/// "hunts: ±1.79 arcmin at 1.95 Hz (found from 20 starts)".
[[nodiscard]] std::string headline(const Drive& drive, const Answer& answer);

/// The report in full, as `gearlash limit-cycle` prints it.
[[nodiscard]] std::string to_text(const Drive& drive, const Answer& answer);

/// The answer in one line, in s.
std::ostream& operator<<(std::ostream& stream, const Answer& answer);

/// Writes a file that appears whole or not at all. Throws std::runtime_error if it cannot.
void save(const std::filesystem::path& path, std::string_view text);

}  // namespace gearlash
