#include "output/motion_report.hpp"

#include <vector>

#include "base/decimal_multiples.hpp"
#include "output/csv_table.hpp"

namespace gearlash {
namespace {

template <class WriteRow>
void for_each_sample(const MotionReport& report, Progress& progress, const WriteRow& write_row) {
  constexpr std::size_t rows_between_progress = 4096;
  const std::size_t count = report.motion.sample_count(report.every);
  const DecimalMultiples time_of(report.every);
  for (std::size_t i = 0; i < count; ++i) {
    const bool is_asked = i > 0 && i % rows_between_progress == 0;
    if (is_asked && !progress.go_on(static_cast<double>(i) / static_cast<double>(count))) return;
    MotionSample sample = report.motion.at(time_of(i));
    sample.time = time_of(i);
    write_row(sample);
  }
}

/// The start, before any event at time 0.
Shafts start_of(const Motion& motion) {
  const auto events = motion.events();
  const bool is_at_once = !events.empty() && events.front().time == 0.0;
  return is_at_once ? events.front().before : motion.at(0.0).shafts;
}

}  // namespace

void write_samples_csv(const MotionReport& report, const TextSink& sink, Progress& progress) {
  CsvTable table(sink, {"time_s", "load_position_rad", "load_speed_rad_per_s", "motor_position_rad",
                        "motor_speed_rad_per_s", "motor_torque_N_m", "reference_rad",
                        "load_torque_N_m", "mode"});
  for_each_sample(report, progress, [&](const MotionSample& sample) {
    const Shafts& shafts = sample.shafts;
    table.row(sample.time, shafts.load_position, shafts.load_speed, shafts.motor_position,
              shafts.motor_speed, sample.motor_torque, sample.reference, sample.load_torque,
              sample.mode);
  });
}

void write_events_csv(const MotionReport& report, const TextSink& sink) {
  std::vector<std::string> columns = {"time_s", "what", "mode_after", "energy_lost_J"};
  for (const char* when : {"before", "after"}) {
    for (const char* shaft : {"load", "motor"}) {
      columns.push_back(std::string(shaft) + "_position_" + when + "_rad");
      columns.push_back(std::string(shaft) + "_speed_" + when + "_rad_per_s");
    }
  }
  CsvTable table(sink, columns);
  for (const MotionEvent& event : report.motion.events()) {
    table.cell(event.time).cell(event.what).cell(event.mode_after).cell(event.energy_lost);
    for (const Shafts& shafts : {event.before, event.after}) {
      table.cell(shafts.load_position).cell(shafts.load_speed);
      table.cell(shafts.motor_position).cell(shafts.motor_speed);
    }
    table.end_row();
  }
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
          .samples = {[&](const auto& write) { for_each_sample(report, progress, write); }},
          .provenance = report.provenance};
}

}  // namespace gearlash
