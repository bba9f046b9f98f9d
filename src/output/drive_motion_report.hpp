// The motion of a drive as CSV, JSON and pictures.
#pragma once

#include <string>

#include "general/assemble/drive_system.hpp"
#include "input/drive_file.hpp"
#include "output/motion_report.hpp"
#include "picture/picture.hpp"

namespace gearlash {

struct DriveMotionReport {
  DriveFile file;
  drive::DriveSystem system;
  drive::ShaftStates initial;
  double until = 0.0;  ///< asked for
  double every = 0.0;  ///< between samples, > 0
  hybrid::Trajectory trajectory;
  Provenance provenance = {};
};

std::size_t sample_count(const DriveMotionReport& report);

/// As of a servo's motion; columns: time, position and speed of the load and of the motor, the
/// motor's torque at the load's shaft, reference, load torque, mode. Without a time scale
/// names say "normalized".
void write_samples_csv(const DriveMotionReport& report, const TextSink& sink,
                       const ProgressSink& progress);

/// One row an event: time, what happens, mode after it, both shafts before and after. What clocks
/// do alone (samples, signals) is left out.
void write_events_csv(const DriveMotionReport& report, const TextSink& sink);

void write_motion_json(const DriveMotionReport& report, const TextSink& sink,
                       const ProgressSink& progress);

/// Positions over time: load, motor, reference.
std::string draw_time_response(const DriveMotionReport& report, PictureFormat format);

/// Speeds over positions.
std::string draw_phase_plane(const DriveMotionReport& report, PictureFormat format);

/// Why the motion ended where it did; empty where at its end.
std::string stop_text(const hybrid::Trajectory& trajectory);

}  // namespace gearlash
