#include "output/motion_report.hpp"

#include "base/decimal_multiples.hpp"
#include "output/csv_table.hpp"
#include "output/records.hpp"

namespace gearlash {
namespace {

/// Both must outlive the rows.
RowsOf<MotionSample> samples_of(const MotionReport& report, Progress& progress) {
  return {[&](const auto& write) {
    constexpr std::size_t rows_between_progress = 4096;
    const std::size_t count = report.motion.sample_count(report.every);
    const DecimalMultiples time_of(report.every);
    for (std::size_t i = 0; i < count; ++i) {
      const bool is_asked = i > 0 && i % rows_between_progress == 0;
      if (is_asked && !progress.go_on(static_cast<double>(i) / static_cast<double>(count))) return;
      MotionSample sample = report.motion.at(time_of(i));
      sample.time = time_of(i);
      write(sample);
    }
  }};
}

/// The start, before any event at time 0.
Shafts start_of(const Motion& motion) {
  const auto events = motion.events();
  const bool is_at_once = !events.empty() && events.front().time == 0.0;
  return is_at_once ? events.front().before : motion.at(0.0).shafts;
}

}  // namespace

void write_samples_csv(const MotionReport& report, const TextSink& sink, Progress& progress) {
  write_csv(samples_of(report, progress), sink);
}

void write_events_csv(const MotionReport& report, const TextSink& sink) {
  write_csv(RowsOf<MotionEvent>{[&](const auto& write) {
              for (const MotionEvent& event : report.motion.events()) write(event);
            }},
            sink);
}

MotionDocument document_of(const MotionReport& report, Progress& progress) {
  const Motion& motion = report.motion;
  return {.drive = report.drive,
          .engine = motion.engine(),
          .start = start_of(motion),
          .until = report.until,
          .stop = motion.stop(),
          .end_time = motion.end_time(),
          .stop_text = motion.stop_text(),
          .energy = motion.energy(),
          .touches = motion.touches(),
          .events = motion.events(),
          .samples = samples_of(report, progress),
          .provenance = report.provenance};
}

}  // namespace gearlash
