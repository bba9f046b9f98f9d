// What `gearlash simulate` was asked for, of servos and of drives.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "command.hpp"
#include "output/motion_report.hpp"
#include "output/output_file.hpp"
#include "picture/picture.hpp"
#include "servo_options.hpp"
#include "terminal.hpp"

namespace gearlash::cli {

/// A table this long takes about a gigabyte.
inline constexpr double most_samples = 1e7;

struct SimulateOptions {
  ServoOptions servo;
  std::string initial_position = "0";
  std::string initial_speed = "0";
  std::optional<std::string> initial_gap;
  std::string initial_gap_speed = "0";
  std::optional<std::string> reference;
  std::optional<std::string> until;
  std::optional<std::string> every;
  bool events = false;
  std::string format = "csv";
  std::vector<std::string> plots;
  std::string output = "-";
};

struct MotionPlot {
  bool is_phase_plane = false;
  std::string file;
  PictureFormat format = PictureFormat::svg;
};

/// The table that was asked for, of a servo's motion or a drive's.
template <class Report>
void write_tables(const Report& report, const SimulateOptions& options) {
  OutputFile output(options.output);
  TerminalProgress progress("Writing");
  const TextSink sink = [&](std::string_view text) { output.write(text); };
  const ProgressSink show = [&](double share) { progress.go_on(share); };
  if (options.format == "json") {
    write_motion_json(report, sink, show);
  } else if (options.events) {
    write_events_csv(report, sink);
  } else {
    write_samples_csv(report, sink, show);
  }
  output.commit();
}

/// The motion of a drive without a closed form. `faults` has those found so far.
ExitStatus simulate_drive(DriveFile file, const SimulateOptions& options,
                          const std::vector<MotionPlot>& plots, const Provenance& provenance,
                          Faults& faults);

}  // namespace gearlash::cli
