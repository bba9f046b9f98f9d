// Reads drives from TOML files.
#pragma once

#include <filesystem>
#include <string_view>

#include "gearlash/drive.hpp"

namespace gearlash {

/// Reads a file of at most 1 MiB. docs/drives.md has the keys. Tables of signals are files beside
/// it. Tolerances are read and ignored. Throws InvalidInput with every fault and its place.
[[nodiscard]] Drive read_drive(const std::filesystem::path& toml);

/// The same for text; tables are in `folder`.
[[nodiscard]] Drive parse_drive(std::string_view toml, const std::filesystem::path& folder = {});

}  // namespace gearlash
