// The texts of a TOML file as their author wrote them.
#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace gearlash {

/// "motor.inertia" -> "0.61 oz in2", "reference.file" -> "steps.csv": every text value of a
/// section. Empty for a pipe, which can be read only once, and where the file cannot be read: its
/// own reader reports what is wrong with it.
std::map<std::string, std::string> written_texts(const std::filesystem::path& toml);

}  // namespace gearlash
