#include "output/motion_report.hpp"

#include <fmt/format.h>

#include <string>

#include "base/range_check.hpp"
#include "output/decimal_multiples.hpp"
#include "output/json_values.hpp"

namespace gearlash {
namespace {

/// A state in the report's units.
ServoState reported(const ServoState& state, const ReportUnits& units) {
  return {.motor_position = state.motor_position,
          .motor_speed = units.speed(state.motor_speed),
          .load_position = state.load_position,
          .load_speed = units.speed(state.load_speed),
          .motor_speed_remainder = units.speed(state.motor_speed_remainder)};
}

struct Sample {
  double time;  ///< in the report's unit
  ServoState state;
  Mode mode;
};

Sample sample_at(const MotionReport& report, double time) {
  const double normalized = report.units.normalized_time(time);
  return {time, reported(report.trajectory.at(normalized), report.units),
          report.trajectory.mode_at(normalized)};
}

template <class WriteRow>
void for_each_sample(const MotionReport& report, const ProgressSink& progress,
                     const WriteRow& write_row) {
  for_each_time(sample_count(report), report.every, progress,
                [&](std::size_t i, double time) { write_row(i, sample_at(report, time)); });
}

const char* words_for(StopReason reason) {
  return reason == StopReason::reached_end ? "reached_end" : "event_limit";
}

// --- CSV ---

void write_provenance(const MotionReport& report, const TextSink& sink) {
  const NormalizedServo& servo = report.servo;
  sink(fmt::format("# gearlash {}\n# command: {}\n", report.provenance.version,
                   report.provenance.command));
  if (report.is_drive) {
    sink("# worked out in closed form: the drive is a servo with proportional control\n");
  }
  sink(fmt::format(
      "# damping = {}, inertia_ratio = {}, friction_ratio = {}, backlash = {} rad, "
      "restitution = {}, sensor = {}\n",
      exact_text(servo.damping), exact_text(servo.inertia_ratio), exact_text(servo.friction_ratio),
      exact_text(servo.backlash), exact_text(servo.restitution),
      servo.sensor == ShaftName::load ? "load" : "motor"));
  if (report.units.natural_frequency) {
    sink(fmt::format("# natural_frequency = {} rad/s\n",
                     exact_text(*report.units.natural_frequency)));
  } else {
    sink("# times are normalized, in units of 1/omega_n; speeds are per unit of that time\n");
  }
  sink(fmt::format("# reference = {} rad, until = {}, stopped: {}\n", exact_text(report.reference),
                   exact_text(report.until), words_for(report.trajectory.stop_reason())));
  const std::vector<Touch>& touches = report.trajectory.touches();
  if (touches.empty()) return;
  sink(fmt::format(
      "# touches = {}, first at {} ({}): rounding decides whether the faces meet there\n",
      touches.size(), exact_text(report.units.time(touches[0].time)), name_of(touches[0].face)));
}

std::string time_column(const ReportUnits& units) {
  return units.natural_frequency ? "time_s" : "time_normalized";
}

/// The four columns of a state: load_position_rad, …, with `suffix` before the unit.
std::string state_columns(const ReportUnits& units, const std::string& suffix) {
  const char* speed = units.natural_frequency ? "rad_per_s" : "normalized_rad";
  return fmt::format(
      "load_position{0}_rad,load_speed{0}_{1},motor_position{0}_rad,motor_speed{0}_{1}", suffix,
      speed);
}

std::string state_cells(const ServoState& state) {
  return fmt::format("{},{},{},{}", exact_text(state.load_position), exact_text(state.load_speed),
                     exact_text(state.motor_position), exact_text(state.motor_speed));
}

// --- JSON ---

Json json_state(const ServoState& state) {
  return {{"load_position", state.load_position},
          {"load_speed", state.load_speed},
          {"motor_position", state.motor_position},
          {"motor_speed", state.motor_speed}};
}

Json json_event(const Event& event, const ReportUnits& units) {
  return {{"time", units.time(event.time)},
          {"kind", name_of(event.kind)},
          {"face", name_of(event.face)},
          {"mode_after", name_of(event.mode_after)},
          {"energy_lost", units.energy(event.energy_lost)},
          {"before", json_state(reported(event.before, units))},
          {"after", json_state(reported(event.after, units))}};
}

/// The account says where the energy is at the end and went since the start; an impact at the very
/// start is part of what went.
Json json_energy_books(const MotionReport& report) {
  const EnergyAccount start = report.trajectory.energy_at(0.0);
  const EnergyAccount end = report.trajectory.energy_at(report.trajectory.end_time());
  const auto in_units = [&](double energy) { return json_number(report.units.energy(energy)); };
  return {{"stored_at_start", in_units(start.stored() + start.impacts)},
          {"supplied", in_units(end.supplied)},
          {"stored", in_units(end.stored())},
          {"motor_friction", in_units(end.motor_friction)},
          {"load_friction", in_units(end.load_friction)},
          {"impacts", in_units(end.impacts)}};
}

Json json_units(const ReportUnits& units) {
  const bool physical = units.natural_frequency.has_value();
  return {{"time", physical ? "s" : "1/omega_n"},
          {"position", "rad"},
          {"speed", physical ? "rad/s" : "rad omega_n"},
          {"energy", units.stiffness ? "J" : "K rad2"}};
}

Json json_touches(const MotionReport& report) {
  Json touches = Json::array();
  for (const Touch& touch : report.trajectory.touches()) {
    touches.push_back({{"time", report.units.time(touch.time)}, {"face", name_of(touch.face)}});
  }
  return touches;
}

/// All that is known without a table.
Json json_header(const MotionReport& report) {
  Json json = {{"servo", json_servo(report.servo)},
               {"initial", json_state(reported(report.initial, report.units))},
               {"reference", report.reference},
               {"until", report.until},
               {"end_time", report.units.time(report.trajectory.end_time())},
               {"stop_reason", words_for(report.trajectory.stop_reason())},
               {"units", json_units(report.units)},
               {"energy", json_energy_books(report)},
               {"method", "closed form"},
               {"touches", json_touches(report)},
               {"provenance", json_provenance(report.provenance)}};
  if (report.units.natural_frequency) {
    json["natural_frequency"] = *report.units.natural_frequency;
  }
  return json;
}

}  // namespace

std::size_t sample_count(const MotionReport& report) {
  const double end = report.trajectory.stop_reason() == StopReason::reached_end
                         ? report.until
                         : report.units.time(report.trajectory.end_time());
  return count_of_samples(end, report.every);
}

void write_samples_csv(const MotionReport& report, const TextSink& sink,
                       const ProgressSink& progress) {
  write_provenance(report, sink);
  sink(time_column(report.units) + "," + state_columns(report.units, "") + ",mode\n");
  for_each_sample(report, progress, [&](std::size_t, const Sample& sample) {
    sink(fmt::format("{},{},{}\n", exact_text(sample.time), state_cells(sample.state),
                     name_of(sample.mode)));
  });
}

void write_events_csv(const MotionReport& report, const TextSink& sink) {
  const ReportUnits& units = report.units;
  write_provenance(report, sink);
  sink(fmt::format("{},kind,face,mode_after,energy_lost_{},{},{}\n", time_column(units),
                   units.stiffness ? "J" : "K_rad2", state_columns(units, "_before"),
                   state_columns(units, "_after")));
  for (const Event& event : report.trajectory.events()) {
    sink(fmt::format(
        "{},{},{},{},{},{},{}\n", exact_text(units.time(event.time)), name_of(event.kind),
        name_of(event.face), name_of(event.mode_after), exact_text(units.energy(event.energy_lost)),
        state_cells(reported(event.before, units)), state_cells(reported(event.after, units))));
  }
}

void write_motion_json(const MotionReport& report, const TextSink& sink,
                       const ProgressSink& progress) {
  std::string header = json_header(report).dump(2);
  header.resize(header.rfind("\n}"));  // reopened: the tables follow, row by row
  sink(header + ",\n  \"events\": [");
  const char* separator = "\n    ";
  for (const Event& event : report.trajectory.events()) {
    sink(separator + json_event(event, report.units).dump());
    separator = ",\n    ";
  }
  sink(
      "\n  ],\n  \"samples\": {\n    \"columns\": [\"time\", \"load_position\", \"load_speed\", "
      "\"motor_position\", \"motor_speed\", \"mode\"],\n    \"rows\": [");
  for_each_sample(report, progress, [&](std::size_t index, const Sample& sample) {
    sink(fmt::format("{}\n      [{},{},\"{}\"]", index == 0 ? "" : ",", exact_text(sample.time),
                     state_cells(sample.state), name_of(sample.mode)));
  });
  sink("\n    ]\n  }\n}\n");
}

const char* name_of(Mode mode) {
  switch (mode) {
    case Mode::engaged_forward:
      return "engaged_forward";
    case Mode::engaged_backward:
      return "engaged_backward";
    case Mode::separated:
      return "separated";
    case Mode::settling:
      return "settling";
    case Mode::no_gap:
      return "no_gap";
  }
  return "";
}

const char* name_of(EventKind kind) {
  switch (kind) {
    case EventKind::separation:
      return "separation";
    case EventKind::impact:
      return "impact";
    case EventKind::settling:
      return "settling";
  }
  return "";
}

const char* name_of(Face face) { return face == Face::forward ? "forward" : "backward"; }

}  // namespace gearlash
