// gearlash design: what must change so that the servo does what it should?
#include <algorithm>
#include <memory>
#include <utility>

#include "command.hpp"
#include "input/target_text.hpp"
#include "machine_faults.hpp"
#include "model/reduced_drive.hpp"
#include "output/design_report.hpp"
#include "output/output_file.hpp"
#include "picture/region_map.hpp"
#include "plot_option.hpp"
#include "servo_options.hpp"
#include "terminal.hpp"

namespace gearlash::cli {
namespace {

constexpr char examples[] =
    "  gearlash design examples/elinco-fd162.toml --target no-hunting\n"
    "  gearlash design examples/elinco-fd162.toml --target \"amplitude <= 1 deg and frequency >= 3 "
    "Hz\"\n"
    "  gearlash design examples/elinco-fd162.toml --target \"amplitude <= 30 arcmin\" \\\n"
    "      --parameters gearbox.backlash,gearbox.ratio --format json | jq .answers[0].nearest\n"
    "  gearlash design examples/elinco-fd162.toml --target no-hunting \\\n"
    "      --vary load.friction,controller.proportional --plot region=region.svg\n"
    "  gearlash design --damping 0.19 --inertia-ratio 2 --friction-ratio 1/10 --backlash 0.3 \\\n"
    "      --target \"amplitude <= 0.1\"\n";

struct DesignOptions {
  ServoOptions servo;
  std::string target;
  std::vector<std::string> parameters;
  std::vector<std::string> vary;
  std::string cost = "bandwidth";
  std::vector<std::string> plots;
  std::string format = "text";
};

/// "gear-ratio" is as good as "gear_ratio".
std::vector<std::string> read_parameters(const std::string& field,
                                         const std::vector<std::string>& names,
                                         const ChangeableDrive& drive, Faults& faults) {
  std::vector<std::string> parameters;
  std::vector<std::string> choices;
  for (const ChangeableNumber& number : drive.numbers()) choices.push_back(number.name);
  for (const std::string& name : names) {
    std::string underscored = name;
    std::replace(underscored.begin(), underscored.end(), '-', '_');
    if (const ChangeableNumber* number = drive.find(underscored)) {
      parameters.push_back(number->name);
    } else {
      faults.require_choice(field, name, choices);
    }
  }
  return parameters;
}

/// What is drawn: the two parameters of --vary, y over x.
struct Region {
  std::vector<std::string> axes;
  Cost cost = Cost::bandwidth;
};

Region read_region(const DesignOptions& options, const ChangeableDrive& drive, Faults& faults) {
  Region region{.axes = read_parameters("--vary", options.vary, drive, faults)};
  for (const Cost cost : {Cost::bandwidth, Cost::damping, Cost::stiffness}) {
    if (options.cost == name_of(cost)) region.cost = cost;
  }
  for (const std::string& parameter : region.axes) {
    const Bounds range = range_to_draw(drive, parameter);
    if (range.low < range.high) continue;
    faults.add({"--vary", parameter, "must not be 0, of which there are no multiples", ""});
  }
  return region;
}

/// What can be said of the options without the drive.
void check_options(const DesignOptions& options, Faults& faults) {
  faults.require_choice("--format", options.format, {"text", "json"});
  faults.require_choice("--cost", options.cost, {"bandwidth", "damping", "stiffness"});
  if (options.plots.empty() != options.vary.empty()) {
    faults.add(options.plots.empty()
                   ? Fault{"--plot", "", "must name a picture of what --vary varies", ""}
                   : Fault{"--vary", "", "must name two parameters, over which --plot draws", ""});
  }
  const bool are_two = options.vary.size() == 2 && options.vary[0] != options.vary[1];
  if (!options.vary.empty() && !are_two) {
    faults.add({"--vary", std::to_string(options.vary.size()) + " names",
                "must be two different parameters, with a comma between", ""});
  }
}

std::string draw(const RegionMapTask& task, const Region& region, PictureFormat format) {
  const std::size_t count = values_to_draw(task.drive, region.axes[0], region.axes[1]);
  const auto axis = [&](const std::string& parameter) {
    return parameter_axis(parameter, range_to_draw(task.drive, parameter), count);
  };
  return draw_contour_map(map_of(task, axis(region.axes[0]), axis(region.axes[1])), format);
}

std::vector<FeasibleValues> work_out(const ChangeableDrive& drive, const Target& target,
                                     const std::vector<std::string>& parameters) {
  TerminalProgress progress("Design");
  std::vector<FeasibleValues> answers;
  for (const std::string& parameter : parameters) {
    progress.go_on(static_cast<double>(answers.size()) / static_cast<double>(parameters.size()));
    answers.push_back(feasible_values(drive, parameter, target));
  }
  return answers;
}

ExitStatus run(const DesignOptions& options, const Provenance& provenance) {
  Faults faults;
  check_options(options, faults);
  const std::vector<Plot> plots = read_plots(options.plots, {"region"}, faults);
  faults.require_distinct({"DRIVE.toml", options.servo.file}, files_of(plots));
  const std::optional<WrittenDrive> written = resolve_drive(options.servo, faults);
  const bool has_time = !written || !is_normalized(written->drive);
  const Target target = faults.collect(
      [&] {
        return read_target("--target", options.target,
                           has_time ? TimeScale::known : TimeScale::unknown);
      },
      Target{});
  if (!written) faults.require_none();

  const ChangeableDrive drive(closed_form_drive(*written, options.servo));
  std::vector<std::string> parameters =
      read_parameters("--parameters", options.parameters, drive, faults);
  const Region region = read_region(options, drive, faults);
  faults.require_none();
  if (parameters.empty()) parameters = region.axes;
  if (parameters.empty()) parameters = drive.usual_names();
  const DesignReport report{.drive = drive,
                            .target_text = options.target,
                            .target = target,
                            .answers = work_out(drive, target, parameters),
                            .angle = written->angle,
                            .is_normalized = !has_time,
                            .provenance = provenance};
  const RegionMapTask map{.drive = drive,
                          .target = target,
                          .target_text = options.target,
                          .cost = region.cost,
                          .angle = written->angle};
  Extras extras;
  for (const Plot& plot : plots) {
    extras.make([&] { write_file(plot.file, draw(map, region, plot.format)); });
  }
  write_file("-", options.format == "json" ? design_json(report) : design_text(report));
  return extras.status(ExitStatus::done);
}

}  // namespace

void add_design_command(Command& app, Action& action) {
  const auto options = std::make_shared<DesignOptions>();
  Command* command = app.add_subcommand(
      "design", "what must change so that it does not hunt, or less, or faster?");
  add_servo_or_drive_options(*command, options->servo);
  command
      ->add_option("--target", options->target,
                   "no-hunting; or amplitude, frequency, period or growth-at-rest,\n"
                   "<= or >=, and a limit; several joined by \"and\"")
      ->type_name("TARGET")
      ->required();
  command
      ->add_option("--parameters", options->parameters,
                   "which may change, by their paths, with commas between: gearbox.ratio,\n"
                   "load.friction, ...; also tachometer, feedback that is added; of the normal\n"
                   "form shares of what it has: gear_ratio, error_gain, load_friction,\n"
                   "motor_friction, load_inertia, motor_inertia. When left out: those of\n"
                   "--vary, or what is changed most easily")
      ->type_name("NAMES")
      ->delimiter(',');
  command
      ->add_option("--vary", options->vary,
                   "two of them, with a comma between: --plot draws where both together\n"
                   "meet the target, over lines of equal cost")
      ->type_name("X,Y")
      ->delimiter(',');
  command->add_option("--cost", options->cost, "bandwidth (default), damping or stiffness")
      ->type_name("COST");
  add_plot_option(*command, options->plots, "region: where the two of --vary meet the target; ");
  command->add_option("--format", options->format, "text (default) or json")->type_name("FORMAT");
  command->footer(help_footer(examples));
  command->callback([options, &action] {
    action = [options](const Provenance& provenance) { return run(*options, provenance); };
  });
}

}  // namespace gearlash::cli
