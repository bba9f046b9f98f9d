// gearlash motor: from the data sheet to the numbers of the charts of 1960, step by step.
#include <map>

#include "gearlash/output.hpp"
#include "gearlash/units.hpp"
#include "thesis/procedure.hpp"
#include "verb.hpp"

namespace gearlash::cli {
namespace {

constexpr char motor_examples[] =
    "  gearlash motor examples/elinco-fd162.toml\n"
    "  gearlash motor examples/instrument-two-phase.toml\n";

ExitStatus run(const ServoOptions& options, const Provenance&) {
  Faults faults;
  const std::optional<WrittenDrive> written = resolve_drive(options, {}, faults);
  faults.require_none();
  if (!thesis::is_data_sheet(written->drive)) {
    throw InvalidInput({{"motor", "", "the procedure starts from a data sheet with [motor]",
                         shown(options.file, std::string_view::npos)}});
  }
  servo_of_1960(*written, options);
  // With --set the texts of the file no longer apply.
  std::map<std::string, std::string> texts;
  if (options.settings.empty()) texts = written->texts;
  write_file("-", fitted_to_output(thesis::motor_procedure(written->drive, texts)));
  return ExitStatus::done;
}

}  // namespace

void add_motor_command(const Command& app, Action& action) {
  const auto [command, options] = add_verb<ServoOptions>(
      app, action, "motor",
      "Convert a data sheet to the numbers of the charts of 1960, step by step",
      help_footer(motor_examples), run);
  command.add_option("DRIVE.toml", options.file,
                     "Read this data sheet (docs/reference/data-sheets.md)", {.is_required = true});
  add_set_option(command, options);
}

}  // namespace gearlash::cli
