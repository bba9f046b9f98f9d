#include "output/drive_motion_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "base/range_check.hpp"
#include "output/decimal_multiples.hpp"
#include "output/json_values.hpp"
#include "picture/line_chart.hpp"

namespace gearlash {
namespace {

const char* time_column(const DriveFile& file) {
  return file.is_normalized ? "time_normalized" : "time_s";
}
const char* time_unit(const DriveFile& file) { return file.is_normalized ? "1/ω_n" : "s"; }

// ---- samples ------------------------------------------------------------------------------------

struct Sample {
  double time = 0.0;
  drive::ShaftStates shafts;
  double motor_torque = 0.0;
  double reference = 0.0;
  double load_torque = 0.0;
  std::size_t mode = 0;
};

Sample sample_at(const DriveMotionReport& report, double time) {
  const hybrid::State state = report.trajectory.at(time);
  const drive::DriveSystem& system = report.system;
  return {time,
          drive::shafts_of(state),
          system.motor_torque(state.mode).at(state.numbers),
          system.reference.at(state.numbers),
          system.load_torque.at(state.numbers),
          state.mode};
}

template <class WriteRow>
void for_each_sample(const DriveMotionReport& report, const ProgressSink& progress,
                     const WriteRow& write_row) {
  for_each_time(sample_count(report), report.every, progress,
                [&](std::size_t i, double time) { write_row(i, sample_at(report, time)); });
}

// ---- events -------------------------------------------------------------------------------------

const std::string& name_of_event(const DriveMotionReport& report, const hybrid::Event& event) {
  const hybrid::AffineMode& mode = report.system.system.mode(event.mode);
  return event.kind == hybrid::EventKind::timed ? mode.timed[event.transition].name
                                                : mode.transitions[event.transition].name;
}

std::string text_of_event(const DriveMotionReport& report, const hybrid::Event& event) {
  const std::string& name = name_of_event(report, event);
  return event.kind == hybrid::EventKind::settling ? name + ", settled" : name;
}

const std::string& name_of_touch(const DriveMotionReport& report, const hybrid::Touch& touch) {
  return report.system.system.mode(touch.mode).transitions[touch.transition].name;
}

std::vector<const hybrid::Event*> events_of(const DriveMotionReport& report) {
  std::vector<const hybrid::Event*> found;
  for (const hybrid::Event& event : report.trajectory.events()) {
    const bool is_clock_alone =
        event.kind == hybrid::EventKind::timed && event.mode == event.mode_after;
    if (!is_clock_alone) found.push_back(&event);
  }
  return found;
}

const std::string& mode_name(const DriveMotionReport& report, std::size_t mode) {
  return report.system.system.mode(mode).name;
}

// ---- CSV ----------------------------------------------------------------------------------------

void write_provenance(const DriveMotionReport& report, const TextSink& sink) {
  sink(fmt::format("# gearlash {}\n# command: {}\n", report.provenance.version,
                   report.provenance.command));
  sink("# worked out as a piecewise-affine hybrid system; no event is missed but by rounding\n");
  sink("# positions, speeds and torques are those at the load's shaft\n");
  const std::string stopped = stop_text(report.trajectory);
  sink(fmt::format("# until = {}, stopped: {}\n", exact_text(report.until),
                   stopped.empty() ? "at the end" : stopped));
  const std::vector<hybrid::Touch>& touches = report.trajectory.touches();
  if (touches.empty()) return;
  sink(fmt::format("# touches = {}, first at {} ({}): rounding decides whether that happens\n",
                   touches.size(), exact_text(touches[0].time), name_of_touch(report, touches[0])));
}

std::string state_columns(const DriveFile& file, const std::string& suffix) {
  const char* speed = file.is_normalized ? "normalized_rad" : "rad_per_s";
  return fmt::format(
      "load_position{0}_rad,load_speed{0}_{1},motor_position{0}_rad,motor_speed{0}_{1}", suffix,
      speed);
}

std::string state_cells(const drive::ShaftStates& shafts) {
  return fmt::format("{},{},{},{}", exact_text(shafts.load_position), exact_text(shafts.load_speed),
                     exact_text(shafts.motor_position), exact_text(shafts.motor_speed));
}

std::string sample_cells(const Sample& sample) {
  return fmt::format("{},{},{},{},{}", exact_text(sample.time), state_cells(sample.shafts),
                     exact_text(sample.motor_torque), exact_text(sample.reference),
                     exact_text(sample.load_torque));
}

// ---- JSON ---------------------------------------------------------------------------------------

Json json_shafts(const drive::ShaftStates& shafts) {
  return {{"load_position", shafts.load_position},
          {"load_speed", shafts.load_speed},
          {"motor_position", shafts.motor_position},
          {"motor_speed", shafts.motor_speed}};
}

Json json_touches(const DriveMotionReport& report) {
  Json touches = Json::array();
  for (const hybrid::Touch& touch : report.trajectory.touches()) {
    touches.push_back(
        {{"time", touch.time}, {"kind", name_of_touch(report, touch)}, {"within", touch.within}});
  }
  return touches;
}

Json json_header(const DriveMotionReport& report) {
  const std::string stopped = stop_text(report.trajectory);
  const bool normalized = report.file.is_normalized;
  return {{"method", "piecewise-affine hybrid system"},
          {"initial", json_shafts(report.initial)},
          {"until", report.until},
          {"end_time", report.trajectory.end_time()},
          {"stop_reason", stopped.empty() ? "reached_end" : stopped},
          {"units",
           {{"time", normalized ? "1/omega_n" : "s"},
            {"position", "rad"},
            {"speed", normalized ? "rad omega_n" : "rad/s"},
            {"torque", normalized ? "K rad" : "N m"}}},
          {"touches", json_touches(report)},
          {"provenance", json_provenance(report.provenance)}};
}

Json json_event(const DriveMotionReport& report, const hybrid::Event& event) {
  return {{"time", event.time},
          {"kind", text_of_event(report, event)},
          {"mode_after", mode_name(report, event.mode_after)},
          {"before", json_shafts(drive::shafts_of({event.mode, event.before}))},
          {"after", json_shafts(drive::shafts_of({event.mode_after, event.after}))}};
}

// ---- pictures -----------------------------------------------------------------------------------

/// Evenly spaced, and at every event.
std::vector<Sample> drawn_samples(const DriveMotionReport& report) {
  constexpr int count = 2000;
  const double end = report.trajectory.end_time();
  std::vector<double> times;
  for (int i = 0; i <= count; ++i) times.push_back(end * i / count);
  for (const hybrid::Event* event : events_of(report)) times.push_back(event->time);
  if (times.size() > most_events_drawn) {
    throw InvalidInput(
        {{"--until", fmt::format("a motion with {} events", times.size()),
          fmt::format("must be shorter to be drawn, {} events at most", most_events_drawn), ""}});
  }
  std::sort(times.begin(), times.end());
  std::vector<Sample> samples;
  for (const double time : times) samples.push_back(sample_at(report, time));
  return samples;
}

template <class Abscissa, class Ordinate>
ChartCurve curve(const std::string& name, const std::vector<Sample>& samples, const Abscissa& x,
                 const Ordinate& y) {
  ChartCurve result;
  result.name = name;
  for (const Sample& sample : samples) result.line.push_back({x(sample), y(sample)});
  return result;
}

std::string subtitle(const DriveMotionReport& report) {
  const AngleUnit& angle = report.file.backlash_unit;
  return fmt::format("backlash {} {}",
                     significant(angle.from_radians(report.file.drive.backlash), 4), angle.name);
}

}  // namespace

std::size_t sample_count(const DriveMotionReport& report) {
  return count_of_samples(std::min(report.until, report.trajectory.end_time()), report.every);
}

void write_samples_csv(const DriveMotionReport& report, const TextSink& sink,
                       const ProgressSink& progress) {
  const char* torque = report.file.is_normalized ? "normalized" : "N_m";
  write_provenance(report, sink);
  sink(fmt::format("{},{},motor_torque_{},reference_rad,load_torque_{},mode\n",
                   time_column(report.file), state_columns(report.file, ""), torque, torque));
  for_each_sample(report, progress, [&](std::size_t, const Sample& sample) {
    sink(fmt::format("{},\"{}\"\n", sample_cells(sample), mode_name(report, sample.mode)));
  });
}

void write_events_csv(const DriveMotionReport& report, const TextSink& sink) {
  write_provenance(report, sink);
  sink(fmt::format("{},kind,mode_after,{},{}\n", time_column(report.file),
                   state_columns(report.file, "_before"), state_columns(report.file, "_after")));
  for (const hybrid::Event* event : events_of(report)) {
    sink(fmt::format("{},\"{}\",\"{}\",{},{}\n", exact_text(event->time),
                     text_of_event(report, *event), mode_name(report, event->mode_after),
                     state_cells(drive::shafts_of({event->mode, event->before})),
                     state_cells(drive::shafts_of({event->mode_after, event->after}))));
  }
}

void write_motion_json(const DriveMotionReport& report, const TextSink& sink,
                       const ProgressSink& progress) {
  std::string header = json_header(report).dump(2);
  header.resize(header.rfind("\n}"));  // reopened: the tables follow, row by row
  sink(header + ",\n  \"events\": [");
  const char* separator = "\n    ";
  for (const hybrid::Event* event : events_of(report)) {
    sink(separator + json_event(report, *event).dump());
    separator = ",\n    ";
  }
  sink(
      "\n  ],\n  \"samples\": {\n    \"columns\": [\"time\", \"load_position\", \"load_speed\", "
      "\"motor_position\", \"motor_speed\", \"motor_torque\", \"reference\", \"load_torque\", "
      "\"mode\"],\n    \"rows\": [");
  for_each_sample(report, progress, [&](std::size_t index, const Sample& sample) {
    sink(fmt::format("{}\n      [{},\"{}\"]", index == 0 ? "" : ",", sample_cells(sample),
                     mode_name(report, sample.mode)));
  });
  sink("\n    ]\n  }\n}\n");
}

std::string draw_time_response(const DriveMotionReport& report, PictureFormat format) {
  const AngleUnit& angle = report.file.backlash_unit;
  const std::vector<Sample> samples = drawn_samples(report);
  const auto time = [](const Sample& sample) { return sample.time; };
  const auto in_unit = [&](double radians) { return angle.from_radians(radians); };
  LineChart chart;
  chart.title = "Response of the drive";
  chart.subtitle = subtitle(report);
  chart.x.label = fmt::format("time, {}", time_unit(report.file));
  chart.y.label = "position at the load, " + angle.name;
  chart.curves = {
      curve("load", samples, time,
            [&](const Sample& sample) { return in_unit(sample.shafts.load_position); }),
      curve("motor", samples, time,
            [&](const Sample& sample) { return in_unit(sample.shafts.motor_position); }),
      curve("reference", samples, time,
            [&](const Sample& sample) { return in_unit(sample.reference); })};
  return draw_line_chart(chart, format);
}

std::string draw_phase_plane(const DriveMotionReport& report, PictureFormat format) {
  const AngleUnit& angle = report.file.backlash_unit;
  const std::vector<Sample> samples = drawn_samples(report);
  const auto in_unit = [&](double radians) { return angle.from_radians(radians); };
  LineChart chart;
  chart.title = "Motion of the drive in the phase plane";
  chart.subtitle = subtitle(report);
  chart.x.label = "position from the reference, " + angle.name;
  chart.y.label = fmt::format("speed, {} {}", angle.name, report.file.is_normalized ? "ω_n" : "/s");
  chart.curves = {
      curve(
          "load", samples,
          [&](const Sample& s) { return in_unit(s.shafts.load_position - s.reference); },
          [&](const Sample& s) { return in_unit(s.shafts.load_speed); }),
      curve(
          "motor", samples,
          [&](const Sample& s) { return in_unit(s.shafts.motor_position - s.reference); },
          [&](const Sample& s) { return in_unit(s.shafts.motor_speed); })};
  return draw_line_chart(chart, format);
}

std::string stop_text(const hybrid::Trajectory& trajectory) {
  const std::string at =
      fmt::format(" at {} by \"{}\"", exact_text(trajectory.end_time()), trajectory.culprit());
  switch (trajectory.stop_reason()) {
    case hybrid::StopReason::reached_end:
      return {};
    case hybrid::StopReason::event_limit:
      return fmt::format("after {} events", trajectory.events().size());
    case hybrid::StopReason::zeno:
      return "events come ever faster" + at;
    case hybrid::StopReason::chattering:
      return "events without end" + at;
    case hybrid::StopReason::diverged:
      return "numbers grow without end at " + exact_text(trajectory.end_time());
  }
  return {};
}

}  // namespace gearlash
