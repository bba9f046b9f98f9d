#include "output/change_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "output/columns.hpp"
#include "output/json_values.hpp"

namespace gearlash {
namespace {

constexpr int digits = 4;

std::string value_text(const ChangeableDrive& drive, DesignParameter parameter, double value,
                       const ReportUnits& units) {
  if (parameter == DesignParameter::backlash) {
    return significant(units.angle.from_radians(value), digits) + " " + units.angle.name;
  }
  const std::string unit = drive.unit_of(parameter);
  return significant(value, digits) + (unit == "1" ? "" : " " + unit);
}

std::string boundary_text(const ChangeableDrive& drive, const ParameterMargin& margin, double value,
                          const ReportUnits& units) {
  if (std::isnan(value)) return "–";
  const std::string text = value_text(drive, margin.parameter, value, units);
  return margin.present > 0.0 ? text + " (" + change_text(value / margin.present) + ")" : text;
}

std::string overall_text(const OverallMargin& overall) {
  switch (overall.outcome) {
    case MarginOutcome::found:
      break;
    case MarginOutcome::out_of_reach:
      return "No change of all together was found that reaches it.";
    case MarginOutcome::always_hunts:
      return "A shaft has no friction: no change by a ratio ends the hunting.";
    case MarginOutcome::never_hunts:
      return "Without backlash there is nothing to hunt in.";
  }
  const LogChange& change = overall.change;
  return fmt::format(
      "The least change of all together: motor inertia {}, load inertia {}, motor friction {}, "
      "load "
      "friction {}, stiffness {} ({} as the root of the sum of squares of the logarithms).",
      change_text(std::exp(change.motor_inertia)), change_text(std::exp(change.load_inertia)),
      change_text(std::exp(change.motor_friction)), change_text(std::exp(change.load_friction)),
      change_text(std::exp(change.stiffness)), significant(overall.distance, 3));
}

std::string reason(SensitivityOutcome outcome) {
  switch (outcome) {
    case SensitivityOutcome::no_cycle:
      return "there is no limit cycle; of growth at rest:";
    case SensitivityOutcome::undecided:
      return "the servo lies on the boundary of hunting; of growth at rest:";
    case SensitivityOutcome::undamped:
      return "not worked out without damping";
    case SensitivityOutcome::bounces:
      return "not worked out for this motion, in which faces bounce";
    case SensitivityOutcome::available:
      break;
  }
  return "";
}

/// By falling effect on the size, or where there is none on growth at rest.
std::vector<ParameterSensitivity> sorted(const DriveSensitivity& sensitivity,
                                         CycleMeasure measure) {
  std::vector<ParameterSensitivity> numbers = sensitivity.parameters;
  const auto effect = [&](const ParameterSensitivity& number) {
    const double elasticity = number.of[measure].elasticity;
    return std::isnan(elasticity) ? 0.0 : std::abs(elasticity);
  };
  std::stable_sort(numbers.begin(), numbers.end(),
                   [&](const auto& a, const auto& b) { return effect(a) > effect(b); });
  return numbers;
}

}  // namespace

std::string margin_text(const ChangeableDrive& drive, const HuntingMargin& margin,
                        const ReportUnits& units) {
  std::vector<std::vector<std::string>> rows = {{"parameter", "now", "down to", "up to"}};
  bool hunts = false;
  for (const ParameterMargin& one : margin.parameters) {
    hunts = hunts || one.hunts;
    if (std::isnan(one.below) && std::isnan(one.above)) continue;
    rows.push_back({name_of(one.parameter), value_text(drive, one.parameter, one.present, units),
                    boundary_text(drive, one, one.below, units),
                    boundary_text(drive, one, one.above, units)});
  }
  const std::string what = hunts ? "Where hunting ends" : "Where hunting begins";
  std::string text =
      what + ", one change by itself" +
      (rows.size() == 1 ? ": nowhere within a factor of a thousand\n" : "\n" + table_text(rows));
  std::string rest = overall_text(margin.overall);
  if (drive.drivetrain().restitution > 0.0) {
    rest += (rest.empty() ? "" : " ") +
            std::string(
                "With bounces the values above were looked for at many places, not proved "
                "to be the nearest; and the least change is that after which rest ") +
            (hunts ? "is stable, beside which swings may be left." : "is unstable.");
  }
  return rest.empty() ? text : text + wrapped(rest);
}

std::string sensitivity_text(const DriveSensitivity& sensitivity) {
  const std::string why = reason(sensitivity.outcome);
  const bool has_growth = std::isfinite(sensitivity.values[CycleMeasure::growth_at_rest]);
  std::string text = "Sensitivities: per cent for one per cent more";
  text += why.empty() ? "\n" : "; " + why + "\n";
  if (!why.empty() && !has_growth) return text;
  std::vector<std::vector<std::string>> rows = {
      {"number", "size", "frequency", "multiplier", "growth at rest"}};
  const auto shown = [](const Sensitivity& of) {
    return std::isnan(of.elasticity) ? std::string("–") : fmt::format("{:+.3f}", of.elasticity);
  };
  const CycleMeasure first = why.empty() ? CycleMeasure::size : CycleMeasure::growth_at_rest;
  for (const ParameterSensitivity& number : sorted(sensitivity, first)) {
    rows.push_back({number.name, shown(number.of[CycleMeasure::size]),
                    shown(number.of[CycleMeasure::frequency]),
                    shown(number.of[CycleMeasure::multiplier]),
                    shown(number.of[CycleMeasure::growth_at_rest])});
  }
  return text + table_text(rows);
}

nlohmann::ordered_json margin_json(const ChangeableDrive& drive, const HuntingMargin& margin) {
  Json parameters = Json::array();
  for (const ParameterMargin& one : margin.parameters) {
    parameters.push_back({{"parameter", name_of(one.parameter)},
                          {"unit", drive.unit_of(one.parameter)},
                          {"present", json_number(one.present)},
                          {"below", json_number(one.below)},
                          {"above", json_number(one.above)},
                          {"certified", one.kind == SearchKind::certified}});
  }
  Json json = {{"parameters", std::move(parameters)}};
  const OverallMargin& overall = margin.overall;
  if (overall.outcome == MarginOutcome::found) {
    const LogChange& change = overall.change;
    json["overall"] = {{"distance", json_number(overall.distance)},
                       {"motor_inertia", json_number(change.motor_inertia)},
                       {"load_inertia", json_number(change.load_inertia)},
                       {"motor_friction", json_number(change.motor_friction)},
                       {"load_friction", json_number(change.load_friction)},
                       {"stiffness", json_number(change.stiffness)}};
  }
  return json;
}

nlohmann::ordered_json sensitivity_json(const DriveSensitivity& sensitivity) {
  Json numbers = Json::array();
  for (const ParameterSensitivity& number : sensitivity.parameters) {
    Json json = {{"name", number.name}, {"present", json_number(number.present)}};
    for (const CycleMeasure measure : all_cycle_measures) {
      json[name_of(measure)] = {{"slope", json_number(number.of[measure].slope)},
                                {"elasticity", json_number(number.of[measure].elasticity)}};
    }
    numbers.push_back(std::move(json));
  }
  return {{"available", sensitivity.outcome == SensitivityOutcome::available},
          {"numbers", std::move(numbers)}};
}

BarChart tornado_of(const DriveSensitivity& sensitivity) {
  const bool has_size = sensitivity.outcome == SensitivityOutcome::available;
  const CycleMeasure measure = has_size ? CycleMeasure::size : CycleMeasure::growth_at_rest;
  BarChart chart{.title = has_size ? "What the size of the limit cycle depends on"
                                   : "What the growth at rest depends on",
                 .label = std::string(has_size ? "size" : "growth at rest") +
                          ", per cent for one per cent more"};
  for (const ParameterSensitivity& number : sorted(sensitivity, measure)) {
    const double elasticity = number.of[measure].elasticity;
    if (std::isfinite(elasticity)) chart.bars.push_back({number.name, elasticity});
  }
  return chart;
}

}  // namespace gearlash
