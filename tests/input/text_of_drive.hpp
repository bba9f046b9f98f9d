// Drives read from text, and the faults of text that is refused.
#pragma once

#include <string>
#include <vector>

#include "gearlash/fault.hpp"
#include "input/drive_file.hpp"

namespace gearlash::test {

inline Drive drive_of_text(const std::string& text, const std::vector<Setting>& settings = {},
                           const std::string& file = "joint.toml") {
  return parse_drive(text, file, {}, settings).drive;
}

/// The faults, one line each; none if the text is taken.
inline std::vector<std::string> refusals_of_text(const std::string& text,
                                                 const std::vector<Setting>& settings = {},
                                                 const std::string& file = "joint.toml") {
  std::vector<std::string> lines;
  try {
    (void)drive_of_text(text, settings, file);
  } catch (const InvalidInput& refusal) {
    for (const Fault& fault : refusal.faults()) lines.push_back(to_string(fault));
  }
  return lines;
}

}  // namespace gearlash::test
