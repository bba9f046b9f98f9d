// gearlash design: the changes of a drive that meet a target.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "analysis/design/feasible_values.hpp"
#include "analysis/final_servo.hpp"
#include "analysis/grid/axis.hpp"
#include "base/progress_part.hpp"
#include "command.hpp"
#include "input/axis_text.hpp"
#include "input/target_text.hpp"
#include "limit_options.hpp"
#include "machine_faults.hpp"
#include "model/reduced_drive.hpp"
#include "output/design_report.hpp"
#include "output/output_file.hpp"
#include "output/searched_design_report.hpp"
#include "picture/region_map.hpp"
#include "plot_option.hpp"
#include "servo_options.hpp"
#include "terminal.hpp"

namespace gearlash::cli {
namespace {

constexpr char design_examples[] =
    "  gearlash design examples/elinco-fd162.toml --target no-hunting\n"
    "  gearlash design examples/elinco-fd162.toml --target \"amplitude <= 1 deg and frequency >= 3 "
    "Hz\"\n"
    "  gearlash design examples/elinco-fd162.toml --target \"amplitude <= 30 arcmin\" \\\n"
    "      --parameters gearbox.backlash,gearbox.ratio --format json | jq .answers[0].nearest\n"
    "  gearlash design examples/elinco-fd162.toml --target no-hunting \\\n"
    "      --vary load.friction,controller.proportional --plot region=region.svg\n"
    "  gearlash design examples/dynamixel-joint.toml --target \"no-hunting and bandwidth >= 10 "
    "Hz\"\n"
    "  gearlash design examples/robot-joint.toml --target \"motor-amplitude <= 0.1 deg\" \\\n"
    "      --parameters controller.kind,controller.integral=0:100:5\n"
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
  LimitOptions limits;
};

/// "2 of 5 parameters are not searched to the end".
std::string unknown_text(std::size_t known, std::size_t all) {
  return fmt::format("{} of {} parameters {} not searched to the end", all - known, all,
                     all - known == 1 ? "is" : "are");
}

/// Reads hyphens as underscores: "gear-ratio" is "gear_ratio".
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

/// The picture: the two parameters of --vary, y over x.
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
    faults.add({"--vary", parameter,
                "must not be 0: the picture varies it by multiples of its present value", ""});
  }
  return region;
}

/// Checks that do not need the drive.
void check_options(const DesignOptions& options, Faults& faults) {
  faults.require_choice("--format", options.format, {"text", "json"});
  faults.require_choice("--cost", options.cost, {"bandwidth", "damping", "stiffness"});
  if (options.plots.empty() != options.vary.empty()) {
    faults.add(options.plots.empty()
                   ? Fault{"--plot", "",
                           "must name the picture that --vary asks for, such as region=region.svg",
                           ""}
                   : Fault{"--vary", "", "must name the two parameters of the picture", ""});
  }
  const bool are_two = options.vary.size() == 2 && options.vary[0] != options.vary[1];
  if (!options.vary.empty() && !are_two) {
    faults.add({"--vary", std::to_string(options.vary.size()) + " names",
                "must be two different parameters, separated by a comma", ""});
  }
}

std::string draw(const RegionMapTask& task, const Region& region, const Plot& plot,
                 LimitedWork& work) {
  const std::size_t count = values_to_draw(task.drive, region.axes[0], region.axes[1]);
  const auto axis = [&](const std::string& parameter) {
    return parameter_axis(parameter, range_to_draw(task.drive, parameter), count);
  };
  TerminalProgress progress(work, "Region");
  const ContourMap map = map_of(task, axis(region.axes[0]), axis(region.axes[1]), progress);
  if (work.is_stopped()) throw OutputError(plot.file + ": not drawn: the work was stopped before");
  return draw_contour_map(map, plot.format);
}

std::vector<FeasibleValues> work_out(const ChangeableDrive& drive, const Target& target,
                                     const std::vector<std::string>& parameters,
                                     LimitedWork& work) {
  TerminalProgress progress(work, "Design");
  std::vector<FeasibleValues> answers;
  for (const std::string& parameter : parameters) {
    ProgressPart part(progress, answers.size(), parameters.size());
    answers.push_back(feasible_values(drive, parameter, target, part));
    if (answers.back().stopped) break;
  }
  return answers;
}

ExitStatus run_closed_form(const DesignOptions& options, const Target& target,
                           const WrittenDrive& written, const std::vector<Plot>& plots,
                           const Provenance& provenance, Faults& faults) {
  const Limits limits = read_limits(options.limits, faults);
  const ChangeableDrive drive(closed_form_drive(written, options.servo));
  std::vector<std::string> parameters =
      read_parameters("--parameters", options.parameters, drive, faults);
  const Region region = read_region(options, drive, faults);
  faults.require_none();
  if (parameters.empty()) parameters = region.axes;
  if (parameters.empty()) parameters = drive.usual_names();
  LimitedWork work(limits);
  const DesignReport report{.drive = drive,
                            .target_text = options.target,
                            .target = target,
                            .answers = work_out(drive, target, parameters, work),
                            .angle = written.angle,
                            .is_normalized = is_normalized(written.drive),
                            .provenance = provenance};
  const RegionMapTask map{.drive = drive,
                          .target = target,
                          .target_text = options.target,
                          .cost = region.cost,
                          .angle = written.angle};
  Extras extras;
  extras.print(options.format == "json" ? design_json(report) : design_text(report));
  const std::size_t known = static_cast<std::size_t>(
      std::count_if(report.answers.begin(), report.answers.end(),
                    [](const FeasibleValues& values) { return !values.stopped; }));
  const ExitStatus status =
      end_work(work, ExitStatus::done, unknown_text(known, parameters.size()));
  for (const Plot& plot : plots) {
    extras.make([&] { write_file(plot.file, draw(map, region, plot, work)); });
  }
  return extras.status(status);
}

// ---- drives that are searched -------------------------------------------------------------------

std::vector<Axis> read_axes(const DesignOptions& options, const Drive& drive, Faults& faults) {
  std::vector<Axis> axes;
  for (const std::string& text :
       options.parameters.empty() ? usual_parameters(drive) : options.parameters) {
    axes.push_back(collect_axis(
        [&](auto* out) { return read_axis_or_name("--parameters", text, drive, out); }, faults));
  }
  if (!options.plots.empty()) {
    faults.add({"--plot", options.plots.front(),
                std::string(permitted_with_closed_form) +
                    "; of any drive, gearlash map draws a quantity over two parameters",
                ""});
  }
  return axes;
}

ExitStatus run_searched(const DesignOptions& options, const Target& target,
                        const WrittenDrive& written, const Provenance& provenance, Faults& faults) {
  const Drive& drive = written.drive;
  const std::vector<Axis> axes = read_axes(options, drive, faults);
  const Limits limits = read_limits(options.limits, faults);
  faults.require_none();
  LimitedWork work(limits);
  SearchedDesignReport report{.drive = drive,
                              .target_text = options.target,
                              .target = target,
                              .angle = written.angle,
                              .provenance = provenance};
  std::size_t known = 0;
  {
    TerminalProgress progress(work, "Design");
    report.present = with_value(drive, nullptr, 0.0, progress);
    for (const Axis& axis : axes) {
      ProgressPart part(progress, report.parameters.size(), axes.size());
      SearchedParameter found{.values = feasible_values(drive, axis, target, part)};
      for (const double value : found.values.nearest_of_each()) {
        found.results.push_back(with_value(drive, &axis, value, part));
      }
      report.parameters.push_back(std::move(found));
      if (!work.go_on()) break;
      ++known;
    }
  }
  Extras extras;
  extras.print(options.format == "json" ? design_json(report) : design_text(report));
  return extras.status(end_work(work, ExitStatus::done, unknown_text(known, axes.size())));
}

ExitStatus run(const DesignOptions& options, const Provenance& provenance) {
  Faults faults;
  check_options(options, faults);
  const std::vector<Plot> plots = read_plots(options.plots, {"region"}, faults);
  const std::optional<WrittenDrive> written = resolve_drive(options.servo, files_of(plots), faults);
  const bool has_time = !written || !is_normalized(written->drive);
  const Target target = faults.collect(
      [&] {
        return read_target("--target", options.target,
                           has_time ? TimeScale::known : TimeScale::unknown);
      },
      Target{});
  if (!written) faults.require_none();
  if (is_closed_form_task(written->drive, target, options.parameters)) {
    return run_closed_form(options, target, *written, plots, provenance, faults);
  }
  return run_searched(options, target, *written, provenance, faults);
}

}  // namespace

void add_design_command(Command& app, Action& action) {
  const auto options = std::make_shared<DesignOptions>();
  Command* command =
      app.add_subcommand("design", "Find the changes that stop the hunting or meet another target");
  add_servo_or_drive_options(*command, options->servo);
  command
      ->add_option("--target", options->target,
                   "Set the target: no-hunting, no-hunting-if-disturbed or no-runaway; or\n"
                   "amplitude, frequency, ceiling, bandwidth or any other quantity, then\n"
                   "<= or >=, then a limit; \"and\" joins several")
      ->type_name("TARGET")
      ->required();
  command
      ->add_option("--parameters", options->parameters,
                   "List the parameters that may change, by path, separated by commas:\n"
                   "gearbox.ratio, load.friction, ...; tachometer is added speed feedback;\n"
                   "the normal form has shares instead: gear_ratio, error_gain,\n"
                   "load_friction, motor_friction, load_inertia, motor_inertia; default\n"
                   "those of --vary, else those that are easiest to change. Of a drive\n"
                   "without a closed form any number or choice, searched from 0.1 to 10\n"
                   "times its present value or over PATH=FROM:TO:COUNT[:log], with units")
      ->type_name("NAMES")
      ->delimiter(',');
  command
      ->add_option("--vary", options->vary,
                   "Choose two parameters, separated by a comma; --plot draws where both\n"
                   "together meet the target, with lines of equal cost")
      ->type_name("X,Y")
      ->delimiter(',');
  command
      ->add_option("--cost", options->cost,
                   "Choose the cost: bandwidth (default), damping or stiffness")
      ->type_name("COST");
  add_plot_option(*command, options->plots,
                  "Draw region=FILE, where the parameters of --vary meet the\ntarget;");
  command->add_option("--format", options->format, "Choose the format: text (default) or json")
      ->type_name("FORMAT");
  add_limit_options(*command, options->limits);
  command->footer(help_footer(design_examples));
  set_action(*command, action, options, run);
}

}  // namespace gearlash::cli
