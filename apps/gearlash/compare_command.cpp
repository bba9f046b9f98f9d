// gearlash compare: drives, or the values of one parameter, side by side.
#include <algorithm>
#include <filesystem>
#include <set>

#include "base/lists.hpp"
#include "gearlash/comparison.hpp"
#include "gearlash/input.hpp"
#include "gearlash/units.hpp"
#include "grid_options.hpp"
#include "output/comparison_report.hpp"
#include "picture/report_pictures.hpp"
#include "verb.hpp"

namespace gearlash::cli {
namespace {

constexpr char compare_examples[] =
    "  gearlash compare examples/robot-joint.toml\n"
    "  gearlash compare examples/elinco-fd162.toml --sensor load,motor --plot time=step.svg\n"
    "  gearlash compare examples/robot-joint.toml examples/dynamixel-joint.toml --brief\n"
    "  gearlash compare examples/telescope-axis.toml --x gearbox.backlash=\"5 arcmin,10 arcmin\" "
    "\\\n"
    "      --step \"1 deg\" --quantities amplitude,static-error,settling-time\n"
    "  gearlash compare --damping 0.19 --inertia-ratio 2 --friction-ratio 0.1 --backlash 0.3 \\\n"
    "      --x restitution=0:0.6:4 --format json\n";

struct CompareOptions : QuestionOptions {
  std::vector<std::string> files;
  std::string x;
  std::vector<std::string> quantities;
  std::optional<std::string> until;
  bool brief = false;
};

struct CompareTask {
  std::vector<NamedDrive> drives;
  ComparisonOptions how;
  ComparisonReport report;  ///< without the drives
};

std::vector<Quantity> read_quantities(const std::vector<std::string>& names, Faults& faults) {
  std::vector<Quantity> chosen;
  const std::vector<std::string> known = names_of_quantities();
  for (const std::string& name : names) {
    const std::optional<Quantity> quantity = find_quantity(name);
    if (!quantity) faults.require_choice("--quantities", name, known);
    if (quantity && !contains(chosen, *quantity)) chosen.push_back(*quantity);
  }
  return chosen;
}

/// The files' stems, or where two are the same the files as typed.
std::vector<std::string> names_of(const std::vector<std::string>& files) {
  const std::vector<std::string> stems = of_each<std::string>(
      files, [](const std::string& file) { return std::filesystem::path(file).stem(); });
  const bool are_distinct = std::set(stems.begin(), stems.end()).size() == stems.size();
  return are_distinct ? stems : files;
}

void read_files(const CompareOptions& options, const std::vector<FileUse>& outputs,
                CompareTask& task, Faults& faults) {
  if (!options.x.empty()) {
    faults.add("--x", shown(options.x), "must be left out: several files are compared");
  }
  if (std::count(options.files.begin(), options.files.end(), "-") > 1) {
    faults.add("DRIVE.toml", "-", "must be given once: standard input is one drive");
    return;
  }
  const std::vector<std::string> names = names_of(options.files);
  for (std::size_t i = 0; i < names.size(); ++i) {
    ServoOptions servo = options.servo;
    servo.file = options.files[i];
    const std::optional<WrittenDrive> written = resolve_drive(servo, outputs, faults);
    if (!written) continue;
    task.drives.push_back({names[i], written->drive});
  }
}

/// --x; without it the places of the sensor.
void read_values(const CompareOptions& options, const std::vector<FileUse>& outputs,
                 CompareTask& task, Faults& faults) {
  ServoOptions servo = options.servo;
  if (!options.files.empty()) servo.file = options.files.front();
  AxisText text{"--sensor", "sensor.position", servo.sensor.value_or("load,motor,both")};
  if (options.x.empty()) servo.sensor.reset();
  if (!options.x.empty()) {
    text = faults.collect([&] { return split_axis("--x", options.x); }, AxisText{});
  }
  const bool is_read = !text.name.empty();
  const std::vector<AxisText> texts(is_read ? 1 : 0, text);
  const std::optional<WrittenDrive> written =
      read_fixed_drive(servo, texts, is_read, outputs, faults);
  if (!written || !is_read) return;
  const Drive drive = drive_of_axes(written->drive, texts);
  Axis axis = collect_axis([&](auto* out) { return read_axis(text, drive, out); }, faults);
  if (axis.values.size() > most_compared_drives) {
    faults.add(text.field, std::to_string(axis.values.size()) + " values",
               "must be at most " + std::to_string(most_compared_drives) +
                   "; gearlash chart has room for more");
  }
  faults.require_none();
  const std::string left_out = cut_to_sound(axis, drive);
  if (!left_out.empty()) report_lines(text.field + " " + axis.path + ": left out: " + left_out);
  task.drives = named_along(axis, drive);
  task.report.axis = std::move(axis);
}

CompareTask read_compare_task(const CompareOptions& options, const std::vector<PlotFile>& plots,
                              Faults& faults) {
  CompareTask task;
  faults.require_choice("--format", options.format, {"text", "json"});
  if (options.brief) {
    faults.refuse_beside_brief(
        {{"--quantities", listed(options.quantities)},
         {"--until", options.plots.empty() ? options.until.value_or("") : ""},
         {"--format", options.format == "text" ? "" : options.format}});
  }
  if (options.until) task.how.until = read_time("--until", *options.until, faults);
  if (!options.quantities.empty()) {
    task.report.quantities = read_quantities(options.quantities, faults);
  }
  if (options.files.size() > 1) {
    read_files(options, files_of(plots), task, faults);
  } else {
    read_values(options, files_of(plots), task, faults);
  }
  return task;
}

std::string printed(const ComparisonReport& report, const CompareOptions& options) {
  if (options.format == "json") return comparison_json(report);
  return fitted_to_output(options.brief ? comparison_headlines(report) : comparison_text(report));
}

ExitStatus run(const CompareOptions& options, const Provenance& provenance) {
  Faults faults;
  const std::vector<PlotFile> plots = read_plots(options.plots, {"time"}, faults);
  const Limits limits = read_limits(options.limits, faults);
  CompareTask task = read_compare_task(options, plots, faults);
  faults.require_none();

  task.report.provenance = provenance;
  task.how.motion_bytes = bytes_of_motion(limits, task.drives.size());
  LimitedWork work(limits);
  task.report.drives =
      compare(task.drives, task.how,
              TerminalProgress(work, "Comparing", task.drives.size(), "drives").as_argument());
  const bool decided = all_of(task.report.drives, [](const ComparedDrive& one) {
    return one.answer && is_decided(*one.answer);
  });
  return give({.text = printed(task.report, options),
               .is_decided = decided,
               .unknown = "searches are not complete, or not begun"},
              work, plots, [&](const PlotFile&) { return comparison_plot(task.report); });
}

}  // namespace

void add_compare_command(const Command& app, Action& action) {
  const auto [command, options] = add_verb<CompareOptions>(
      app, action, "compare", "Compare drives, or the values of one parameter, side by side",
      help_footer(compare_examples), run);
  command.add_option(
      "DRIVE.toml", options.files,
      "Read drives from these files: data sheets or normalised servos "
      "(docs/reference/data-sheets.md), or any drives (docs/reference/drives.md); - is "
      "standard input");
  command.add_option(
      "--x AXIS", options.x,
      "Compare one drive with these values: PATH=A,B,C, PATH=FROM:TO:COUNT or "
      "PATH=FROM:TO:COUNT:log, with units; PATH is any number or choice of the drive, "
      "or damping, inertia-ratio, … of the normal form; default "
      "sensor.position=load,motor,both");
  add_drive_options(
      command, options.servo,
      "Compare one drive with these places of the position sensor, as --x "
      "sensor.position=LIST does: load, motor and both (position of the load, speed of "
      "the motor); of several files, or with --x, one place");
  command.add_option("--quantities NAMES", options.quantities,
                     "Show these quantities, separated by commas: amplitude, static-error, … "
                     "(docs/reference/command-line.md)",
                     {.delimiter = ',', .takes_one_word = true});
  command.add_option(
      "--until TIME", options.until,
      "Set the end of the step responses; default twenty periods of each loop, or more "
      "where the load needs longer to rise");
  add_format_option(command, options.format);
  command.add_flag("--brief", options.brief, "Print the headlines alone");
  add_plot_option(command, options.plots, "Draw time=FILE, the step responses;");
  add_limit_options(command, options.limits);
}

}  // namespace gearlash::cli
