// Drives read from text, the faults of text that is refused, and text with a part replaced.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "gearlash/input.hpp"
#include "question/faults_of.hpp"

namespace gearlash::test {

inline Drive drive_of_text(const std::string& text, const std::vector<Setting>& settings = {},
                           const std::string& file = "joint.toml") {
  return parse_drive(text, file, {}, settings).drive;
}

/// The faults, one line each; none if the text is taken.
inline std::vector<std::string> refusals_of_text(const std::string& text,
                                                 const std::vector<Setting>& settings = {},
                                                 const std::string& file = "joint.toml") {
  return faults_of([&] { (void)drive_of_text(text, settings, file); });
}

inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

}  // namespace gearlash::test
