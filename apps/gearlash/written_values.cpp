#include "written_values.hpp"

#include <toml++/toml.h>

#include <system_error>

#include "input/units.hpp"

namespace gearlash::cli {

std::map<std::string, std::string> written_values(const std::filesystem::path& path) {
  std::map<std::string, std::string> values;
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return values;
  try {
    const toml::table file = toml::parse_file(path.string());
    for (const auto& [section, keys] : file) {
      const toml::table* table = keys.as_table();
      if (table == nullptr) continue;
      for (const auto& [key, value] : *table) {
        if (const auto* text = value.as_string()) {
          values[std::string(section.str()) + "." + std::string(key.str())] = shown(text->get());
        }
      }
    }
  } catch (const toml::parse_error&) {
    values.clear();  // changed since it was read: the conversions are printed without their origin
  }
  return values;
}

}  // namespace gearlash::cli
