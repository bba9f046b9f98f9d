// gearlash simulate: the exact motion after a step or from a disturbance.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "base/range_check.hpp"
#include "command.hpp"
#include "input/units.hpp"
#include "machine_faults.hpp"
#include "picture/picture.hpp"
#include "servo_options.hpp"
#include "simulate_options.hpp"

namespace gearlash::cli {
namespace {

constexpr char examples[] =
    "  gearlash simulate examples/elinco-fd162.toml > step.csv\n"
    "  gearlash simulate examples/elinco-fd162.toml --until 3 --plot time=step.svg\n"
    "  gearlash simulate examples/elinco-fd162.toml --events --output events.csv\n"
    "  gearlash simulate --damping 0.2 --inertia-ratio 4 --friction-ratio 1/4 --backlash 0.3 \\\n"
    "      --reference 0 --initial-position 0.01 --format json --plot phase=growth.png\n"
    "  gearlash simulate examples/robot-joint.toml --events\n";

constexpr double default_periods = 10.0;
constexpr double default_samples = 1000.0;

MotionPlot read_plot(const std::string& text) {
  const std::size_t equals = text.find('=');
  const std::string kind = text.substr(0, equals);
  if (equals == std::string::npos || (kind != "time" && kind != "phase")) {
    throw InvalidInput({{"--plot", shown(text), "must be time=FILE or phase=FILE", ""}});
  }
  const std::string file = text.substr(equals + 1);
  return {kind == "phase", file, picture_format("--plot", file)};
}

std::vector<MotionPlot> read_plots(const SimulateOptions& options, Faults& faults) {
  std::vector<MotionPlot> plots;
  for (const std::string& text : options.plots) {
    plots.push_back(faults.collect([&] { return read_plot(text); }, MotionPlot{}));
  }
  return plots;
}

/// Times in the report's unit: seconds, or 1/ω_n.
struct Times {
  double until;
  double every;
};

double read_positive(const char* field, const std::string& text, const ReportUnits& units) {
  const double number = read_scaled(field, text, dimensions::time, units, units.time_unit());
  if (number > 0.0) return number;
  throw InvalidInput(
      {{field, shown(text), fmt::format("must be positive, in {}", units.time_unit()), ""}});
}

Times read_times(const SimulateOptions& options, const ReportUnits& units) {
  Faults faults;
  Times times{units.time(default_periods * 2.0 * std::numbers::pi), 0.0};
  if (options.until) {
    times.until = faults.collect([&] { return read_positive("--until", *options.until, units); },
                                 times.until);
    if (units.normalized_time(times.until) > longest_simulation) {
      faults.add({"--until", shown(*options.until),
                  fmt::format("must be at most {} {}",
                              significant(units.time(longest_simulation), 6), units.time_unit()),
                  ""});
    }
  }
  times.every = times.until / default_samples;
  if (options.every) {
    times.every = faults.collect([&] { return read_positive("--every", *options.every, units); },
                                 times.every);
  }
  faults.require_none();
  if (!options.events && !(times.until / times.every < most_samples)) {
    throw InvalidInput({{"--every", exact_text(times.every),
                         fmt::format("must be more than {} {}: {} samples at most up to {}",
                                     significant(times.until / most_samples, 6), units.time_unit(),
                                     significant(most_samples, 3), exact_text(times.until)),
                         ""}});
  }
  return times;
}

struct Start {
  ServoState state;
  double reference = 0.0;
};

/// The gap as it is to be at the start; nothing where the faces are to touch.
std::optional<double> read_gap(const SimulateOptions& options, double backlash, Faults& faults) {
  if (!options.initial_gap) return std::nullopt;
  const double gap =
      faults.collect([&] { return read_angle("--initial-gap", *options.initial_gap).si; }, 0.0);
  // An angle written in another unit may miss the face by its rounding.
  if (std::abs(gap) <= 0.5 * backlash * (1.0 + 1e-12)) {
    return std::clamp(gap, -0.5 * backlash, 0.5 * backlash);
  }
  faults.add({"--initial-gap", shown(*options.initial_gap),
              fmt::format("must be from -{0} to {0} rad, half the backlash each way",
                          exact_text(0.5 * backlash)),
              ""});
  return std::nullopt;
}

Start read_start(const SimulateOptions& options, const NormalizedServo& servo,
                 const ReportUnits& units, Faults& faults) {
  const auto angle = [&](const char* field, const std::string& text) {
    return faults.collect([&] { return read_angle(field, text).si; }, 0.0);
  };
  const auto speed = [&](const char* field, const std::string& text) {
    return units.normalized_speed(faults.collect(
        [&] {
          return read_scaled(field, text, dimensions::angular_speed, units, units.speed_unit());
        },
        0.0));
  };
  Start start;
  start.reference = angle("--reference", options.reference.value_or("1"));
  start.state = engaged_start(servo, angle("--initial-position", options.initial_position),
                              speed("--initial-speed", options.initial_speed), start.reference);
  if (const std::optional<double> gap = read_gap(options, servo.backlash, faults)) {
    start.state.motor_position = start.state.load_position + *gap;
  }
  start.state.set_gap_speed(speed("--initial-gap-speed", options.initial_gap_speed));
  return start;
}

MotionReport simulated(const ServoFile& file, const SimulateOptions& options,
                       const Provenance& provenance, Faults& faults) {
  const ReportUnits units = report_units(file);
  const Start start = read_start(options, file.servo, units, faults);
  const Times times = faults.collect([&] { return read_times(options, units); }, Times{1.0, 1.0});
  faults.require_none();

  return {.servo = file.servo,
          .is_drive = false,
          .initial = start.state,
          .reference = start.reference,
          .until = times.until,
          .every = times.every,
          .trajectory =
              simulate(file.servo, start.state,
                       {.until = units.normalized_time(times.until), .reference = start.reference}),
          .units = units,
          .provenance = provenance};
}

std::string title(const MotionReport& report) {
  const AngleUnit& angle = report.units.angle;
  const auto position = [&](double radians) {
    return significant(angle.from_radians(radians), 4) + " " + angle.name;
  };
  const ServoState& initial = report.initial;
  if (initial.load_position == 0.0 && initial.load_speed == 0.0) {
    return "Step to " + position(report.reference);
  }
  return fmt::format("Motion from {}, {} {}; reference {}", position(initial.load_position),
                     significant(report.units.speed(initial.load_speed), 4),
                     report.units.speed_unit(), position(report.reference));
}

void draw(const MotionReport& report, const MotionPlot& plot) {
  const MotionPicture picture{.title = title(report),
                              .servo = report.servo,
                              .trajectory = report.trajectory,
                              .reference = report.reference,
                              .cycle = std::nullopt,
                              .units = report.units};
  write_file(plot.file, plot.is_phase_plane ? draw_phase_plane(picture, plot.format)
                                            : draw_time_response(picture, plot.format));
}

ExitStatus simulate_servo(const ServoFile& file, const SimulateOptions& options,
                          const std::vector<MotionPlot>& plots, const Provenance& provenance,
                          Faults& faults, bool is_drive = false) {
  MotionReport report = simulated(file, options, provenance, faults);
  report.is_drive = is_drive;
  Extras extras;
  for (const MotionPlot& plot : plots) extras.make([&] { draw(report, plot); });
  write_tables(report, options);
  if (report.trajectory.stop_reason() == StopReason::reached_end) {
    return extras.status(ExitStatus::done);
  }
  fmt::print(stderr, "gearlash: stopped at {} {} of {} after {} events\n",
             exact_text(report.units.time(report.trajectory.end_time())), report.units.time_unit(),
             exact_text(report.until), report.trajectory.events().size());
  return extras.status(ExitStatus::undecided);
}

/// What the reference is at all times: of an option any number stands for what it will be.
std::optional<double> constant_reference(const DriveFile& file, const SimulateOptions& options) {
  constexpr double usual = 1.0;
  if (options.reference || !file.has_reference) return usual;
  const auto* constant = std::get_if<double>(&file.drive.reference);
  return constant != nullptr ? std::optional(*constant) : std::nullopt;
}

std::optional<ServoFile> closed_form_at(DriveFile file, double reference) {
  file.drive.reference = reference;
  return closed_form_of(std::move(file));
}

ExitStatus run(const SimulateOptions& options, const Provenance& provenance) {
  Faults faults;
  faults.require_choice("--format", options.format, {"csv", "json"});
  const std::vector<MotionPlot> plots = read_plots(options, faults);
  std::vector<FileUse> outputs = {{"--output", options.output}};
  for (const MotionPlot& plot : plots) outputs.push_back({"--plot", plot.file});
  faults.require_distinct({"SERVO.toml", options.servo.file}, outputs);
  const ServoOrDriveFile described = resolve_servo_or_drive(options.servo, faults);
  if (const auto* drive = std::get_if<DriveFile>(&described)) {
    const std::optional<double> reference = constant_reference(*drive, options);
    const std::optional<ServoFile> closed =
        faults.none() && reference ? closed_form_at(*drive, *reference) : std::nullopt;
    if (!closed) return simulate_drive(*drive, options, plots, provenance, faults);
    SimulateOptions constant = options;
    if (!options.reference) constant.reference = exact_text(*reference);
    return simulate_servo(*closed, constant, plots, provenance, faults, true);
  }
  return simulate_servo(std::get<ServoFile>(described), options, plots, provenance, faults);
}

void add_motion_options(Command& command, SimulateOptions& options) {
  constexpr char group[] =
      "Motion (s and rad/s, or with their unit, \"50 ms\", \"3 rpm\"; without a natural frequency "
      "normalised)";
  command
      .add_option("--initial-position", options.initial_position,
                  "of the load; rad or with its unit; default 0")
      ->type_name("ANGLE")
      ->group(group);
  command
      .add_option("--initial-speed", options.initial_speed,
                  "of the load, and of the motor but for the next; default 0")
      ->type_name("SPEED")
      ->group(group);
  command
      .add_option("--initial-gap", options.initial_gap,
                  "motor less load, within half the backlash each way; default\n"
                  "on the face towards which the motor pushes")
      ->type_name("ANGLE")
      ->group(group);
  command
      .add_option("--initial-gap-speed", options.initial_gap_speed,
                  "speed of the motor less that of the load; default 0")
      ->type_name("SPEED")
      ->group(group);
  command
      .add_option("--reference", options.reference,
                  "position asked for from time 0 on; rad or with its unit; default 1,\n"
                  "or what a drive's file says")
      ->type_name("ANGLE")
      ->group(group);
  command
      .add_option("--until", options.until,
                  "time to stop at; default 10 periods of the natural "
                  "frequency")
      ->type_name("TIME")
      ->group(group);
  command.add_option("--every", options.every, "between samples; default a thousandth of --until")
      ->type_name("TIME")
      ->group(group);
}

}  // namespace

void add_simulate_command(Command& app, Action& action) {
  const auto options = std::make_shared<SimulateOptions>();
  Command* command =
      app.add_subcommand("simulate", "the exact motion after a step or from a disturbance");
  add_servo_or_drive_options(*command, options->servo);
  add_motion_options(*command, *options);
  command->add_flag("--events", options->events,
                    "list separations and impacts instead of samples (JSON has both)");
  command->add_option("--format", options->format, "csv (default) or json")->type_name("FORMAT");
  command
      ->add_option("--plot", options->plots,
                   "time=FILE draws the response, phase=FILE the phase\n"
                   "plane; FILE ends in .svg, .png or .pdf; may be repeated")
      ->type_name("KIND=FILE")
      ->take_all()
      ->expected(1)
      ->allow_extra_args(false);
  command->add_option("--output", options->output, "file for the table; default standard output")
      ->type_name("FILE");
  command->footer(help_footer(examples));
  command->callback([options, &action] {
    action = [options](const Provenance& provenance) { return run(*options, provenance); };
  });
}

}  // namespace gearlash::cli
