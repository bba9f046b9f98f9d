// The values of a data sheet as their author wrote them.
#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace gearlash::cli {

/// "motor.inertia" → "0.61 oz in2" for every text value of a file that parse_drive() accepts.
/// Empty where the file cannot be read a second time (a pipe).
std::map<std::string, std::string> written_values(const std::filesystem::path& path);

}  // namespace gearlash::cli
