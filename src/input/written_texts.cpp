#include "input/written_texts.hpp"

#include <system_error>

#include "base/fault.hpp"
#include "input/drive_file.hpp"
#include "input/text_file.hpp"
#include "input/toml_document.hpp"

namespace gearlash {

std::map<std::string, std::string> texts_written_in(std::string_view toml) {
  std::map<std::string, std::string> texts;
  try {
    const TomlDocument document(toml, "", largest_drive_file);
    for (const auto& [section, node] : document.root()) {
      const toml::table* table = node.as_table();
      if (table == nullptr) continue;
      for (const auto& [key, value] : *table) {
        const auto* written = value.as_string();
        if (written == nullptr) continue;
        texts[std::string(section.str()) + "." + std::string(key.str())] = written->get();
      }
    }
  } catch (const InvalidInput&) {
    return {};
  }
  return texts;
}

std::map<std::string, std::string> written_texts(const std::filesystem::path& toml) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(toml, error)) return {};
  try {
    return texts_written_in(read_text_file(toml, largest_drive_file));
  } catch (const InvalidInput&) {
    return {};
  }
}

}  // namespace gearlash
