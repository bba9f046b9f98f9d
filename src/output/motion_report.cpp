#include "output/motion_report.hpp"

#include <string>
#include <vector>

#include "base/decimal_multiples.hpp"
#include "output/csv_table.hpp"
#include "output/drive_text.hpp"
#include "output/json_values.hpp"

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

Json json_shafts(const Shafts& shafts) {
  return {{"load_position", json_number(shafts.load_position)},
          {"load_speed", json_number(shafts.load_speed)},
          {"motor_position", json_number(shafts.motor_position)},
          {"motor_speed", json_number(shafts.motor_speed)}};
}

Json json_event(const MotionEvent& event) {
  return {{"time", json_number(event.time)},     {"what", event.what},
          {"mode_after", event.mode_after},      {"energy_lost", json_optional(event.energy_lost)},
          {"before", json_shafts(event.before)}, {"after", json_shafts(event.after)}};
}

Json json_touch(const MotionTouch& touch) {
  return {{"time", json_number(touch.time)},
          {"what", touch.what},
          {"within", json_optional(touch.within)}};
}

Json json_energy(const Motion& motion) {
  const std::optional<EnergyBooks> energy = motion.energy();
  if (!energy) return nullptr;
  return {{"stored_at_start", json_number(energy->stored_at_start)},
          {"supplied", json_number(energy->supplied)},
          {"stored", json_number(energy->stored)},
          {"motor_friction", json_number(energy->motor_friction)},
          {"load_friction", json_number(energy->load_friction)},
          {"impacts", json_number(energy->impacts)}};
}

/// The start, before any event at time 0.
Shafts start_of(const Motion& motion) {
  const auto events = motion.events();
  const bool is_at_once = !events.empty() && events.front().time == 0.0;
  return is_at_once ? events.front().before : motion.at(0.0).shafts;
}

/// The fields without a table.
Json json_header(const MotionReport& report) {
  const Motion& motion = report.motion;
  Json json = json_head("simulate", report.drive, report.provenance);
  json["engine"] = name_of(motion.engine());
  json["start"] = json_shafts(start_of(motion));
  json["until"] = json_number(report.until);
  json["stopped"] = {{"reason", name_of(motion.stop())},
                     {"time", json_number(motion.end_time())},
                     {"text", motion.stop_text()}};
  json["energy"] = json_energy(motion);
  json["touches"] = json_list(motion.touches(), &json_touch);
  return json;
}

Json json_row(const MotionSample& sample) {
  const Shafts& shafts = sample.shafts;
  return {json_number(sample.time),        json_number(shafts.load_position),
          json_number(shafts.load_speed),  json_number(shafts.motor_position),
          json_number(shafts.motor_speed), json_number(sample.motor_torque),
          json_number(sample.reference),   json_number(sample.load_torque),
          std::string(sample.mode)};
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

void write_motion_json(const MotionReport& report, const TextSink& sink, Progress& progress) {
  std::string header = json_header(report).dump(2);
  header.resize(header.rfind("\n}"));  // reopens the object: the tables follow, row by row
  sink(header + ",\n  \"events\": [");
  const char* separator = "\n    ";
  for (const MotionEvent& event : report.motion.events()) {
    sink(separator + json_event(event).dump());
    separator = ",\n    ";
  }
  sink(
      "\n  ],\n  \"samples\": {\n    \"columns\": [\"time\", \"load_position\", \"load_speed\", "
      "\"motor_position\", \"motor_speed\", \"motor_torque\", \"reference\", \"load_torque\", "
      "\"mode\"],\n    \"rows\": [");
  separator = "\n      ";
  for_each_sample(report, progress, [&](const MotionSample& sample) {
    sink(separator + json_row(sample).dump());
    separator = ",\n      ";
  });
  sink("\n    ]\n  }\n}\n");
}

}  // namespace gearlash
