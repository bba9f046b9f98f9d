#include "input/drive_file.hpp"

#include <cmath>

#include "input/drive_reader.hpp"
#include "input/servo_reader.hpp"
#include "input/text_file.hpp"
#include "input/toml_document.hpp"
#include "model/proportional_servo.hpp"

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

}  // namespace

ServoOrDriveFile parse_servo_or_drive(std::string_view toml, std::string_view source_name,
                                      const std::filesystem::path& folder) {
  const TomlDocument document(toml, source_name, largest_servo_file);
  Findings findings(document);
  if (!describes_drive(document)) {
    ServoFile file = read_servo(document, findings);
    findings.require_none();
    return file;
  }
  DriveFile file = read_drive(document, findings, folder);
  findings.require_none();
  return file;
}

ServoOrDriveFile read_servo_or_drive_file(const std::filesystem::path& path) {
  return parse_servo_or_drive(read_text_file(path, largest_servo_file), path.string(),
                              path.parent_path());
}

DriveFile drive_file_of(const ServoFile& servo) {
  DriveFile file;
  file.drive = drive::drive_of(drivetrain_of(servo));
  if (servo.datasheet) file.gear_ratio = servo.datasheet->gearbox.ratio;
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

}  // namespace gearlash
