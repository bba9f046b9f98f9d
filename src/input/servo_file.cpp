#include "input/servo_file.hpp"

#include "input/drive_file.hpp"
#include "input/drive_reader.hpp"
#include "input/text_file.hpp"
#include "input/toml_document.hpp"
#include "model/reduced_drive.hpp"

namespace gearlash {
ServoFile parse_servo(std::string_view toml, std::string_view source_name,
                      const std::filesystem::path& folder, const std::vector<Setting>& settings) {
  const TomlDocument document = document_with(toml, source_name, settings);
  Findings findings(document);
  const WrittenDrive written = read_drive(document, findings, folder);
  findings.require_none();
  std::optional<ServoFile> file = servo_file_of(written);
  if (!file) {
    throw InvalidInput(
        {{"drive", "without a closed form", permitted_with_closed_form, std::string(source_name)}});
  }
  return *std::move(file);
}

ServoFile read_servo_file(const std::filesystem::path& path) {
  return parse_servo(read_text_file(path, largest_servo_file), path.string(), path.parent_path());
}

}  // namespace gearlash
