// Drives from TOML files.
#pragma once

#include <filesystem>
#include <string_view>

#include "gearlash/drive.hpp"

namespace gearlash {

/// Reads a file of at most 1 MiB; the keys are in docs/drives.md, and tables of signals are files
/// beside it. Tolerances are read and left out. Throws InvalidInput with every fault and its place.
[[nodiscard]] Drive read_drive(const std::filesystem::path& toml);

/// The same of text; tables are in `folder`.
[[nodiscard]] Drive parse_drive(std::string_view toml, const std::filesystem::path& folder = {});

}  // namespace gearlash
