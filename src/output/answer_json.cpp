#include <cmath>

#include "gearlash/output.hpp"
#include "output/answer_report.hpp"
#include "output/ceiling_report.hpp"
#include "output/change_report.hpp"
#include "output/drive_text.hpp"
#include "output/json_values.hpp"
#include "output/measured_report.hpp"
#include "question/repetition.hpp"

namespace gearlash {
namespace {

Json json_range(const Bounds& range) { return {json_number(range.low), json_number(range.high)}; }

Json json_energy(const std::optional<EnergyLost>& energy) {
  if (!energy) return nullptr;
  return {{"total", json_number(energy->total())},
          {"motor_friction", json_number(energy->motor_friction)},
          {"load_friction", json_number(energy->load_friction)},
          {"impacts", json_number(energy->impacts)}};
}

}  // namespace

nlohmann::ordered_json json_cycle(const Cycle& cycle) {
  return {{"kind", name_of(cycle.kind)},
          {"stability", name_of(cycle.stability)},
          {"certainty", name_of(cycle.certainty)},
          {"amplitude", json_number(cycle.amplitude)},
          {"motor_amplitude", json_number(cycle.motor_amplitude)},
          {"center", json_number(cycle.center)},
          {"period", json_number(cycle.period)},
          {"frequency", json_number(cycle.frequency())},
          {"multiplier", json_number(cycle.multiplier)},
          {"impact_speed", json_number(cycle.impact_speed)},
          {"engaged_time", json_number(cycle.engaged_time)},
          {"separated_time", json_number(cycle.separated_time)},
          {"residual", json_number(cycle.residual)},
          {"events_per_period", cycle.events_per_period},
          {"settles", cycle.settles},
          {"mirror_image", cycle.has_mirror_image},
          {"energy", json_energy(cycle.energy)},
          {"encoder_steps", json_optional(cycle.encoder_steps)},
          {"starts", cycle.starts}};
}

nlohmann::ordered_json json_irregular(const IrregularMotion& motion) {
  return {{"amplitude", json_number(motion.amplitude)},
          {"motor_amplitude", json_optional(motion.motor_amplitude)},
          {"motor_alone", motion.is_motor_alone},
          {"repeats", repeats(motion)},
          {"center", json_number(motion.center)},
          {"mean_amplitude", json_optional(motion.mean_amplitude)},
          {"amplitude_deviation", json_optional(motion.amplitude_deviation)},
          {"mean_period", json_optional(motion.mean_period)},
          {"period_deviation", json_optional(motion.period_deviation)},
          {"mismatch", json_optional(motion.mismatch)},
          {"exponent", json_optional(motion.exponent)},
          {"watched", json_optional(motion.watched)},
          {"encoder_steps", json_optional(motion.encoder_steps)},
          {"starts", motion.starts}};
}

namespace {

const char* name_of_direction(double direction) {
  if (direction == 0.0) return "both";
  return direction > 0.0 ? "forward" : "backward";
}

Json json_piece(const RestPiece& piece) {
  return {{"kind", name_of(piece.kind)},
          {"side", name_of_direction(piece.side)},
          {"load", json_range(piece.load)},
          {"motor", json_range(piece.motor)}};
}

Json json_time(const std::optional<TimeToRest>& time) {
  if (!time) return nullptr;
  return {{"band", json_number(time->band)},
          {"longest", json_number(time->longest)},
          {"median", json_number(time->median)}};
}

Json json_rest(const std::optional<Rest>& rest) {
  if (!rest) return nullptr;
  return {{"load", json_range(rest->load)},
          {"motor", json_range(rest->motor)},
          {"error", json_range(rest->error)},
          {"pieces", json_list(rest->pieces, json_piece)},
          {"certainty", name_of(rest->certainty)},
          {"swing_ratio", json_optional(rest->swing_ratio)},
          {"creeping_starts", rest->creeping_starts},
          {"time_to_rest", json_time(rest->time)},
          {"starts", rest->starts}};
}

/// The number of diverging starts; null without a search.
Json json_runaway(const Answer& answer) {
  if (!answer.search) return nullptr;
  return {{"starts", answer.search->count("diverges")}};
}

Json json_threshold(const Threshold& threshold) {
  return {{"end", threshold.end},
          {"direction", name_of_direction(threshold.direction)},
          {"below", json_number(threshold.below)},
          {"from", json_number(threshold.from)}};
}

Json json_place(const std::optional<RestPlace>& place) {
  if (!place) return nullptr;
  return {{"load", json_number(place->load)},
          {"motor", json_optional(place->motor)},
          {"uncertainty", json_optional(place->uncertainty)}};
}

Json json_start(const StartOutcome& start) {
  return {{"load_position", json_number(start.load_position)},
          {"load_speed", json_number(start.load_speed)},
          {"motor_position", json_number(start.motor_position)},
          {"motor_speed", json_number(start.motor_speed)},
          {"end", start.end},
          {"which", start.which ? Json(*start.which) : Json(nullptr)},
          {"watched", json_number(start.watched)},
          {"reason", start.reason.empty() ? Json(nullptr) : Json(start.reason)},
          {"rest", json_place(start.rest)},
          {"time_to_rest", json_optional(start.time_to_rest)}};
}

Json json_search(const std::optional<SearchRecord>& search) {
  if (!search) return nullptr;
  return {{"watch_time", json_number(search->watch_time)},
          {"complete", search->is_complete},
          {"borders", search->borders},
          {"starts", json_list(search->starts, &json_start)}};
}

Json json_proved_bounds(const std::optional<ProvedBounds>& bounds) {
  if (!bounds) return nullptr;
  const auto of_cycle = [&](const Bounds& range) {
    return bounds->has_cycle ? json_range(range) : Json(nullptr);
  };
  return {{"growth_at_rest", json_range(bounds->growth_at_rest)},
          {"amplitude", of_cycle(bounds->amplitude)},
          {"period", of_cycle(bounds->period)},
          {"multiplier", of_cycle(bounds->multiplier)}};
}

Json json_normal_form(const std::optional<NormalFormNumbers>& form) {
  if (!form) return nullptr;
  Json json = gearlash::json_normal_form(*form, form->natural_frequency);
  json["stiffness"] = json_optional(form->stiffness);
  return json;
}

}  // namespace

std::string answer_json(const AnswerReport& report) {
  const Answer& answer = report.answer;
  const bool has_cycles = !answer.cycles.empty();
  Json json = json_head("limit-cycle", report.drive, report.provenance);
  json["engine"] = name_of(answer.engine);
  json["verdict"] = name_of(answer.verdict);
  json["certainty"] = {
      {"verdict", name_of(answer.certainty)},
      {"stability", has_cycles ? Json(name_of(answer.cycles.front().certainty)) : Json(nullptr)},
      {"completeness", name_of(answer.completeness)}};
  json["normal_form"] = json_normal_form(answer.normal_form);
  json["growth_at_rest"] = json_optional(answer.growth_at_rest);
  json["bounds"] = json_proved_bounds(answer.bounds);
  json["ceiling"] = ceiling_json(answer.ceiling);
  json["specification"] = specification_json(report);
  json["dissipative"] = answer.is_dissipative;
  json["rests_engaged"] = answer.rests_engaged;
  json["neutral_swings"] = answer.neutral_swings;
  json["cycles"] = json_list(answer.cycles, &json_cycle);
  json["rest"] = json_rest(answer.rest);
  json["irregular"] = json_list(answer.irregular, &json_irregular);
  json["quantization"] = answer.is_quantization ? Json(*answer.is_quantization) : Json(nullptr);
  json["runaway"] = json_runaway(answer);
  json["thresholds"] = json_list(answer.thresholds, &json_threshold);
  json["measured"] = measured_json(report);
  json["search"] = json_search(answer.search);
  json["margin"] = report.margin ? margin_json(report.drive, *report.margin) : Json(nullptr);
  json["sensitivities"] =
      report.sensitivity ? sensitivity_json(*report.sensitivity) : Json(nullptr);
  json["notes"] = json_list(answer.notes, [](const Note& note) {
    return Json{{"code", note.code}, {"text", note.text}};
  });
  return json.dump(2) + "\n";
}

std::string to_json(const Drive& drive, const Answer& answer) {
  return answer_json(report_of(drive, answer));
}

}  // namespace gearlash
