// Reads drives from TOML files, and targets from text.
#pragma once

#include <filesystem>
#include <string_view>

#include "gearlash/design.hpp"
#include "gearlash/drive.hpp"
#include "gearlash/tolerance.hpp"

namespace gearlash {

/// Reads a file of at most 1 MiB. docs/reference/drives.md has the keys. Tables of signals are
/// files beside it. Tolerances are left out. Throws InvalidInput with every fault and its place.
[[nodiscard]] Drive read_drive(const std::filesystem::path& toml);

/// The same for text; tables are in `folder`.
[[nodiscard]] Drive parse_drive(std::string_view toml, const std::filesystem::path& folder = {});

/// The drive with its tolerances, in the order of the file.
[[nodiscard]] TolerancedDrive read_toleranced_drive(const std::filesystem::path& toml);

/// A target as it is typed: "no-hunting", "amplitude <= 1 arcmin and frequency >= 5 Hz". Conditions
/// are joined by "and". Quantities are amplitude (a bare number is in radians), frequency ("5 Hz",
/// "30 rad/s"), period and growth-at-rest; < is as good as <=. Throws InvalidInput, naming
/// "target", with all that is wrong: unknown quantities, wrong units, contradictions, and times
/// asked of a normal form without a natural frequency.
[[nodiscard]] Target parse_target(std::string_view text, const Drive& drive);

}  // namespace gearlash
