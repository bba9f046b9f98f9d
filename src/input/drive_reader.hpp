// Reading the sections of a TOML file that describe a drive.
#pragma once

#include <array>
#include <filesystem>
#include <string_view>

#include "input/drive_file.hpp"
#include "input/section_reader.hpp"
#include "input/toml_document.hpp"

namespace gearlash {

/// Sections that no servo file has.
inline constexpr std::array<std::string_view, 5> drive_sections = {
    "controller", "sensor", "sampling", "reference", "load_torque"};

/// Whether it has what a servo file has not (drive_file.hpp).
bool describes_drive(const TomlDocument& document);

/// The drive; sound where nothing was found at fault.
DriveFile read_drive(const TomlDocument& document, Findings& findings,
                     const std::filesystem::path& folder);

}  // namespace gearlash
