// Whatever the bytes: parse_servo either throws InvalidInput, one line a fault, or returns a
// sound servo; parse_sweep a sound grid; and parse_servo_or_drive a sound servo or drive.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "general/assemble/drive_system.hpp"
#include "input/drive_file.hpp"
#include "input/servo_file.hpp"
#include "input/sweep_file.hpp"

namespace {

void require(bool condition) {
  if (!condition) std::abort();
}

void require_sound(const gearlash::ServoFile& file) {
  require(gearlash::validate(file.servo).empty());
  if (file.drivetrain) {
    require(gearlash::validate(*file.drivetrain).empty());
    require(file.natural_frequency.has_value());
  }
  require(!file.natural_frequency || *file.natural_frequency > 0.0);
  require(file.backlash_unit.radians > 0.0 && !file.backlash_unit.name.empty());
}

void require_sound(const gearlash::SweepFile& file) {
  const std::vector<std::string> fields(file.grid.axes.size(), "axis");
  require(!fields.empty() && fields.size() <= gearlash::most_axes_of_a_sweep);
  require(gearlash::validate(file.grid, fields).empty());
  require(!file.quantities.empty());
}

void require_sound(const gearlash::ServoOrDriveFile& file) {
  if (const auto* servo = std::get_if<gearlash::ServoFile>(&file)) return require_sound(*servo);
  const auto& drive = std::get<gearlash::DriveFile>(file);
  require(gearlash::drive::validate(drive.drive).empty());
  const gearlash::hybrid::HybridSystem system = gearlash::drive::drive_system(drive.drive).system;
  require(gearlash::hybrid::faults(system).empty());
  for (std::size_t mode = 0; mode < system.mode_count(); ++mode) {
    require(gearlash::hybrid::faults_of_mode(system, mode).empty());
  }
}

void require_one_line_each(const gearlash::InvalidInput& refusal) {
  require(!refusal.faults().empty());
  for (const gearlash::Fault& fault : refusal.faults()) {
    const std::string line = to_string(fault);
    require(line.find('\n') == std::string::npos && line.find('\0') == std::string::npos);
    require(line.starts_with("fuzz.toml:"));
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    require_sound(gearlash::parse_servo(text, "fuzz.toml"));
  } catch (const gearlash::InvalidInput& refusal) {
    require_one_line_each(refusal);
  }
  try {
    require_sound(gearlash::parse_sweep(text, "fuzz.toml"));
  } catch (const gearlash::InvalidInput& refusal) {
    require_one_line_each(refusal);
  }
  // A table could be a file that is without end.
  if (text.find("file") != std::string_view::npos) return 0;
  try {
    require_sound(gearlash::parse_servo_or_drive(text, "fuzz.toml", "."));
  } catch (const gearlash::InvalidInput& refusal) {
    require_one_line_each(refusal);
  }
  return 0;
}
