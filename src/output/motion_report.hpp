// The motion of a drive as CSV and JSON, for both engines.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "gearlash/motion.hpp"
#include "output/json_writer.hpp"
#include "output/output_file.hpp"
#include "output/report_units.hpp"

namespace gearlash {

struct MotionReport {
  Drive drive{};
  Motion motion{};
  double until = 0.0;  ///< s, requested end
  double every = 0.0;  ///< s, sampling interval, > 0
  Provenance provenance{};
};

/// "gearlash/simulate/3": the motion of a drive.
struct MotionDocument {
  Drive drive{};                              ///< its parameters
  Engine engine = Engine::general;            ///< which computed it
  Shafts start{};                             ///< before any event at time 0
  double until = 0.0;                         ///< s, requested end
  MotionStop stop = MotionStop::reached_end;  ///< why it ended
  double end_time = 0.0;                      ///< s, when it ended
  std::string stop_text{};                    ///< why it ended early, in words
  std::optional<EnergyBooks> energy{};        ///< J; closed form only
  std::span<const MotionTouch> touches{};     ///< where rounding decides whether an event occurs
  std::span<const MotionEvent> events{};      ///< in their order
  RowsOf<MotionSample> samples{};             ///< at 0, every, 2 every, … up to the end
  Provenance provenance{};                    ///< how it was made
};
/// The report and `progress` must outlive it.
MotionDocument document_of(const MotionReport& report, Progress& progress);

/// One row for each sample, at 0, every, 2 every, … up to the end: time_s, load_position_rad,
/// load_speed_rad_per_s, motor_position_rad, motor_speed_rad_per_s, motor_torque_N_m,
/// reference_rad, load_torque_N_m, mode.
void write_samples_csv(const MotionReport& report, const TextSink& sink,
                       Progress& progress = no_progress());

/// One row for each event: time_s, what, mode_after, energy_lost_J (empty if not known), and the
/// shafts' positions and speeds before and after.
void write_events_csv(const MotionReport& report, const TextSink& sink);

/// The report as JSON. Rows go to the sink one by one.
void write_motion_json(const MotionReport& report, const TextSink& sink,
                       Progress& progress = no_progress());

}  // namespace gearlash
