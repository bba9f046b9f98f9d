#include "input/drive_file.hpp"

#include <algorithm>
#include <cmath>

#include "gearlash/input.hpp"
#include "input/drive_reader.hpp"
#include "input/text_file.hpp"
#include "input/toml_document.hpp"
#include "model/parameters.hpp"
#include "model/proportional_servo.hpp"
#include "model/reduced_drive.hpp"

namespace gearlash {
namespace {

/// The drivetrain of a data sheet, but for what options have changed of the servo: that is in its
/// normalised numbers. Without one of total inertia 1.
Drivetrain drivetrain_of(const ServoFile& file) {
  const NormalizedServo& servo = file.servo;
  if (file.drivetrain && normalize(*file.drivetrain) == servo) return *file.drivetrain;
  const double frequency = file.natural_frequency.value_or(1.0);
  Drivetrain drivetrain;
  drivetrain.stiffness = file.drivetrain ? file.drivetrain->stiffness : frequency * frequency;
  const double inertia = drivetrain.stiffness / (frequency * frequency);
  const double friction = 2.0 * servo.damping * frequency * inertia;
  drivetrain.motor_inertia = inertia / (1.0 + servo.inertia_ratio);
  const double ratio = servo.inertia_ratio;
  drivetrain.load_inertia = std::isinf(ratio) ? inertia : inertia * (ratio / (1.0 + ratio));
  drivetrain.motor_friction = friction * (1.0 - servo.friction_ratio);
  drivetrain.load_friction = friction * servo.friction_ratio;
  drivetrain.backlash = servo.backlash;
  drivetrain.restitution = servo.restitution;
  drivetrain.sensor = servo.sensor;
  return drivetrain;
}

/// A TOML list, "[1, 2]"; all else is text, which the reader of the key takes: "30 arcmin", "0.25".
toml::table value_of(const std::string& text) {
  try {
    toml::table table = toml::parse("value = " + text);
    if (table.size() == 1 && table["value"].is_array()) return table;
  } catch (const toml::parse_error&) {  // then it is text
  }
  toml::table table;
  table.insert("value", text);
  return table;
}

constexpr std::string_view nothing = "none";

bool is_section(std::string_view name) {
  const std::vector<Section>& sections = all_sections();
  return std::any_of(sections.begin(), sections.end(),
                     [&](const Section& section) { return section.name == name; });
}

/// A section, or a key by whatever name it has.
void take_out(TomlDocument& document, const std::string& path) {
  if (is_section(path)) return document.remove_section(path);
  const Parameter& parameter = *find_parameter(path);
  document.remove(parameter.path);
  for (const OtherForm& form : parameter.other_forms) document.remove(form.path);
}

/// In the place of what the document says of that parameter, by whatever name.
void apply(TomlDocument& document, const Setting& setting) {
  if (setting.text == nothing) return take_out(document, setting.path);
  const Parameter& parameter = *find_parameter(setting.path);
  std::string place = setting.path;
  const auto is_inverse = [&](const OtherForm& form) {
    return form.dimension != nullptr && form.path == setting.path;
  };
  const bool is_direct =
      std::none_of(parameter.other_forms.begin(), parameter.other_forms.end(), is_inverse);
  const auto take_out = [&](std::string_view path, bool has_same_meaning) {
    if (document.remove(path) && has_same_meaning && is_direct) place = path;
  };
  take_out(parameter.path, true);
  for (const OtherForm& form : parameter.other_forms) {
    take_out(form.path, form.dimension == nullptr);
  }
  document.set(place, *value_of(setting.text).get("value"));
}

}  // namespace

TomlDocument document_with(std::string_view toml, std::string_view source_name,
                           const std::vector<Setting>& settings) {
  TomlDocument document(toml, source_name, largest_servo_file);
  for (const Setting& setting : settings) apply(document, setting);
  return document;
}

WrittenDrive parse_drive(std::string_view toml, std::string_view source_name,
                         const std::filesystem::path& folder,
                         const std::vector<Setting>& settings) {
  const TomlDocument document = document_with(toml, source_name, settings);
  Findings findings(document);
  WrittenDrive written = read_drive(document, findings, folder);
  findings.require_none();
  return written;
}

Setting read_setting(const std::string& text) {
  const std::size_t sign = text.find('=');
  if (sign == std::string::npos) {
    throw InvalidInput(
        {{"--set", shown(text), "must be PATH=VALUE, such as gearbox.ratio=50", ""}});
  }
  Setting setting{text.substr(0, sign), text.substr(sign + 1)};
  const bool is_without = setting.text == nothing && is_section(setting.path);
  if (!is_without && find_parameter(setting.path) == nullptr) {
    std::vector<std::string> paths;
    for (const Parameter& parameter : all_parameters_of_drives()) {
      paths.emplace_back(parameter.path);
      for (const OtherForm& form : parameter.other_forms) paths.emplace_back(form.path);
    }
    throw InvalidInput({{"--set", shown(setting.path),
                         "must be a parameter of a drive" + guess_of(paths, setting.path), ""}});
  }
  return setting;
}

std::optional<ServoFile> servo_file_of(const WrittenDrive& written) {
  const Drive& drive = written.drive;
  const std::optional<ClosedFormServo> closed = closed_form_servo(drive);
  if (!closed) return std::nullopt;
  ServoFile file{.servo = closed->servo, .backlash_unit = written.angle};
  if (drive.servo) {
    file.natural_frequency = drive.servo->natural_frequency;
  } else {
    file.natural_frequency = closed->natural_frequency;
    file.drivetrain = referred_drivetrain(drive);
  }
  return file;
}

ServoOrDriveFile parse_servo_or_drive(std::string_view toml, std::string_view source_name,
                                      const std::filesystem::path& folder,
                                      const std::vector<Setting>& settings) {
  const WrittenDrive written = parse_drive(toml, source_name, folder, settings);
  const Drive& drive = written.drive;
  // A side without inertia, or no gap, is the closed form's alone.
  const bool has_signals = drive.reference || drive.load_torque;
  if (!has_signals || !drive::validate(reduce(drive)).empty()) {
    if (std::optional<ServoFile> servo = servo_file_of(written)) return *std::move(servo);
  }
  return DriveFile{.drive = reduce(drive),
                   .gear_ratio = drive.gearbox.ratio,
                   .backlash_unit = written.angle,
                   .has_reference = drive.reference.has_value(),
                   .is_normalized = drive.servo && !drive.servo->natural_frequency};
}

ServoOrDriveFile read_servo_or_drive_file(const std::filesystem::path& path,
                                          const std::vector<Setting>& settings) {
  return parse_servo_or_drive(read_text_file(path, largest_servo_file), path.string(),
                              path.parent_path(), settings);
}

DriveFile drive_file_of(const ServoFile& servo) {
  DriveFile file;
  file.drive = drive::drive_of(drivetrain_of(servo));
  file.backlash_unit = servo.backlash_unit;
  file.is_normalized = !servo.natural_frequency;
  require_none(drive::validate(file.drive));
  return file;
}

DriveFile with_sensor(DriveFile file, SensorPlace place) {
  const auto put = [&](double& share, double& resolution, double new_share) {
    // A turn of the motor is less at the load.
    if (share != new_share)
      resolution *= new_share == 1.0 ? file.gear_ratio : 1.0 / file.gear_ratio;
    share = new_share;
  };
  drive::Sensing& sensing = file.drive.sensing;
  put(sensing.load_share_of_position, sensing.resolution, place == SensorPlace::motor ? 0.0 : 1.0);
  put(sensing.load_share_of_speed, sensing.resolution_of_speed,
      place == SensorPlace::load ? 1.0 : 0.0);
  return file;
}

const char* name_of(SensorPlace place) {
  switch (place) {
    case SensorPlace::load:
      return "load";
    case SensorPlace::motor:
      return "motor";
    case SensorPlace::both:
      return "both";
  }
  return "";
}

std::optional<SensorPlace> sensor_named(std::string_view name) {
  for (const SensorPlace place : {SensorPlace::load, SensorPlace::motor, SensorPlace::both}) {
    if (name == name_of(place)) return place;
  }
  return std::nullopt;
}

Drive read_drive(const std::filesystem::path& toml) {
  return parse_drive(read_text_file(toml, largest_servo_file), toml.string(), toml.parent_path(),
                     {})
      .drive;
}

Drive parse_drive(std::string_view toml, const std::filesystem::path& folder) {
  return parse_drive(toml, "drive", folder, {}).drive;
}

}  // namespace gearlash
