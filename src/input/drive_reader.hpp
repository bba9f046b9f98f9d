// The one reader of drives: every key of a file is a parameter (model/parameters.hpp).
#pragma once

#include <filesystem>
#include <set>
#include <string>

#include "input/drive_file.hpp"
#include "input/section_reader.hpp"
#include "input/toml_document.hpp"

namespace gearlash {

/// What a file varies besides describing a drive: its section, and the paths that it varies.
struct Variation {
  std::string section = {};
  std::set<std::string> paths = {};
};

/// The drive; sound where nothing was found at fault. A file may not give what it varies, for which
/// stand-ins are returned; the backlash of the normal form is then 1 where it is left out.
WrittenDrive read_drive(const TomlDocument& document, Findings& findings,
                        const std::filesystem::path& folder, const Variation& variation = {});

}  // namespace gearlash
