// gearlash motor: from the data sheet to the numbers of the charts, step by step.

#include "input/units.hpp"
#include "motor_procedure.hpp"
#include "verb.hpp"

namespace gearlash::cli {
namespace {

constexpr char motor_examples[] =
    "  gearlash motor examples/elinco-fd162.toml\n"
    "  gearlash motor examples/instrument-two-phase.toml\n";

/// The procedure covers a proportional loop and a motor with a winding.
bool is_data_sheet(const Drive& drive) {
  const auto* pid = std::get_if<PID>(&drive.controller.law);
  return !drive.servo && !std::holds_alternative<TorqueControl>(drive.motor.kind) &&
         !drive.controller.firmware && pid != nullptr && pid->terms == PIDTerms::P;
}

ExitStatus run(const ServoOptions& options, const Provenance&) {
  Faults faults;
  const std::optional<WrittenDrive> written = resolve_drive(options, {}, faults);
  faults.require_none();
  if (!is_data_sheet(written->drive)) {
    throw InvalidInput({{"motor", "", "the procedure starts from a data sheet with [motor]",
                         shown(options.file, std::string_view::npos)}});
  }
  servo_of_1960(*written, options);
  // With --set the texts of the file no longer apply.
  std::map<std::string, std::string> texts;
  if (options.settings.empty()) texts = written->texts;
  write_file("-", motor_procedure(written->drive, written->angle, texts));
  return ExitStatus::done;
}

}  // namespace

void add_motor_command(const Command& app, Action& action) {
  const auto [command, options] = add_verb<ServoOptions>(
      app, action, "motor", "Convert a data sheet to the numbers of the charts, step by step",
      help_footer(motor_examples), run);
  command.add_option("DRIVE.toml", options.file,
                     "Read this data sheet (docs/reference/data-sheets.md)", {.is_required = true});
  add_set_option(command, options);
}

}  // namespace gearlash::cli
