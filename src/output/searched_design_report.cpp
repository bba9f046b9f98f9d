#include "output/searched_design_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "analysis/design/target.hpp"
#include "analysis/grid/axis.hpp"
#include "output/columns.hpp"
#include "output/drive_text.hpp"
#include "output/json_values.hpp"
#include "output/parameter_text.hpp"

namespace gearlash {
namespace {

constexpr int few_digits = 3;
constexpr double degree = std::numbers::pi / 180.0;

/// In the order of `names_of_costs`.
std::vector<std::string> costs_text(const DriveWithValue& one, const AngleUnit& angle) {
  const auto error = one.answer.value(Quantity::static_error);
  const StepResponse response = one.answer.step.value_or(StepResponse{});
  const LinearLoop loop = one.answer.loop.value_or(LinearLoop{});
  const auto time = [](const std::optional<double>& seconds) {
    return seconds ? significant(*seconds, few_digits) + " s" : "";
  };
  return {error ? angle_text(*error, angle, few_digits) : "",
          time(response.rise_time),
          response.overshoot ? fmt::format("{:.1f} %", 100.0 * *response.overshoot) : "",
          time(response.settling_time),
          loop.bandwidth ? significant(*loop.bandwidth, few_digits) + " Hz" : "",
          loop.phase_margin ? fmt::format("{:.1f} deg", *loop.phase_margin / degree) : ""};
}

constexpr std::array names_of_costs = {"static error", "rise",      "overshoot",
                                       "settles",      "bandwidth", "phase margin"};

std::vector<std::string> row_text(const SearchedDesignReport& report,
                                  const SearchedParameter& parameter, std::size_t index) {
  const FeasibleValues& values = parameter.values;
  const ParameterText text(report.drive, values.parameter, report.angle);
  const DriveWithValue& one = parameter.results[index];
  const bool has_ratio = !text.is_word() && values.present != 0.0 && !std::isnan(values.present);
  const bool is_first = index == 0;
  std::vector<std::string> row = {
      is_first ? values.parameter : "  or", is_first ? text.of(values.present) : "",
      text.of(values.intervals[index]),
      !has_ratio                    ? ""
      : one.value == values.present ? "0 %"
                                    : change_text(one.value / values.present),
      result_text(one.answer, report.angle)};
  for (std::string& cell : costs_text(one, report.angle)) row.push_back(std::move(cell));
  return row;
}

std::string table_of_results(const SearchedDesignReport& report) {
  std::vector<std::vector<std::string>> rows = {
      {"parameter", "now", "meets the target", "change", "result"}};
  rows.front().insert(rows.front().end(), names_of_costs.begin(), names_of_costs.end());
  for (const SearchedParameter& parameter : report.parameters) {
    for (std::size_t i = 0; i < parameter.values.intervals.size(); ++i) {
      rows.push_back(row_text(report, parameter, i));
    }
  }
  if (rows.size() == 1) return "";
  return "One change by itself, other parameters fixed; its result at the value nearest to the "
         "present one,\na step of the reference of " +
         angle_text(report.present.answer.step.value_or(StepResponse{}).step, report.angle,
                    few_digits) +
         ", and the linear loop without the gap\n" + table_text(rows) + "\n";
}

std::string reasons(const SearchedDesignReport& report) {
  std::string text;
  for (const SearchedParameter& parameter : report.parameters) {
    const FeasibleValues& values = parameter.values;
    if (!values.intervals.empty() || values.stopped) continue;
    const ParameterText shown(report.drive, values.parameter, report.angle);
    text += "  " + values.parameter + ": no " +
            (shown.is_word() ? "choice"
                             : "value of those tried from " + shown.of(values.searched.low) +
                                   " to " + shown.of(values.searched.high)) +
            "; closest is " + shown.of(*values.closest) + " (" +
            result_text(parameter.results.at(0).answer, report.angle) + ")\n";
  }
  return text.empty() ? "" : "No value meets the target\n" + text + "\n";
}

std::string border_text(const ParameterText& shown, const Border& border) {
  const std::string at = shown.of(border.at);
  switch (border.kind) {
    case BorderKind::limit:
      return "the target's limit is reached";
    case BorderKind::fold:
      return "fold at " + at + ": a stable and an unstable limit cycle meet and end";
    case BorderKind::branching:
      return "branching at " + at + ": another limit cycle crosses this one";
    case BorderKind::flip:
      return "flip at " + at + ": a limit cycle of twice the period begins";
    case BorderKind::neimark_sacker:
      return "Neimark–Sacker bifurcation at " + at +
             ": a limit cycle gives way to motion on a torus";
    case BorderKind::grazing:
      return "grazing at " + at + ": a limit cycle touches \"" + border.event + "\"";
    case BorderKind::endless_period:
      return "the period of a limit cycle grows beyond all bounds near " + at;
    case BorderKind::rest:
      return "beyond, no start leads to rest, or first ones do";
    case BorderKind::unnamed:
      break;
  }
  return "the motion changes; no limit cycle that was followed accounts for it";
}

std::string borders_text(const SearchedDesignReport& report) {
  std::vector<std::vector<std::string>> rows;
  for (const SearchedParameter& parameter : report.parameters) {
    const ParameterText shown(report.drive, parameter.values.parameter, report.angle);
    for (const Border& border : parameter.values.borders) {
      rows.push_back(
          {parameter.values.parameter, shown.of(border.end), border_text(shown, border)});
    }
  }
  if (rows.empty()) return "";
  rows.insert(rows.begin(), {"parameter", "end", "what happens there"});
  return "Where intervals end\n" + table_text(rows) + "\n";
}

std::string undecided_text(const SearchedDesignReport& report) {
  std::string parts;
  for (const SearchedParameter& parameter : report.parameters) {
    const ParameterText shown(report.drive, parameter.values.parameter, report.angle);
    for (const Bounds& part : parameter.values.undecided) {
      parts += (parts.empty() ? "" : "; ") + parameter.values.parameter + " " + shown.of(part);
    }
  }
  return parts.empty() ? "" : " Undecided: " + parts + ".";
}

/// What is proved of the intervals of a target on ceilings; empty for other targets.
std::string proofs_text(const SearchedDesignReport& report) {
  std::string text;
  for (const SearchedParameter& parameter : report.parameters) {
    const FeasibleValues& values = parameter.values;
    const ParameterText shown(report.drive, values.parameter, report.angle);
    for (std::size_t i = 0; i < values.proofs.size(); ++i) {
      const IntervalProof& proof = values.proofs[i];
      text += "  " + values.parameter + " " + shown.of(values.intervals[i]) + ": ";
      if (proof.parts.empty()) {
        text += "searched, not proved: " + proof.reason + "\n";
        continue;
      }
      text += "proved for";
      for (const Bounds& part : proof.parts) {
        text += (&part == &proof.parts.front() ? " " : " and ") + shown.of(part);
      }
      text += fmt::format(" ({} {})\n", proof.boxes, proof.boxes == 1 ? "box" : "boxes");
    }
  }
  return text.empty() ? "" : "Every value of these parts meets the target\n" + text + "\n";
}

std::string certainty(const SearchedDesignReport& report) {
  std::string grids;
  double located = 0.0;
  bool is_stopped = false;
  for (const SearchedParameter& parameter : report.parameters) {
    const FeasibleValues& values = parameter.values;
    const ParameterText shown(report.drive, values.parameter, report.angle);
    grids += (grids.empty() ? "" : "; ") +
             fmt::format("{}, {} values", values.parameter, values.grid.size());
    if (!shown.is_word()) {
      grids += " from " + shown.of(values.searched.low) + " to " + shown.of(values.searched.high);
    }
    located = std::max(located, values.located);
    is_stopped = is_stopped || values.stopped;
  }
  const bool has_proofs = std::any_of(
      report.parameters.begin(), report.parameters.end(),
      [](const SearchedParameter& parameter) { return !parameter.values.proofs.empty(); });
  return (has_proofs ? "All else is searched, not proved: at each"
                     : "Searched, not proved: at each") +
         std::string(" value of a grid the drive was followed from many starts (") + grids +
         "). What is narrower than the distance of two values may be missed. " +
         (located > 0.0 ? "Ends of intervals are located to " + significant(located, 1) +
                              " of their value, by following the drive from value to value, and "
                              "were searched again."
                        : "") +
         undecided_text(report) +
         (is_stopped ? " The search was stopped: the values that it did not reach are undecided."
                     : "");
}

// ---- JSON ---------------------------------------------------------------------------------------

Json json_performance(const Answer& answer) {
  return {{"verdict", name_of(answer.verdict)},
          {"growth_at_rest", json_optional(answer.growth_at_rest)},
          {"amplitude", json_optional(answer.value(Quantity::amplitude))},
          {"frequency", json_optional(answer.value(Quantity::frequency))},
          {"static_error", json_optional(answer.value(Quantity::static_error))}};
}

Json json_response(const Answer& answer) {
  const StepResponse response = answer.step.value_or(StepResponse{});
  return {{"step", json_number(response.step)},
          {"rise_time", json_optional(response.rise_time)},
          {"overshoot", json_optional(response.overshoot)},
          {"settling_time", json_optional(response.settling_time)}};
}

Json json_loop(const std::optional<LinearLoop>& loop) {
  if (!loop) return nullptr;
  return {{"stable", loop->is_stable},
          {"bandwidth", json_optional(loop->bandwidth)},
          {"crossover", json_optional(loop->crossover)},
          {"phase_margin", json_optional(loop->phase_margin)}};
}

Json json_result(const Drive& drive, const FeasibleValues& values, const DriveWithValue& one) {
  const Axis axis{.path = values.parameter};
  const bool is_word = !parameter_of(axis, drive)->choices.empty();
  const bool has_ratio = !is_word && values.present != 0.0;
  return {{"value", json_value(axis, drive, one.value)},
          {"change_percent",
           has_ratio ? json_number(100.0 * (one.value / values.present - 1.0)) : Json(nullptr)},
          {"performance", json_performance(one.answer)},
          {"loop", json_loop(one.answer.loop)},
          {"response", json_response(one.answer)}};
}

Json json_parameter(const Drive& drive, const SearchedParameter& parameter) {
  const FeasibleValues& values = parameter.values;
  const Axis axis{.path = values.parameter};
  const auto of_value = [&](double value) { return json_value(axis, drive, value); };
  const auto of_interval = [&](const Bounds& interval) {
    return Json{{"from", of_value(interval.low)}, {"to", of_value(interval.high)}};
  };
  const auto nearest = std::min_element(
      parameter.results.begin(), parameter.results.end(), [&](const auto& a, const auto& b) {
        const auto distance = [&](double value) {
          return value > 0.0 && values.present > 0.0 ? std::abs(std::log(value / values.present))
                                                     : std::abs(value - values.present);
        };
        return distance(a.value) < distance(b.value);
      });
  const Json best =
      nearest == parameter.results.end() ? Json(nullptr) : json_result(drive, values, *nearest);
  return {{"parameter", values.parameter},
          {"description", parameter_of(axis, drive)->meaning},
          {"unit", unit_of(axis, drive)},
          {"present", of_value(values.present)},
          {"searched", of_interval(values.searched)},
          {"certified", false},
          {"stopped", values.stopped},
          {"grid", json_list(values.grid, of_value)},
          {"located", json_number(values.located)},
          {"intervals", json_list(values.intervals, of_interval)},
          {"borders", json_list(values.borders,
                                [](const Border& border) {
                                  return Json{{"end", json_number(border.end)},
                                              {"kind", name_of(border.kind)},
                                              {"at", json_number(border.at)},
                                              {"located", json_number(border.located)},
                                              {"event", border.event.empty() ? Json(nullptr)
                                                                             : Json(border.event)}};
                                })},
          {"proofs", json_list(values.proofs,
                               [&](const IntervalProof& proof) {
                                 const bool is_proved = !proof.parts.empty();
                                 return Json{
                                     {"proved", json_list(proof.parts, of_interval)},
                                     {"boxes", proof.boxes},
                                     {"reason", is_proved ? Json(nullptr) : Json(proof.reason)}};
                               })},
          {"undecided", json_list(values.undecided, of_interval)},
          {"nearest", values.intervals.empty() ? Json(nullptr) : best},
          {"closest", values.intervals.empty() ? best : Json(nullptr)}};
}

}  // namespace

std::string design_text(const SearchedDesignReport& report) {
  const Answer& present = report.present.answer;
  const std::string met = !is_known(report.target, present) ? "undecided"
                          : is_met(report.target, present)  ? "met"
                                                            : "not met";
  return fmt::format("target: {}\nat present: {}, {}\n\n", report.target_text,
                     result_text(present, report.angle), met) +
         table_of_results(report) + borders_text(report) + reasons(report) + proofs_text(report) +
         wrapped(certainty(report));
}

std::string design_json(const SearchedDesignReport& report) {
  const Answer& present = report.present.answer;
  Json json = json_head("design", report.drive, report.provenance);
  json["target"] = report.target_text;
  json["met"] = is_known(report.target, present) ? Json(is_met(report.target, present)) : nullptr;
  json["present"] = {{"performance", json_performance(present)},
                     {"loop", json_loop(report.present.answer.loop)},
                     {"response", json_response(report.present.answer)}};
  json["answers"] = json_list(report.parameters, [&](const SearchedParameter& parameter) {
    return json_parameter(report.drive, parameter);
  });
  return json.dump(2) + "\n";
}

}  // namespace gearlash
