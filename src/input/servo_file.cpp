#include "input/servo_file.hpp"

#include "input/drive_file.hpp"
#include "input/drive_reader.hpp"
#include "input/text_file.hpp"
#include "input/toml_document.hpp"

namespace gearlash {
namespace {

/// "gearbox.backlash.min" is found at "gearbox.backlash".
std::string name_in_file(const std::string& field) {
  if (field.starts_with("servo.restitution")) return "contact.restitution";
  const std::size_t second = field.find('.', field.find('.') + 1);
  return field.substr(0, second);
}

}  // namespace

ServoFile parse_servo(std::string_view toml, std::string_view source_name,
                      const std::filesystem::path& folder, const std::vector<Setting>& settings) {
  const TomlDocument document = document_with(toml, source_name, settings);
  Findings findings(document);
  const WrittenDrive written = read_drive(document, findings, folder);
  findings.require_none();
  std::optional<ServoFile> file = servo_file_of(written);
  if (!file) {
    throw InvalidInput(
        {{"drive", "not a servo of 1960",
          "must have a closed-form answer for this: proportional control of the load's position, "
          "continuous, exact and unlimited; rigid faces; no dry friction",
          std::string(source_name)}});
  }
  if (!file->varied.empty()) {
    TolerancedDrive toleranced{.nominal = file->servo,
                               .natural_frequency = file->natural_frequency.value_or(1.0),
                               .varied = file->varied};
    if (file->datasheet) toleranced.nominal = *file->datasheet;
    findings.take(validate(toleranced), &name_in_file, {1, 1});
    findings.require_none();
  }
  return *std::move(file);
}

ServoFile read_servo_file(const std::filesystem::path& path) {
  return parse_servo(read_text_file(path, largest_servo_file), path.string(), path.parent_path());
}

}  // namespace gearlash
