// gearlash simulate, of drives.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/range_check.hpp"
#include "general/assemble/time_scale.hpp"
#include "input/units.hpp"
#include "machine_faults.hpp"
#include "output/drive_motion_report.hpp"
#include "simulate_options.hpp"

namespace gearlash::cli {
namespace {

constexpr double default_samples = 1000.0;

struct Times {
  double until;
  double every;
};

/// In s or rad/s, or with its unit; of a drive without a time scale a number alone.
double read_number_or_quantity(const DriveFile& file, const char* field, const std::string& text,
                               const Dimension& dimension) {
  const ReportUnits units{.natural_frequency =
                              file.is_normalized ? std::nullopt : std::optional(1.0)};
  return read_scaled(field, text, dimension, units, dimension.unit);
}

double read_positive(const DriveFile& file, const char* field, const std::string& text) {
  const double time = read_number_or_quantity(file, field, text, dimensions::time);
  if (time > 0.0) return time;
  throw InvalidInput({{field, shown(text), "must be positive, in s", ""}});
}

/// What signals ask for and as long again, at least ten periods of the loop.
double default_duration(const drive::ReducedDrive& drive) {
  const double signals =
      std::max(drive::settling_time(drive.reference), drive::settling_time(drive.load_torque));
  return 2.0 * signals + 10.0 * drive::time_scales(drive).swing;
}

Times read_times(const DriveFile& file, const SimulateOptions& options, Faults& faults) {
  const auto read = [&](const char* field, const std::optional<std::string>& text,
                        double otherwise) {
    if (!text) return otherwise;
    return faults.collect([&] { return read_positive(file, field, *text); }, otherwise);
  };
  Times times{};
  // Of a drive at fault there is none.
  const double otherwise = options.until || !faults.none() ? 1.0 : default_duration(file.drive);
  times.until = read("--until", options.until, otherwise);
  times.every = read("--every", options.every, times.until / default_samples);
  if (!options.events && !(times.until / times.every < most_samples)) {
    faults.add({"--every", exact_text(times.every),
                fmt::format("must be more than {} s: {} samples at most up to {}",
                            significant(times.until / most_samples, 6),
                            significant(most_samples, 3), exact_text(times.until)),
                ""});
  }
  return times;
}

/// At rest where it is asked to be, unless options say other; the motor on the face towards which
/// it is asked to go.
drive::ShaftStates read_shafts(const DriveFile& file, const SimulateOptions& options,
                               Faults& faults) {
  const auto angle = [&](const char* field, const std::string& text) {
    return faults.collect([&] { return read_angle(field, text).si; }, 0.0);
  };
  const auto speed = [&](const char* field, const std::string& text) {
    return faults.collect(
        [&] { return read_number_or_quantity(file, field, text, dimensions::angular_speed); }, 0.0);
  };
  drive::ShaftStates shafts;
  shafts.load_position = angle("--initial-position", options.initial_position);
  shafts.load_speed = speed("--initial-speed", options.initial_speed);
  const double half = 0.5 * file.drive.backlash;
  const double way = drive::value_at(file.drive.reference, 0.0) < shafts.load_position ? -1.0 : 1.0;
  double gap = way * half;
  if (options.initial_gap) {
    gap = angle("--initial-gap", *options.initial_gap);
    const bool rigid = std::holds_alternative<drive::RigidContact>(file.drive.contact);
    if (rigid && !(std::abs(gap) <= half * (1.0 + 1e-12))) {
      faults.add({"--initial-gap", shown(*options.initial_gap),
                  fmt::format("must be from -{0} to {0} rad, half the backlash each way",
                              exact_text(half)),
                  ""});
      gap = 0.0;
    }
    if (rigid) gap = std::clamp(gap, -half, half);
  }
  shafts.motor_position = shafts.load_position + gap;
  shafts.motor_speed = shafts.load_speed + speed("--initial-gap-speed", options.initial_gap_speed);
  return shafts;
}

DriveMotionReport simulated(DriveFile file, const SimulateOptions& options,
                            const Provenance& provenance, Faults& faults) {
  if (options.reference || !file.has_reference) {
    const std::string text = options.reference.value_or("1");
    file.drive.reference = faults.collect([&] { return read_angle("--reference", text).si; }, 0.0);
  }
  const drive::ShaftStates shafts = read_shafts(file, options, faults);
  const Times times = read_times(file, options, faults);
  faults.require_none();
  DriveMotionReport report{.file = file,
                           .system = drive::drive_system(file.drive),
                           .initial = shafts,
                           .until = times.until,
                           .every = times.every,
                           .trajectory = {},
                           .provenance = provenance};
  report.trajectory =
      hybrid::simulate(report.system.system, drive::drive_start(file.drive, report.system, shafts),
                       {.until = times.until});
  return report;
}

}  // namespace

ExitStatus simulate_drive(DriveFile file, const SimulateOptions& options,
                          const std::vector<MotionPlot>& plots, const Provenance& provenance,
                          Faults& faults) {
  const DriveMotionReport report = simulated(std::move(file), options, provenance, faults);
  Extras extras;
  for (const MotionPlot& plot : plots) {
    extras.make([&] {
      write_file(plot.file, plot.is_phase_plane ? draw_phase_plane(report, plot.format)
                                                : draw_time_response(report, plot.format));
    });
  }
  write_tables(report, options);
  const std::string stopped = stop_text(report.trajectory);
  if (stopped.empty()) return extras.status(ExitStatus::done);
  report_lines("stopped: " + stopped);
  return extras.status(ExitStatus::undecided);
}

}  // namespace gearlash::cli
