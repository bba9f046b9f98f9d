// gearlash design: what must change so that the servo does what it should?
#include <algorithm>
#include <memory>
#include <utility>

#include "command.hpp"
#include "gearlash/io/design_report.hpp"
#include "gearlash/io/output_file.hpp"
#include "gearlash/io/target_text.hpp"
#include "servo_options.hpp"
#include "terminal.hpp"

namespace gearlash::cli {
namespace {

constexpr char examples[] =
    "  gearlash design examples/elinco-fd162.toml --target no-hunting\n"
    "  gearlash design examples/elinco-fd162.toml --target \"size <= 1 deg and frequency >= 3 "
    "Hz\"\n"
    "  gearlash design examples/elinco-fd162.toml --target \"size <= 30 arcmin\" \\\n"
    "      --parameters backlash,error_gain --format json | jq .answers[0].nearest\n"
    "  gearlash design --damping 0.19 --inertia-ratio 2 --friction-ratio 1/10 --backlash 0.3 \\\n"
    "      --target \"size <= 0.1\"\n";

struct DesignOptions {
  ServoOptions servo;
  std::string target;
  std::vector<std::string> parameters;
  std::string format = "text";
};

/// A data sheet is changed in its own numbers, which options for normalised ones would leave
/// behind.
void refuse_normalized_options(const ServoOptions& options, const ServoFile& file, Faults& faults) {
  if (!file.datasheet) return;
  for (const auto& [name, typed] : {std::pair("--damping", options.damping),
                                    std::pair("--inertia-ratio", options.inertia_ratio),
                                    std::pair("--friction-ratio", options.friction_ratio)}) {
    if (!typed) continue;
    faults.add({name, shown(*typed),
                "must be left out: it is the data sheet's own numbers that are changed", ""});
  }
}

/// Precondition: nothing is at fault.
ChangeableDrive changeable_drive(const ServoFile& file) {
  if (!file.datasheet) {
    return ChangeableDrive(file.servo, file.natural_frequency.value_or(1.0));
  }
  Datasheet datasheet = *file.datasheet;  // with what options say of it
  datasheet.gearbox.backlash = file.servo.backlash;
  datasheet.contact.restitution = file.servo.restitution;
  return ChangeableDrive(datasheet);
}

std::vector<Parameter> read_parameters(const std::vector<std::string>& names, Faults& faults) {
  std::vector<Parameter> parameters;
  std::vector<std::string> choices;
  for (const Parameter parameter : all_parameters) choices.emplace_back(name_of(parameter));
  for (const std::string& name : names) {
    std::string underscored = name;
    std::replace(underscored.begin(), underscored.end(), '-', '_');
    if (const auto parameter = parameter_named(underscored)) {
      parameters.push_back(*parameter);
    } else {
      faults.require_choice("--parameters", name, choices);
    }
  }
  if (names.empty()) return {all_parameters.begin(), all_parameters.end()};
  return parameters;
}

std::vector<DesignAnswer> work_out(const ChangeableDrive& drive, const Target& target,
                                   const std::vector<Parameter>& parameters) {
  Progress progress("Design");
  std::vector<DesignAnswer> answers;
  for (const Parameter parameter : parameters) {
    progress.show(static_cast<double>(answers.size()) / static_cast<double>(parameters.size()));
    answers.push_back(design_answer(drive, parameter, target));
  }
  return answers;
}

ExitStatus run(const DesignOptions& options, const Provenance& provenance) {
  Faults faults;
  faults.require_choice("--format", options.format, {"text", "json"});
  const ServoFile file = resolve_servo(options.servo, faults);
  refuse_normalized_options(options.servo, file, faults);
  const TimeScale time_scale = file.natural_frequency ? TimeScale::known : TimeScale::unknown;
  const Target target =
      faults.collect([&] { return read_target("--target", options.target, time_scale); }, Target{});
  const std::vector<Parameter> parameters = read_parameters(options.parameters, faults);
  faults.require_none();

  const ChangeableDrive drive = changeable_drive(file);
  const DesignReport report{.drive = drive,
                            .target_text = options.target,
                            .target = target,
                            .answers = work_out(drive, target, parameters),
                            .units = report_units(file),
                            .provenance = provenance};
  write_file("-", options.format == "json" ? design_json(report) : design_text(report));
  return ExitStatus::done;
}

}  // namespace

void add_design_command(CLI::App& app, Action& action) {
  const auto options = std::make_shared<DesignOptions>();
  CLI::App* command = app.add_subcommand(
      "design", "what must change so that it does not hunt, or less, or faster?");
  add_servo_options(*command, options->servo);
  command
      ->add_option("--target", options->target,
                   "no-hunting; or size, frequency, period or growth-at-rest,\n"
                   "<= or >=, and a limit; several joined by \"and\"")
      ->type_name("TARGET")
      ->required();
  command
      ->add_option("--parameters", options->parameters,
                   "which may change, with commas between; all when left out: backlash,\n"
                   "gear_ratio, error_gain, load_friction, motor_friction, tachometer,\n"
                   "load_inertia, motor_inertia, restitution")
      ->type_name("NAMES")
      ->delimiter(',');
  command->add_option("--format", options->format, "text (default) or json")->type_name("FORMAT");
  command->footer(help_footer(examples));
  command->callback([options, &action] {
    action = [options](const Provenance& provenance) { return run(*options, provenance); };
  });
}

}  // namespace gearlash::cli
