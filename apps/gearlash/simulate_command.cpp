// gearlash simulate: the exact motion under a reference, or from a disturbance.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "base/range_check.hpp"
#include "gearlash/analyse.hpp"
#include "gearlash/motion.hpp"
#include "gearlash/units.hpp"
#include "output/motion_report.hpp"
#include "picture/motion_picture.hpp"
#include "verb.hpp"

namespace gearlash::cli {
namespace {

constexpr char simulate_examples[] =
    "  gearlash simulate examples/elinco-fd162.toml > step.csv\n"
    "  gearlash simulate examples/elinco-fd162.toml --until 3 --plot time=step.svg\n"
    "  gearlash simulate examples/robot-joint.toml --events --output events.csv\n"
    "  gearlash simulate --damping 0.2 --inertia-ratio 4 --friction-ratio 1/4 --backlash 0.3 \\\n"
    "      --reference 0 --initial-position 0.01 --format json --plot phase=growth.png\n";

constexpr double default_samples = 1000.0;
/// A table this long takes about a gigabyte.
constexpr double most_samples = 1e7;

struct SimulateOptions : QuestionOptions {
  SimulateOptions() { format = "csv"; }

  std::optional<std::string> initial_position;
  std::optional<std::string> initial_speed;
  std::optional<std::string> initial_gap;
  std::optional<std::string> initial_gap_speed;
  std::optional<std::string> reference;
  std::optional<std::string> until;
  std::optional<std::string> every;
  bool events = false;
  std::string output = "-";
};

/// An option of the motion.
struct MotionOption {
  const char* name;  ///< with what the help shows for its value
  const char* path;  ///< of its faults; empty where simulate() has none
  std::optional<std::string> SimulateOptions::*typed;
  const char* help;
};

constexpr MotionOption motion_options[] = {
    {"--initial-position ANGLE", "start.load_position", &SimulateOptions::initial_position,
     "Set the initial position of the load; default 0"},
    {"--initial-speed SPEED", "start.load_speed", &SimulateOptions::initial_speed,
     "Set the initial speed of both shafts; default 0; --initial-gap-speed adds to the motor's"},
    {"--initial-gap ANGLE", "start.gap", &SimulateOptions::initial_gap,
     "Set the initial position of the motor minus that of the load, within half the backlash each "
     "way; default on the face that the reference pulls to"},
    {"--initial-gap-speed SPEED", "start.gap_speed", &SimulateOptions::initial_gap_speed,
     "Set the initial speed of the motor minus that of the load; default 0"},
    {"--reference ANGLE", "", &SimulateOptions::reference,
     "Set a constant reference; default the file's reference, else a step of five backlashes, at "
     "least twenty encoder counts and three times the error that friction holds"},
    {"--until TIME", "until", &SimulateOptions::until,
     "Set the end time; default 10 periods of the loop plus twice the settling time of the "
     "signals; pictures go on for eight periods of slow hunting"},
    {"--every TIME", "", &SimulateOptions::every,
     "Set the time between samples; default a thousandth of --until"}};

/// The task, in SI.
struct SimulateRequest {
  WrittenDrive written{};
  Start start{};
  double period = 1.0;  ///< of the loop
  double until = 0.0;
  double every = 0.0;
};

Start read_start(const SimulateOptions& options, Faults& faults) {
  const auto read = [&](const char* field, const std::optional<std::string>& text,
                        const Dimension& dimension) -> std::optional<double> {
    if (!text) return std::nullopt;
    return faults.collect([&] { return read_measured(field, *text, dimension).si; }, 0.0);
  };
  const auto& [angle, speed] = std::tie(dimensions::angle, dimensions::angular_speed);
  return {
      .load_position = read("--initial-position", options.initial_position, angle).value_or(0.0),
      .load_speed = read("--initial-speed", options.initial_speed, speed).value_or(0.0),
      .gap = read("--initial-gap", options.initial_gap, angle),
      .gap_speed = read("--initial-gap-speed", options.initial_gap_speed, speed).value_or(0.0)};
}

/// From --reference, else from the file, else a step. Its unit is used if the file has radians.
void set_reference(const std::optional<Measured>& typed, WrittenDrive& written) {
  if (typed) {
    written.drive.reference = typed->si;
    if (written.drive.angle_unit.radians == 1.0) {
      written.drive.angle_unit = angle_unit_of(*typed);
    }
  } else if (!written.drive.reference) {
    written.drive.reference = usual_step(written.drive);
  }
}

/// `drive` is nullptr if it has faults.
void read_times(const SimulateOptions& options, const Drive* drive, SimulateRequest& task,
                Faults& faults) {
  task.period = drive != nullptr ? period_of_loop(*drive) : 1.0;
  task.until = drive != nullptr ? usual_time(*drive) : 1.0;
  if (options.until) task.until = read_time("--until", *options.until, faults);
  task.every = task.until / default_samples;
  if (options.every) task.every = read_time("--every", *options.every, faults);
  if (!options.events && faults.none() && !(task.until / task.every < most_samples)) {
    faults.add("--every", exact_text(task.every),
               fmt::format("must be more than {} s: at most {} samples in {} s",
                           significant(task.until / most_samples, 6), significant(most_samples, 3),
                           exact_text(task.until)));
  }
}

SimulateRequest read_task(const SimulateOptions& options, const std::vector<FileUse>& outputs,
                          Faults& faults) {
  SimulateRequest task;
  const std::optional<WrittenDrive> written = resolve_drive(options.servo, outputs, faults);
  task.start = read_start(options, faults);
  std::optional<Measured> reference;
  if (options.reference) {
    reference = faults.collect(
        [&] { return read_measured("--reference", *options.reference, dimensions::angle); },
        Measured{});
  }
  if (written) {
    task.written = *written;
    set_reference(reference, task.written);
  }
  read_times(options, written ? &task.written.drive : nullptr, task, faults);
  faults.require_none();
  return task;
}

/// Reports faults of the span under the options that were typed.
Motion simulated(const SimulateRequest& task, const SimulateOptions& options, LimitedWork& work) {
  try {
    return simulate(task.written.drive, {.until = task.until, .start = task.start},
                    TerminalProgress(work, "Simulating").as_argument());
  } catch (const InvalidInput& error) {
    std::vector<Fault> faults = error.faults();
    for (Fault& fault : faults) {
      for (const MotionOption& option : motion_options) {
        if (fault.path != option.path) continue;
        fault.path = std::string(option.name, std::strchr(option.name, ' '));
        fault.value = shown((options.*option.typed).value_or(fault.value));
      }
    }
    throw InvalidInput(faults);
  }
}

// ---- pictures -----------------------------------------------------------------------------------

std::string title_of(const SimulateRequest& task) {
  const DriveUnits units(task.written.drive);
  const Signal reference = task.written.drive.reference.value_or(Signal{});
  const bool is_at_rest = task.start.load_position == 0.0 && task.start.load_speed == 0.0;
  if (!is_at_rest) {
    return fmt::format("Motion from {}, {}/s", units.angle(task.start.load_position),
                       units.angle(task.start.load_speed));
  }
  if (const auto* constant = std::get_if<double>(&reference))
    return "Step to " + units.angle(*constant);
  const auto* step = std::get_if<StepSignal>(&reference);
  return step != nullptr ? "Step to " + units.angle(step->after) : "Response to the reference";
}

struct KnownHunting {
  std::string headline;
  double period = 0.0;  ///< s; 0: none is known
};

KnownHunting hunting_of(const WrittenDrive& written, LimitedWork& work) {
  const Answer answer =
      analyse(written.drive, {.proofs = false}, TerminalProgress(work, "Searching").as_argument());
  return {headline(written.drive, answer), answer.value(Quantity::period).value_or(0.0)};
}

/// The motion until its hunting shows, unless --until was typed. Tables end earlier.
Motion motion_to_draw(const SimulateRequest& task, const Motion& motion,
                      const SimulateOptions& options, double hunting_period, LimitedWork& work) {
  constexpr double periods = 8.0;
  const double until = task.until + periods * hunting_period;
  const double longest = 0.5 * most_periods_drawn * task.period;
  const bool shows = periods * hunting_period < task.until;
  if (options.until || motion.stop() != MotionStop::reached_end || shows || until > longest) {
    return motion;
  }
  Motion longer = simulate(task.written.drive, {.until = until, .start = task.start},
                           TerminalProgress(work, "Simulating").as_argument());
  const bool is_drawn =
      longer.stop() != MotionStop::stopped && longer.events().size() <= most_events_drawn;
  return is_drawn ? longer : motion;
}

MotionPicture picture_of(const SimulateRequest& task, const Motion& motion,
                         const SimulateOptions& options, LimitedWork& work) {
  const KnownHunting hunting = hunting_of(task.written, work);
  return {.title = title_of(task),
          .subtitle = hunting.headline,
          .drive = task.written.drive,
          .motions = {{.motion = motion_to_draw(task, motion, options, hunting.period, work)}},
          .period = task.period,
          .hunting_period = hunting.period};
}

// ---- the command --------------------------------------------------------------------------------

void write_table(const MotionReport& report, const SimulateOptions& options, LimitedWork& work) {
  OutputFile output(options.output);
  TerminalProgress progress(work, "Writing");
  const TextSink sink = [&](std::string_view text) { output.write(text); };
  if (options.format == "json") {
    write_motion_json(report, sink, progress);
  } else if (options.events) {
    write_events_csv(report, sink);
  } else {
    write_samples_csv(report, sink, progress);
  }
  // A signal leaves a file as it was.
  if (options.output == "-" || !work.is_interrupted()) output.commit();
}

ExitStatus run(const SimulateOptions& options, const Provenance& provenance) {
  Faults faults;
  faults.require_choice("--format", options.format, {"csv", "json"});
  const std::vector<PlotFile> plots = read_plots(options.plots, {"time", "phase"}, faults);
  std::vector<FileUse> outputs = files_of(plots);
  outputs.insert(outputs.begin(), {"--output", options.output});
  const Limits limits = read_limits(options.limits, faults);
  const SimulateRequest task = read_task(options, outputs, faults);
  LimitedWork work(limits);
  const Motion motion = simulated(task, options, work);
  Extras extras;
  extras.make([&] {
    write_table({.drive = task.written.drive,
                 .motion = motion,
                 .until = task.until,
                 .every = task.every,
                 .provenance = provenance},
                options, work);
  });
  const bool is_whole = motion.stop() == MotionStop::reached_end;
  const std::string reached =
      fmt::format("{} s of {} s", exact_text(motion.end_time()), exact_text(task.until));
  if (!is_whole && !work.is_stopped()) {
    report_lines("stopped at " + reached + ": " + motion.stop_text());
  }
  const ExitStatus status = end_work(
      work, is_whole ? ExitStatus::done : ExitStatus::undecided,
      is_whole ? "the end of the table is missing" : "the motion is known up to " + reached);
  std::optional<MotionPicture> picture;
  for (const PlotFile& plot : plots) {
    extras.make([&] {
      if (!picture) picture = picture_of(task, motion, options, work);
      write_plot(plot, plot.kind == "phase" ? phase_plot(*picture) : time_plot(*picture));
    });
  }
  return extras.status(status);
}

}  // namespace

void add_simulate_command(const Command& app, Action& action) {
  const auto [command, options] = add_verb<SimulateOptions>(
      app, action, "simulate", "Compute the exact motion after a step or a disturbance",
      help_footer(simulate_examples), run);
  const OptionRules rules{.group =
                              "Motion (in rad, s and rad/s, or with a unit: \"50 ms\", \"3 rpm\")"};
  for (const MotionOption& option : motion_options) {
    command.add_option(option.name, options.*option.typed, option.help, rules);
  }
  command.add_flag(
      "--events", options.events,
      "List events (faces meet, part; shafts stick) instead of samples; JSON has both");
  command.add_option("--format FORMAT", options.format, "Choose the format: csv (default) or json");
  add_plot_option(command, options.plots,
                  "Draw time=FILE, the response, the gap and the torque, or phase=FILE, the phase "
                  "plane;");
  command.add_option("--output FILE", options.output,
                     "Write the table to this file; default standard output");
  add_limit_options(command, options.limits);
  add_servo_or_drive_options(command, options.servo);
}

}  // namespace gearlash::cli
