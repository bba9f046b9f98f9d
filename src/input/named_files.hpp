// The files that a TOML file names: tables of signals.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace gearlash {

struct NamedFile {
  std::string field;  ///< "reference.file"
  std::filesystem::path path;
};

/// Every text `file` of a section, as a path beside the TOML file. None of a pipe, which can be
/// read only once, and where the file cannot be read: what is wrong with it is for its own reader
/// to report.
std::vector<NamedFile> files_named_in(const std::filesystem::path& toml);

}  // namespace gearlash
