// gearlash show: the drive with all defaults filled in.
#include "output/drive_text.hpp"
#include "verb.hpp"

namespace gearlash::cli {
namespace {

constexpr char show_examples[] =
    "  gearlash show examples/robot-joint.toml\n"
    "  gearlash show examples/robot-joint.toml --set controller.kp=\"0.8 N m/rad\" > joint.toml\n"
    "  gearlash show --damping 0.19 --inertia-ratio 2 --friction-ratio 0.1 --backlash 0.3\n"
    "  gearlash show examples/telescope-axis.toml --format json | jq .drive\n";

ExitStatus run(const QuestionOptions& options, const Provenance& provenance) {
  Faults faults;
  faults.require_choice("--format", options.format, {"text", "toml", "json"});
  const std::optional<WrittenDrive> written = resolve_drive(options.servo, {}, faults);
  faults.require_none();
  const Drive& drive = written->drive;
  write_file("-", options.format == "json" ? show_json(drive, provenance) : show_text(drive));
  return ExitStatus::done;
}

}  // namespace

void add_show_command(const Command& app, Action& action) {
  const auto [command, options] = add_verb<QuestionOptions>(
      app, action, "show", "Write the drive with all defaults, as a file that reads back",
      help_footer(show_examples), run);
  add_servo_or_drive_options(command, options.servo);
  command.add_option("--format FORMAT", options.format,
                     "Choose the format: toml (default) or json");
}

}  // namespace gearlash::cli
