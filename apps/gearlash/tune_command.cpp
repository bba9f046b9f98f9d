// gearlash tune: the best values of several parameters for a whole series.
#include <numbers>

#include "base/lists.hpp"
#include "gearlash/analyse.hpp"
#include "gearlash/input.hpp"
#include "gearlash/parameter.hpp"
#include "gearlash/tune.hpp"
#include "output/tune_report.hpp"
#include "question/axis.hpp"
#include "verb.hpp"

namespace gearlash::cli {
namespace {

constexpr char tune_examples[] =
    "  gearlash tune examples/toleranced-joint.toml --set controller.kind=PD\n"
    "  gearlash tune examples/toleranced-joint.toml --target \"motor-amplitude <= 0.3 deg\" \\\n"
    "      --parameters controller.integral=20:600,controller.proportional --share \"95 %\"\n"
    "  gearlash tune examples/robot-joint.toml --set controller.kind=PD --for static-error \\\n"
    "      --write tuned.toml\n";

constexpr char tune_explanation[] =
    "The series is what the tolerances of DRIVE.toml permit (gearlash tolerance --help shows how "
    "to write them); without tolerances it is the one drive. The target, if none is given, is to "
    "come "
    "to rest, or to hunt by no more than one step of the encoder.\n\n";

struct TuneOptions : QuestionOptions {
  std::vector<std::string> parameters;
  std::string target;
  std::string aim = "bandwidth";
  std::string share = "100 %";
  std::string phase_margin = "30 deg";
  std::string units = "64";
  std::string seed = "1960";
  std::string write;
};

/// The usual target in words.
std::string text_of_usual(const Target& target, const Drive& drive) {
  if (target.limits.empty()) return "no-hunting and no-runaway";
  const QuantityLimit& limit = target.limits.front();
  return std::string(limit.quantity == Quantity::amplitude ? "amplitude" : "motor-amplitude") +
         " <= " + DriveUnits(drive).angle(limit.permitted.high) +
         " (one step of the encoder) and no-runaway";
}

struct TuneRequest {
  TuneReport report;  ///< without the answer
  TuneEffort effort;
  Limits limits;
};

Aim read_aim(const std::string& text, Faults& faults) {
  faults.require_choice("--for", text, {"bandwidth", "settling", "static-error"});
  if (text == "settling") return Aim::settling;
  return text == "static-error" ? Aim::static_error : Aim::bandwidth;
}

void read_numbers(const TuneOptions& options, TuneTask& task, TuneEffort& effort, Faults& faults) {
  task.aim = read_aim(options.aim, faults);
  task.share = read_share("--share", options.share, faults);
  task.least_phase_margin = faults.collect(
      [&] { return read_measured("--phase-margin", options.phase_margin, dimensions::angle).si; },
      task.least_phase_margin);
  constexpr double right_angle = 0.5 * std::numbers::pi;
  if (!(task.least_phase_margin >= 0.0 && task.least_phase_margin <= right_angle)) {
    faults.add("--phase-margin", shown(options.phase_margin),
               "must be an angle from 0 to 90 deg, with its unit");
  }
  constexpr std::size_t most_units = 100'000;
  effort.units = collect_whole("--units", options.units, 1, most_units, faults);
  effort.seed = collect_whole("--seed", options.seed, 0, std::uint64_t{1} << 53U, faults);
}

TuneRequest read_request(const TuneOptions& options) {
  TuneRequest request;
  TuneReport& report = request.report;
  TuneTask& task = report.task;
  Faults faults;
  faults.require_choice("--format", options.format, {"text", "json"});
  read_numbers(options, task, request.effort, faults);
  request.limits = read_limits(options.limits, faults);
  const std::optional<WrittenDrive> written =
      resolve_drive(options.servo, {{"--write", options.write}}, faults);
  if (!written) faults.require_none();
  const Drive& drive = written->drive;
  task.series = {drive, written->tolerances};
  const auto names = options.parameters.empty() ? usual_gains(drive) : options.parameters;
  task.tuned = collect_axes("--parameters", names, drive, read_axis_to_tune, faults);
  if (names.empty()) {
    faults.add("--parameters", "", "must name what to tune: the drive has no gain above 0");
  }
  report.target_text = options.target;
  if (options.target.empty()) {
    task.target = usual_target(drive);
    report.target_text = text_of_usual(task.target, drive);
  } else {
    task.target = collect_target(options.target, &drive, faults);
  }
  faults.require_none();
  std::erase_if(task.series.varied, [&](const ParameterTolerance& varied) {
    return any_of(task.tuned,
                  [&](const Axis& axis) { return parameter_of(axis, drive)->path == varied.path; });
  });
  return request;
}

ExitStatus run(const TuneOptions& options, const Provenance& provenance) {
  const auto [asked, effort, limits] = read_request(options);
  TuneReport report = asked;
  report.provenance = provenance;
  LimitedWork work(limits);
  report.tuned = tune(report.task, effort, TerminalProgress(work, "Tune").as_argument());
  const auto lesser = without_integral_action(report.task);
  if (!report.tuned.meets && !work.is_stopped() && lesser) {
    report.without_integral =
        tune(*lesser, effort, TerminalProgress(work, "Tune without integral action").as_argument());
  }
  {
    TerminalProgress progress(work, "Searching");
    report.present = analyse(report.task.series.nominal, {.proofs = false}, progress);
    report.nominal = analyse(report.tuned.drive, {.proofs = false}, progress);
  }
  return give(
      {.text = options.format == "json" ? tune_json(report) : fitted_to_output(tune_text(report)),
       .unknown = report.tuned.stopped ? "the values are the best by then"
                                       : "what these values do is not"},
      work, [&](Extras& extras) {
        if (options.write.empty()) return;
        extras.make([&] { write_file(options.write, tuned_toml(report)); });
      });
}

}  // namespace

void add_tune_command(const Command& app, Action& action) {
  const auto [command, options] = add_verb<TuneOptions>(
      app, action, "tune",
      "Find the best values of several parameters for a whole series of drives",
      tune_explanation + help_footer(tune_examples), run);
  add_servo_or_drive_options(command, options.servo);
  command.add_option("--parameters NAMES", options.parameters,
                     "List the numbers to tune, by path, separated by commas, each from 0.1 to 10 "
                     "times its present value, or over PATH=FROM:TO with units; default: the "
                     "controller's gains that are above 0",
                     {.delimiter = ','});
  command.add_option("--target TARGET", options.target,
                     "Set the target that each unit must meet, written as for design");
  command.add_option(
      "--for AIM", options.aim,
      "Choose what is best: the greatest bandwidth (default), the shortest settling or "
      "the least static-error, of the worst unit");
  command.add_option("--share SHARE", options.share,
                     "Set the share of the units that must meet the target; default 100 %");
  command.add_option("--phase-margin ANGLE", options.phase_margin,
                     "Set the least phase margin of the linear loop; default 30 deg");
  command.add_option("--units N", options.units,
                     "Set the number of units to which each proposal is put; default 64");
  command.add_option("--seed N", options.seed, "Set the seed of the units; default 1960");
  command.add_option("--write FILE", options.write, "Write the tuned drive to this file");
  add_format_option(command, options.format);
  add_limit_options(command, options.limits);
}

}  // namespace gearlash::cli
