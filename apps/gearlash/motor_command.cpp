// gearlash motor: from the data sheet to the numbers of the charts, step by step.
#include <memory>

#include "command.hpp"
#include "input/units.hpp"
#include "motor_procedure.hpp"
#include "output/output_file.hpp"
#include "written_values.hpp"

namespace gearlash::cli {
namespace {

constexpr char examples[] =
    "  gearlash motor examples/elinco-fd162.toml\n"
    "  gearlash motor examples/instrument-two-phase.toml\n";

ExitStatus run(const std::string& path, const Provenance&) {
  const ServoFile file = read_servo_file(path);
  if (!file.datasheet) {
    throw InvalidInput({{"motor", "", "the procedure starts from a data sheet with [motor]",
                         shown(path, std::string_view::npos)}});
  }
  write_file("-", motor_procedure(file, written_values(path)));
  return ExitStatus::done;
}

}  // namespace

void add_motor_command(Command& app, Action& action) {
  const auto path = std::make_shared<std::string>();
  Command* command =
      app.add_subcommand("motor", "from the data sheet to the numbers of the charts, step by step");
  command->add_option("SERVO.toml", *path, "data sheet (docs/data-sheets.md)")
      ->type_name("")
      ->required();
  command->footer(help_footer(examples));
  command->callback([path, &action] {
    action = [path](const Provenance& provenance) { return run(*path, provenance); };
  });
}

}  // namespace gearlash::cli
