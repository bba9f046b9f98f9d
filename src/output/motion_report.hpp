// A simulated motion as CSV and JSON.
#pragma once

#include <cstddef>
#include <functional>
#include <string_view>

#include "closed_form/trajectory.hpp"
#include "output/output_file.hpp"
#include "output/report_units.hpp"

namespace gearlash {

struct MotionReport {
  NormalizedServo servo = {};
  bool is_drive = false;    ///< its file describes a drive, which has a closed form
  ServoState initial = {};  ///< normalised
  double reference = 0.0;   ///< rad
  double until = 0.0;       ///< asked for, in the report's unit of time
  double every = 0.0;       ///< between samples, in the report's unit of time, > 0
  Trajectory trajectory = {};
  ReportUnits units = {};
  Provenance provenance = {};
};

/// Samples are taken at 0, every, 2 every, … up to `until`, or to where the trajectory ends.
std::size_t sample_count(const MotionReport& report);

/// Told the share that is done, 0 … 1, now and then.
using ProgressSink = std::function<void(double)>;

/// One row a sample, with lines of provenance ("# …") and a row of column names before them. The
/// names carry the units: time_s, load_speed_rad_per_s, …; without a natural frequency
/// time_normalized (ω_n t) and load_speed_normalized_rad (per unit of that time). Numbers read back
/// exactly. Columns: time, position and speed of the load and of the motor, mode of contact.
void write_samples_csv(const MotionReport& report, const TextSink& sink,
                       const ProgressSink& progress);

/// One row an event: time, kind, face, mode after it, energy lost, both shafts before and after.
void write_events_csv(const MotionReport& report, const TextSink& sink);

/// Samples, events, energy books and stop reason, as docs/command-line.md lays down.
void write_motion_json(const MotionReport& report, const TextSink& sink,
                       const ProgressSink& progress);

/// "engaged forward" and so on, with underscores as in the files.
const char* name_of(Mode mode);
const char* name_of(EventKind kind);
const char* name_of(Face face);

}  // namespace gearlash
