// Reading the sections of a TOML file that describe a drive.
#pragma once

#include <filesystem>

#include "gearlash/io/drive_file.hpp"
#include "section_reader.hpp"
#include "toml_document.hpp"

namespace gearlash {

/// Whether it has what a servo file has not (drive_file.hpp).
bool describes_drive(const TomlDocument& document);

/// The drive; sound where nothing was found at fault.
DriveFile read_drive(const TomlDocument& document, Findings& findings,
                     const std::filesystem::path& folder);

}  // namespace gearlash
