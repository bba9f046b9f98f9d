#include "input/named_files.hpp"

#include <optional>
#include <system_error>

#include "base/fault.hpp"
#include "input/drive_file.hpp"
#include "input/text_file.hpp"
#include "input/toml_document.hpp"

namespace gearlash {

std::vector<NamedFile> files_named_in(const std::filesystem::path& toml) {
  std::vector<NamedFile> files;
  std::error_code error;
  if (!std::filesystem::is_regular_file(toml, error)) return files;
  try {
    const TomlDocument document(read_text_file(toml, largest_drive_file), toml.string(),
                                largest_drive_file);
    for (const auto& [section, node] : document.root()) {
      const toml::table* table = node.as_table();
      if (table == nullptr) continue;
      const auto name = (*table)["file"].value<std::string>();
      if (!name || name->empty()) continue;
      files.push_back({std::string(section.str()) + ".file", toml.parent_path() / *name});
    }
  } catch (const InvalidInput&) {
    return {};
  }
  return files;
}

}  // namespace gearlash
