#include "input/servo_file.hpp"

#include "input/servo_reader.hpp"
#include "input/text_file.hpp"
#include "input/toml_document.hpp"

namespace gearlash {

ServoFile parse_servo(std::string_view toml, std::string_view source_name) {
  const TomlDocument document(toml, source_name, largest_servo_file);
  Findings findings(document);
  ServoFile file = read_servo(document, findings);
  findings.require_none();
  return file;
}

ServoFile read_servo_file(const std::filesystem::path& path) {
  return parse_servo(read_text_file(path, largest_servo_file), path.string());
}

}  // namespace gearlash
