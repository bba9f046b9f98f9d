// gearlash compare: the same drive with its sensor before and after the gap.
#include <algorithm>
#include <memory>
#include <sstream>

#include "command.hpp"
#include "input/units.hpp"
#include "limit_options.hpp"
#include "machine_faults.hpp"
#include "output/comparison_report.hpp"
#include "output/output_file.hpp"
#include "picture/comparison_picture.hpp"
#include "plot_option.hpp"
#include "servo_options.hpp"
#include "terminal.hpp"

namespace gearlash::cli {
namespace {

constexpr char compare_examples[] =
    "  gearlash compare examples/robot-joint.toml --sensor load,motor,both\n"
    "  gearlash compare examples/elinco-fd162.toml --sensor load,motor --plot time=step.svg\n"
    "  gearlash compare examples/telescope-axis.toml --step \"1 arcmin\" --format json\n";

struct CompareOptions {
  ServoOptions servo;
  std::string sensors = "load,motor,both";
  std::optional<std::string> step;
  std::optional<std::string> until;
  std::string format = "text";
  LimitOptions limits;
  std::vector<std::string> plots;
};

std::vector<SensorPlace> read_sensors(const std::string& text, Faults& faults) {
  std::vector<SensorPlace> places;
  std::istringstream stream(text);
  for (std::string name; std::getline(stream, name, ',');) {
    const std::optional<SensorPlace> place = sensor_named(name);
    if (place && std::find(places.begin(), places.end(), *place) == places.end()) {
      places.push_back(*place);
    } else {
      faults.add({"--sensor", shown(text),
                  "must be a list of load, motor and both, each once, such as load,motor", ""});
      return {};
    }
  }
  if (places.empty()) faults.add({"--sensor", shown(text), "must name load, motor or both", ""});
  return places;
}

/// As typed, else usual_step().
drive::Step read_step(const CompareOptions& options, const WrittenDrive& written, Faults& faults) {
  std::optional<double> size;
  std::optional<double> until;
  if (options.step) {
    size = faults.collect([&] { return read_angle("--step", *options.step).si; }, 1.0);
  }
  if (options.until) {
    until =
        faults.collect([&] { return read_si("--until", *options.until, dimensions::time); }, 1.0);
  }
  return faults.collect(
      [&] {
        return step_of_comparison(written.drive, size, until, {"--step", "--until"});
      },
      drive::Step{});
}

ExitStatus run(const CompareOptions& options, const Provenance& provenance) {
  Faults faults;
  faults.require_choice("--format", options.format, {"text", "json"});
  const std::vector<Plot> plots = read_plots(options.plots, {"time"}, faults);
  const std::vector<SensorPlace> places = read_sensors(options.sensors, faults);
  const std::optional<WrittenDrive> written = resolve_drive(options.servo, files_of(plots), faults);
  const drive::Step step = written ? read_step(options, *written, faults) : drive::Step{};
  const Limits limits = read_limits(options.limits, faults);
  faults.require_none();

  LimitedWork work(limits);
  ComparisonReport report;
  {
    TerminalProgress progress(work, "Comparing");
    report = compare_sensors(written->drive, places, step, {written->angle, provenance}, progress);
  }
  Extras extras;
  extras.print(options.format == "json" ? comparison_json(report) : comparison_text(report));
  const bool decided =
      std::none_of(report.cases.begin(), report.cases.end(), [](const SensorCase& one) {
        return one.report.answer.verdict == Verdict::undecided || !one.response.is_whole;
      });
  const ExitStatus status = end_work(work, decided ? ExitStatus::done : ExitStatus::undecided,
                                     "searches are not complete, or not begun");
  for (const Plot& plot : plots) {
    extras.make([&] { write_file(plot.file, draw_comparison(report, plot.format)); });
  }
  return extras.status(status);
}

}  // namespace

void add_compare_command(Command& app, Action& action) {
  const auto options = std::make_shared<CompareOptions>();
  Command* command = app.add_subcommand(
      "compare", "Compare a drive with its sensor before and after the gap, side by side");
  command
      ->add_option("DRIVE.toml", options->servo.file,
                   "Read the drive from this file: a data sheet or normalised servo\n"
                   "(docs/reference/data-sheets.md), or any drive\n"
                   "(docs/reference/drives.md)")
      ->type_name("")
      ->required();
  add_set_option(*command, options->servo);
  command
      ->add_option("--sensor", options->sensors,
                   "Compare these places of the sensor: load, motor, both (position of\n"
                   "the load, speed of the motor); default load,motor,both")
      ->type_name("LIST");
  command
      ->add_option("--step", options->step,
                   "Set the step of the reference, in rad or with a unit; default ten\n"
                   "times the backlash, or 1 deg without one")
      ->type_name("ANGLE");
  command
      ->add_option("--until", options->until,
                   "Set the end of the step response; default twenty periods of the loop")
      ->type_name("TIME");
  command->add_option("--format", options->format, "Choose the format: text (default) or json")
      ->type_name("FORMAT");
  add_plot_option(*command, options->plots, "Draw time=FILE, the step responses;");
  add_limit_options(*command, options->limits);
  command->footer(help_footer(compare_examples));
  set_action(*command, action, options, run);
}

}  // namespace gearlash::cli
