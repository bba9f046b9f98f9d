// Whatever the bytes, every reader either throws InvalidInput, one line a fault, or returns what is
// sound: a drive with its tolerances, a sweep, a table of a signal, a target, an axis.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "gearlash/input.hpp"
#include "general/assemble/drive_system.hpp"
#include "input/signal_reader.hpp"
#include "model/proportional_servo.hpp"
#include "model/reduced_drive.hpp"
#include "model/signal.hpp"

namespace {

void require(bool condition) {
  if (!condition) std::abort();
}

void require_sound(const gearlash::SweepFile& file) {
  const std::vector<std::string> fields(file.grid.axes.size(), "axis");
  require(!fields.empty() && fields.size() <= gearlash::most_axes_of_a_sweep);
  require(gearlash::faults(file.grid, fields).empty());
  require(!file.quantities.empty());
}

void require_sound(const gearlash::WrittenDrive& written) {
  require(written.drive.angle_unit.radians > 0.0 && !written.drive.angle_unit.name.empty());
  require(gearlash::faults(written.drive).empty());
  if (const auto servo = gearlash::proportional_servo(written.drive)) {
    return require(gearlash::faults(servo->servo).empty() && servo->natural_frequency > 0.0);
  }
  const gearlash::drive::ReducedDrive reduced = gearlash::reduce(written.drive);
  require(gearlash::drive::faults(reduced).empty());
  const gearlash::hybrid::HybridSystem system = gearlash::drive::drive_system(reduced).system;
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

/// What `read` makes of the bytes has to be sound, or refused.
template <class Read>
void accept_or_refuse(const Read& read) {
  try {
    read();
  } catch (const gearlash::InvalidInput& refusal) {
    require_one_line_each(refusal);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const std::string name = "fuzz.toml:";
  accept_or_refuse([&] { require_sound(gearlash::parse_sweep(text, "fuzz.toml")); });
  accept_or_refuse([&] {
    gearlash::read_axis(gearlash::split_axis(name, text), gearlash::normal_form(0.2, 1.0, 0.2));
  });
  accept_or_refuse([&] { gearlash::read_target(name, text, gearlash::TimeScale::unknown); });
  accept_or_refuse([&] {
    const gearlash::Signal table =
        gearlash::parse_signal_table(text, name, gearlash::dimensions::angle);
    require(gearlash::drive::faults(table, name).empty());
  });
  // A table could be a file that is without end.
  if (text.find("file") != std::string_view::npos) return 0;
  accept_or_refuse([&] { require_sound(gearlash::parse_drive(text, "fuzz.toml", ".", {})); });
  return 0;
}
