// A drive with its parameters, as the page's inputs need it.
#pragma once

#include <string>
#include <vector>

#include "input/drive_file.hpp"
#include "output/json_values.hpp"

namespace gearlash::web {

/// A drive as the page holds it: the text of a file, and what was changed since.
struct DriveText {
  std::string toml;
  std::string name;  ///< of the file, for the places of faults
  std::vector<Setting> settings;
};

/// From {"toml": …, "name": …, "settings": [[path, text], …]}.
DriveText drive_text_of(const Json& json);

/// Tables of signals are in `folder`. Throws InvalidInput with every fault.
WrittenDrive parse(const DriveText& text, const std::string& folder);

/// Every parameter of the drive: its value, as SI and as text in its author's unit, that unit, what
/// it means, and the range of its slider.
Json drive_reply(const DriveText& text, const WrittenDrive& written);

/// The drive as a file that reads back exactly.
Json file_reply(const WrittenDrive& written);

}  // namespace gearlash::web
