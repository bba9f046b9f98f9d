// gearlash design: the changes of a drive that meet a target.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "base/progress_part.hpp"
#include "command.hpp"
#include "input/axis_text.hpp"
#include "input/target_text.hpp"
#include "limit_options.hpp"
#include "machine_faults.hpp"
#include "model/reduced_drive.hpp"
#include "output/design_report.hpp"
#include "output/output_file.hpp"
#include "picture/region_map.hpp"
#include "plot_option.hpp"
#include "question/axis.hpp"
#include "question/change/closed_form_line.hpp"
#include "question/change/drive_with_value.hpp"
#include "question/change/feasible_values.hpp"
#include "question/final_servo.hpp"
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

/// The picture: the two parameters of --vary, y over x.
struct Region {
  std::vector<Axis> axes{};
  Cost cost = Cost::bandwidth;
};

Region read_region(const DesignOptions& options, const Drive& drive, Faults& faults) {
  constexpr char field[] = "--vary";
  Region region;
  for (const Cost cost : {Cost::bandwidth, Cost::damping, Cost::stiffness}) {
    if (options.cost == name_of(cost)) region.cost = cost;
  }
  if (!options.vary.empty() && !closed_form_drive(drive)) {
    faults.add({field, fmt::format("{}", fmt::join(options.vary, ",")),
                std::string(permitted_with_closed_form) +
                    "; of any drive, gearlash map draws a quantity over two parameters",
                ""});
    return region;
  }
  std::vector<std::string> paths;
  for (const std::string& name : options.vary) {
    paths.push_back(path_named(name, drive));
    if (ClosedFormLine::along(drive, paths.back())) continue;
    faults.add({field, name, "must be a number that enters the closed form", ""});
    return region;
  }
  if (paths.size() != 2) return region;
  const std::size_t count = values_to_draw(drive, paths[0], paths[1]);
  for (const std::string& path : paths) {
    region.axes.push_back(axis_to_draw(drive, path, count));
    if (region.axes.back().values.size() > 1) continue;
    faults.add({field, path,
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
  TerminalProgress progress(work, "Region");
  const ContourMap map = map_of(task, region.axes[0], region.axes[1], progress);
  if (work.is_stopped()) throw OutputError(plot.file + ": not drawn: the work was stopped before");
  return draw_contour_map(map, plot.format);
}

std::vector<Axis> read_axes(const DesignOptions& options, const Drive& drive, Faults& faults) {
  std::vector<std::string> texts = options.parameters.empty() ? options.vary : options.parameters;
  if (texts.empty()) texts = usual_parameters(drive);
  std::vector<Axis> axes;
  for (const std::string& text : texts) {
    axes.push_back(collect_axis(
        [&](auto* out) { return read_axis_to_search("--parameters", text, drive, out); }, faults));
  }
  return axes;
}

/// Fills in the report as far as the work is not stopped. Returns how many axes were searched.
std::size_t work_out(const std::vector<Axis>& axes, DesignReport& report, LimitedWork& work) {
  TerminalProgress progress(work, "Design");
  const Drive& drive = report.drive;
  std::size_t known = 0;
  report.present = with_value(drive, nullptr, 0.0, report.target, progress);
  report.met = judge_present(drive, report.target, report.present.answer);
  for (const Axis& axis : axes) {
    ProgressPart part(progress, report.parameters.size(), axes.size());
    DesignedParameter found{.values = feasible_values(drive, axis, report.target, part)};
    for (const double value : found.values.nearest_of_each()) {
      found.results.push_back(with_value(drive, &axis, value, report.target, part));
    }
    report.parameters.push_back(std::move(found));
    if (!work.go_on()) break;
    ++known;
  }
  return known;
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
  const Drive& drive = written->drive;
  const std::vector<Axis> axes = read_axes(options, drive, faults);
  const Region region = read_region(options, drive, faults);
  const Limits limits = read_limits(options.limits, faults);
  faults.require_none();
  LimitedWork work(limits);
  DesignReport report{.drive = drive,
                      .target_text = options.target,
                      .target = target,
                      .angle = written->angle,
                      .provenance = provenance};
  const std::size_t known = work_out(axes, report, work);
  Extras extras;
  extras.print(options.format == "json" ? design_json(report) : design_text(report));
  const ExitStatus status = end_work(work, ExitStatus::done, unknown_text(known, axes.size()));
  const RegionMapTask map{.drive = drive,
                          .target = target,
                          .target_text = options.target,
                          .cost = region.cost,
                          .angle = written->angle};
  for (const Plot& plot : plots) {
    extras.make([&] { write_file(plot.file, draw(map, region, plot, work)); });
  }
  return extras.status(status);
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
                   "List the parameters that may change, separated by commas: any number or\n"
                   "choice by its path, such as gearbox.ratio, or with a range,\n"
                   "PATH=FROM:TO:COUNT[:log], with units; default those of --vary, else\n"
                   "those that are easiest to change. Without a range: 0.001 to 1000 times\n"
                   "the present value where the closed form answers, else 0.1 to 10 times")
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
