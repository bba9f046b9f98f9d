// gearlash design: what must change so that the servo does what it should?
#include <algorithm>
#include <memory>
#include <utility>

#include "command.hpp"
#include "input/target_text.hpp"
#include "machine_faults.hpp"
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
    "  gearlash design examples/elinco-fd162.toml --target \"size <= 1 deg and frequency >= 3 "
    "Hz\"\n"
    "  gearlash design examples/elinco-fd162.toml --target \"size <= 30 arcmin\" \\\n"
    "      --parameters backlash,error_gain --format json | jq .answers[0].nearest\n"
    "  gearlash design examples/elinco-fd162.toml --target no-hunting \\\n"
    "      --vary load_friction,error_gain --plot region=region.svg\n"
    "  gearlash design --damping 0.19 --inertia-ratio 2 --friction-ratio 1/10 --backlash 0.3 \\\n"
    "      --target \"size <= 0.1\"\n";

struct DesignOptions {
  ServoOptions servo;
  std::string target;
  std::vector<std::string> parameters;
  std::vector<std::string> vary;
  std::string cost = "bandwidth";
  std::vector<std::string> plots;
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

/// "gear-ratio" is as good as "gear_ratio".
std::vector<DesignParameter> read_parameters(const std::string& field,
                                             const std::vector<std::string>& names,
                                             Faults& faults) {
  std::vector<DesignParameter> parameters;
  std::vector<std::string> choices;
  for (const DesignParameter parameter : all_parameters) choices.emplace_back(name_of(parameter));
  for (const std::string& name : names) {
    std::string underscored = name;
    std::replace(underscored.begin(), underscored.end(), '-', '_');
    if (const auto parameter = parameter_named(underscored)) {
      parameters.push_back(*parameter);
    } else {
      faults.require_choice(field, name, choices);
    }
  }
  return parameters;
}

/// What is drawn, if anything: the two parameters of --vary, y over x.
struct Picture {
  std::vector<DesignParameter> axes;
  Cost cost = Cost::bandwidth;
  std::vector<Plot> plots = {};
};

Picture read_picture(const DesignOptions& options, Faults& faults) {
  Picture picture{.axes = read_parameters("--vary", options.vary, faults)};
  faults.require_choice("--cost", options.cost, {"bandwidth", "damping", "stiffness"});
  for (const Cost cost : {Cost::bandwidth, Cost::damping, Cost::stiffness}) {
    if (options.cost == name_of(cost)) picture.cost = cost;
  }
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
  picture.plots = read_plots(options.plots, {"region"}, faults);
  return picture;
}

/// A parameter that is 0 and may only be multiplied has no axis.
void require_ranges(const ChangeableDrive& drive, const Picture& picture) {
  Faults faults;
  for (const DesignParameter parameter : picture.axes) {
    const Bounds range = range_to_draw(drive, parameter);
    if (range.low < range.high) continue;
    faults.add(
        {"--vary", name_of(parameter), "must not be 0, of which there are no multiples", ""});
  }
  faults.require_none();
}

void draw(const RegionMapTask& task, const Picture& picture, const Plot& plot) {
  const std::size_t count = values_to_draw(task.drive, picture.axes[0], picture.axes[1]);
  const auto axis = [&](DesignParameter parameter) {
    return parameter_axis(parameter, range_to_draw(task.drive, parameter), count);
  };
  write_file(plot.file, draw_contour_map(map_of(task, axis(picture.axes[0]), axis(picture.axes[1])),
                                         plot.format));
}

std::vector<FeasibleValues> work_out(const ChangeableDrive& drive, const Target& target,
                                     const std::vector<DesignParameter>& parameters) {
  TerminalProgress progress("Design");
  std::vector<FeasibleValues> answers;
  for (const DesignParameter parameter : parameters) {
    progress.go_on(static_cast<double>(answers.size()) / static_cast<double>(parameters.size()));
    answers.push_back(feasible_values(drive, parameter, target));
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
  std::vector<DesignParameter> parameters =
      read_parameters("--parameters", options.parameters, faults);
  const Picture picture = read_picture(options, faults);
  faults.require_distinct({"SERVO.toml", options.servo.file}, files_of(picture.plots));
  faults.require_none();
  if (parameters.empty()) parameters = picture.axes;
  if (parameters.empty()) parameters = {all_parameters.begin(), all_parameters.end()};

  const ChangeableDrive drive = changeable_drive(file);
  require_ranges(drive, picture);
  const DesignReport report{.drive = drive,
                            .target_text = options.target,
                            .target = target,
                            .answers = work_out(drive, target, parameters),
                            .units = report_units(file),
                            .provenance = provenance};
  Extras extras;
  for (const Plot& plot : picture.plots) {
    const RegionMapTask map{.drive = drive,
                            .target = target,
                            .target_text = options.target,
                            .cost = picture.cost,
                            .angle = report.units.angle};
    extras.make([&] { draw(map, picture, plot); });
  }
  write_file("-", options.format == "json" ? design_json(report) : design_text(report));
  return extras.status(ExitStatus::done);
}

}  // namespace

void add_design_command(Command& app, Action& action) {
  const auto options = std::make_shared<DesignOptions>();
  Command* command = app.add_subcommand(
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
                   "which may change, with commas between; all when left out, or those\n"
                   "of --vary: backlash,\n"
                   "gear_ratio, error_gain, load_friction, motor_friction, tachometer,\n"
                   "load_inertia, motor_inertia, restitution")
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
  add_plot_option(*command, options->plots, "region: where the target is met; ");
  command->add_option("--format", options->format, "text (default) or json")->type_name("FORMAT");
  command->footer(help_footer(examples));
  command->callback([options, &action] {
    action = [options](const Provenance& provenance) { return run(*options, provenance); };
  });
}

}  // namespace gearlash::cli
