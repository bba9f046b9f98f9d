// gearlash design: the changes of a drive that meet a target.
#include <fmt/format.h>

#include <algorithm>

#include "base/lists.hpp"
#include "gearlash/input.hpp"
#include "grid_options.hpp"
#include "output/design_report.hpp"
#include "picture/grid_chart.hpp"
#include "picture/grid_map.hpp"
#include "question/change/design.hpp"
#include "verb.hpp"

namespace gearlash::cli {
namespace {

constexpr char design_examples[] =
    "  gearlash design examples/elinco-fd162.toml --target no-hunting\n"
    "  gearlash design examples/elinco-fd162.toml --target \"amplitude <= 1 deg and frequency >= 3 "
    "Hz\"\n"
    "  gearlash design examples/elinco-fd162.toml --target \"amplitude <= 30 arcmin\" \\\n"
    "      --parameters gearbox.backlash,gearbox.ratio --format json | jq "
    ".design.parameters[0].values.nearest\n"
    "  gearlash design examples/elinco-fd162.toml --target no-hunting \\\n"
    "      --vary load.friction,controller.proportional --plot region=region.svg\n"
    "  gearlash design examples/first-servo.toml --target \"no-hunting and bandwidth >= 2 Hz\" \\\n"
    "      --vary controller.proportional=10:80:8,gearbox.backlash --plot region=region.svg\n"
    "  gearlash design examples/dynamixel-joint.toml --target \"no-hunting and bandwidth >= 10 "
    "Hz\"\n"
    "  gearlash design examples/robot-joint.toml --target \"motor-amplitude <= 0.1 deg\" \\\n"
    "      --parameters controller.kind,controller.integral=0:100:5\n"
    "  gearlash design --damping 0.19 --inertia-ratio 2 --friction-ratio 1/10 --backlash 0.3 \\\n"
    "      --target \"amplitude <= 0.1\"\n";

struct DesignOptions : QuestionOptions {
  std::string target;
  std::vector<std::string> parameters;
  std::vector<std::string> vary;
  std::string quantity = "bandwidth";
};

/// "2 of 5 parameters are not searched to the end".
std::string unknown_text(std::size_t known, std::size_t all) {
  return fmt::format("{} of {} parameters {} not searched to the end", all - known, all,
                     all - known == 1 ? "is" : "are");
}

/// An axis of the picture as typed; of a name alone its ends: those of usual_axis() but for a
/// leading 0, by ratio three times as far.
Axis read_axis_to_draw(std::string_view field, std::string_view text, const Drive& drive,
                       std::string* left_out) {
  constexpr double farther = 3.0;
  Axis axis = read_axis_or_name(field, text, drive, left_out);
  const bool is_word = unit_of(axis, drive).empty();
  if (is_word || text.find('=') != std::string_view::npos) return axis;
  if (axis.logarithmic) {
    const double low = axis.values[axis.values.front() == 0.0 ? 1 : 0];
    axis.values = {low / farther, axis.values.back() * farther};
    cut_to_permitted(axis, drive);
  }
  axis.values = {axis.values.front(), axis.values.back()};
  return axis;
}

/// Puts as many values between its ends as some seconds allow, or minutes if faces bounce or drives
/// are searched.
void space(Axis& axis, const EnginesNeeded& engines) {
  const std::size_t count = engines.search ? 13 : engines.bounces ? 40 : 100;
  axis = spaced_axis("--vary", axis.path, axis.values.front(), axis.values.back(), count,
                     axis.logarithmic ? Spacing::logarithmic : Spacing::linear);
}

bool are_two(const std::vector<std::string>& names) {
  return names.size() == 2 && names[0] != names[1];
}

/// The map of --vary, with the first parameter along x.
GridTask read_region(const DesignOptions& options, const WrittenDrive& written,
                     const Target& target, Faults& faults) {
  GridTask task;
  task.title = "Map";
  task.grid.drive = written.drive;
  task.quantity = read_quantity(options.quantity, faults);
  task.has_boundary = true;
  task.target = target;
  task.target_text = options.target;
  if (!are_two(options.vary)) return task;
  std::vector<Axis>& axes = task.grid.axes;
  axes = collect_axes("--vary", options.vary, written.drive, read_axis_to_draw, faults);
  std::reverse(axes.begin(), axes.end());
  const std::vector<std::string> fields = {"--vary", "--vary"};
  if (axes.size() != 2) return task;
  faults.add(gearlash::faults(task.grid, fields));
  if (!faults.none()) return task;
  const EnginesNeeded engines = Family(task.grid).engines();
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const bool is_named = options.vary[1 - i].find('=') == std::string::npos;
    if (is_named && !unit_of(axes[i], written.drive).empty()) space(axes[i], engines);
  }
  require_an_area(task.grid, fields, faults);
  faults.add(faults_of_picture(task.grid, fields, false));
  task.present = place_on_map(task.grid);
  return task;
}

/// Checks that do not need the drive.
void check_options(const DesignOptions& options, Faults& faults) {
  faults.require_choice("--format", options.format, {"text", "json"});
  if (options.plots.empty() != options.vary.empty()) {
    faults.add(options.plots.empty()
                   ? Fault{"--plot", "",
                           "must name the picture that --vary asks for, such as region=region.svg"}
                   : Fault{"--vary", "", "must name the two parameters of the picture"});
  }
  if (!options.vary.empty() && !are_two(options.vary)) {
    faults.add("--vary", shown(listed(options.vary)),
               "must be two different parameters, separated by a comma");
  }
}

std::vector<Axis> read_axes(const DesignOptions& options, const Drive& drive, Faults& faults) {
  std::vector<std::string> texts = options.parameters.empty() ? options.vary : options.parameters;
  if (texts.empty()) texts = usual_parameters(drive);
  return collect_axes_to_search(texts, drive, faults);
}

ExitStatus run(const DesignOptions& options, const Provenance& provenance) {
  Faults faults;
  check_options(options, faults);
  const std::vector<PlotFile> plots = read_plots(options.plots, {"region"}, faults);
  const std::optional<WrittenDrive> written = resolve_drive(options.servo, files_of(plots), faults);
  const Target target = collect_target(options.target, written ? &written->drive : nullptr, faults);
  if (!written) faults.require_none();
  const Drive& drive = written->drive;
  const std::vector<Axis> axes = read_axes(options, drive, faults);
  const GridTask region = read_region(options, *written, target, faults);
  const Limits limits = read_limits(options.limits, faults);
  faults.require_none();
  LimitedWork work(limits);
  DesignReport report{
      .drive = drive, .target_text = options.target, .target = target, .provenance = provenance};
  report.design = design(drive, axes, target, TerminalProgress(work, "Design").as_argument());
  const std::size_t known = count_of(
      report.design.parameters, [](const DesignedParameter& one) { return !one.values.stopped; });
  std::optional<GridTable> table;
  return give({.text = options.format == "json" ? design_json(report)
                                                : fitted_to_output(design_text(report)),
               .unknown = unknown_text(known, axes.size())},
              work, plots, [&](const PlotFile& plot) {
                if (!table) table = work_out(region, work, provenance).table;
                if (work.is_stopped()) refuse_to_draw(plot);
                return map_plot(*table, region.quantity);
              });
}

}  // namespace

void add_design_command(const Command& app, Action& action) {
  const auto [command, options] = add_verb<DesignOptions>(
      app, action, "design", "Find the changes that stop the hunting or meet another target",
      help_footer(design_examples), run);
  add_servo_or_drive_options(command, options.servo);
  command.add_option("--target TARGET", options.target,
                     "Set the target: no-hunting, no-hunting-if-disturbed or no-runaway; or "
                     "amplitude, frequency, ceiling, bandwidth or any other quantity, then <= or "
                     ">=, then a limit; \"and\" joins several",
                     {.is_required = true});
  command.add_option(
      "--parameters NAMES", options.parameters,
      "List the parameters that may change, separated by commas: any number or choice by its path, "
      "such as gearbox.ratio, or with a range, PATH=FROM:TO:COUNT[:log], with units; default those "
      "of --vary, else those that are easiest to change. Without a range: 0.1 to 10 times the "
      "present value, of a servo as that of 1960 0.001 to 1000 times",
      {.delimiter = ','});
  command.add_option("--vary X,Y", options.vary,
                     "Choose two parameters, separated by a comma, each with or without a range; "
                     "--plot draws where both together meet the target",
                     {.delimiter = ','});
  command.add_option("--quantity NAME", options.quantity,
                     "Draw contours of this quantity beside it: bandwidth (default), phase-margin, "
                     "amplitude, …");
  add_plot_option(command, options.plots,
                  "Draw region=FILE, where the parameters of --vary meet the target;");
  add_format_option(command, options.format);
  add_limit_options(command, options.limits);
}

}  // namespace gearlash::cli
