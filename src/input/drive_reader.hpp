// The reader of drives: every key of a file is a parameter (model/parameters.hpp).
#pragma once

#include <filesystem>
#include <set>
#include <string>

#include "gearlash/input.hpp"
#include "input/section_reader.hpp"
#include "input/toml_document.hpp"

namespace gearlash {

/// The part of a file that varies the drive: its section and the varied paths.
struct Variation {
  std::string section = {};
  std::set<std::string> paths = {};
};

/// Reads the drive, which is valid if no fault was found. A file must leave out the parameters that
/// it varies; the drive holds placeholders for them. The normal form's backlash may then be left
/// out too, and is 1.
WrittenDrive read_drive(const TomlDocument& document, Findings& findings,
                        const std::filesystem::path& folder, const Variation& variation = {},
                        BareNumbers bare_numbers = BareNumbers::refused);

}  // namespace gearlash
