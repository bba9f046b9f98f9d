// The texts of a TOML file as their author wrote them.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>

namespace gearlash {

/// "motor.inertia" -> "0.61 oz in2", "reference.file" -> "steps.csv": the text values of all
/// sections. Empty for a pipe, which can be read only once, and for a file that cannot be read,
/// which its own reader reports.
std::map<std::string, std::string> written_texts(const std::filesystem::path& toml);
/// The same of a file's text; empty for one that is not TOML.
std::map<std::string, std::string> texts_written_in(std::string_view toml);

}  // namespace gearlash
