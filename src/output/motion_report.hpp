// The motion of a drive as CSV and JSON, for both engines.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "gearlash/motion.hpp"
#include "gearlash/output.hpp"
#include "gearlash/units.hpp"
#include "output/json_writer.hpp"

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

/// One row for each sample, at 0, every, 2 every, … up to the end: the members of MotionSample with
/// their units, time_s, load_position_rad and so on.
void write_samples_csv(const MotionReport& report, const TextSink& sink,
                       Progress& progress = no_progress());

/// One row for each event: the members of MotionEvent with their units, time_s, what, …,
/// load_position_before_rad and so on.
void write_events_csv(const MotionReport& report, const TextSink& sink);

/// The report as JSON. Rows go to the sink one by one.
void write_motion_json(const MotionReport& report, const TextSink& sink,
                       Progress& progress = no_progress());

}  // namespace gearlash
