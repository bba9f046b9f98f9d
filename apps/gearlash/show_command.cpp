// gearlash show: the drive with all defaults taken.
#include <fmt/format.h>

#include <memory>

#include "command.hpp"
#include "general/assemble/time_scale.hpp"
#include "model/reduced_drive.hpp"
#include "output/drive_text.hpp"
#include "output/json_values.hpp"
#include "output/output_file.hpp"
#include "servo_options.hpp"

namespace gearlash::cli {
namespace {

constexpr char examples[] =
    "  gearlash show examples/robot-joint.toml\n"
    "  gearlash show examples/robot-joint.toml --set controller.kp=\"0.8 N m/rad\" > joint.toml\n"
    "  gearlash show --damping 0.19 --inertia-ratio 2 --friction-ratio 0.1 --backlash 0.3\n"
    "  gearlash show examples/telescope-axis.toml --format json | jq .drive\n";

struct ShowOptions {
  ServoOptions servo;
  std::string format = "text";
};

/// What the drive is to the closed form, and how fast its loop is, as remarks before the TOML.
std::string remarks(const Drive& drive) {
  std::string text;
  if (const auto closed = closed_form_servo(drive)) {
    const NormalizedServo& servo = closed->servo;
    text += fmt::format(
        "# Normal form: damping {:.4g}, inertia ratio {:.4g}, friction ratio {:.4g}, natural "
        "frequency {:.4g} rad/s.\n",
        servo.damping, servo.inertia_ratio, servo.friction_ratio, closed->natural_frequency);
  } else {
    const drive::TimeScales scales = drive::time_scales(reduce(drive));
    text += fmt::format(
        "# Linear loop with the gap closed: slowest swing {:.4g} s, settling time constant {:.4g} "
        "s.\n",
        scales.swing, scales.settling);
  }
  return text;
}

Json normal_form_json(const Drive& drive) {
  const auto closed = closed_form_servo(drive);
  if (!closed) return nullptr;
  return {{"damping", json_number(closed->servo.damping)},
          {"inertia_ratio", json_number(closed->servo.inertia_ratio)},
          {"friction_ratio", json_number(closed->servo.friction_ratio)},
          {"backlash", json_number(closed->servo.backlash)},
          {"restitution", json_number(closed->servo.restitution)},
          {"natural_frequency", json_number(closed->natural_frequency)}};
}

Json linear_loop_json(const Drive& drive) {
  if (closed_form_servo(drive)) return nullptr;
  const drive::TimeScales scales = drive::time_scales(reduce(drive));
  return {{"slowest_swing", json_number(scales.swing)}, {"settling", json_number(scales.settling)}};
}

std::string show_json(const Drive& drive, const Provenance& provenance) {
  const Json json = {{"schema", "gearlash/show/2"},
                     {"version", provenance.version},
                     {"command", provenance.command},
                     {"units", "SI"},
                     {"drive", drive_json(drive)},
                     {"defaults", defaults_taken(drive)},
                     {"normal_form", normal_form_json(drive)},
                     {"linear_loop", linear_loop_json(drive)}};
  return json.dump(2) + "\n";
}

ExitStatus run(const ShowOptions& options, const Provenance& provenance) {
  Faults faults;
  faults.require_choice("--format", options.format, {"text", "toml", "json"});
  const std::optional<WrittenDrive> written = resolve_drive(options.servo, faults);
  faults.require_none();
  const Drive& drive = written->drive;
  write_file("-", options.format == "json" ? show_json(drive, provenance)
                                           : remarks(drive) + to_toml(drive));
  return ExitStatus::done;
}

}  // namespace

void add_show_command(Command& app, Action& action) {
  const auto options = std::make_shared<ShowOptions>();
  Command* command =
      app.add_subcommand("show", "the drive with all defaults taken, as a file that reads back");
  add_servo_or_drive_options(*command, options->servo);
  command->add_option("--format", options->format, "toml (default) or json")->type_name("FORMAT");
  command->footer(help_footer(examples));
  command->callback([options, &action] {
    action = [options](const Provenance& provenance) { return run(*options, provenance); };
  });
}

}  // namespace gearlash::cli
