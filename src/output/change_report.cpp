#include "output/change_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "output/columns.hpp"
#include "output/json_values.hpp"

namespace gearlash {
namespace {

constexpr int digits = 4;

std::string value_text(const ChangeableNumber& number, double value, const AngleUnit& angle) {
  if (number.is_backlash()) {
    return angle_text(value, angle, digits);
  }
  return significant(value, digits) + (number.unit == "1" ? "" : " " + number.unit);
}

std::string boundary_text(const ChangeableNumber& number, const ParameterMargin& margin,
                          const std::optional<double>& value, const AngleUnit& angle) {
  if (!value) return "–";
  const std::string text = value_text(number, *value, angle);
  return margin.present > 0.0 ? text + " (" + change_text(*value / margin.present) + ")" : text;
}

std::string overall_text(const OverallMargin& overall, bool hunts) {
  switch (overall.outcome) {
    case MarginOutcome::found:
      break;
    case MarginOutcome::out_of_reach:
      return "No combined change was found that reaches the limit of hunting.";
    case MarginOutcome::always_hunts:
      return "One shaft has no friction. No change by a ratio stops the hunting.";
    case MarginOutcome::never_hunts:
      return "Without backlash there is no hunting.";
  }
  const LogChange& change = *overall.change;
  return fmt::format(
      "Smallest combined change that {} the hunting: motor inertia {}, load inertia {}, motor "
      "friction {}, load friction {}, stiffness {}.",
      hunts ? "stops" : "starts", change_text(std::exp(change.motor_inertia)),
      change_text(std::exp(change.load_inertia)), change_text(std::exp(change.motor_friction)),
      change_text(std::exp(change.load_friction)), change_text(std::exp(change.stiffness)));
}

/// "motor amplitude".
std::string words_of(Quantity quantity) {
  std::string words(name_of(quantity));
  std::replace(words.begin(), words.end(), '_', ' ');
  return words;
}

}  // namespace

Quantity quantity_of_effect(const Jacobian& sensitivity) {
  return sensitivity.reason.empty() ? Quantity::amplitude : Quantity::growth_at_rest;
}

std::optional<double> elasticity_of(const Jacobian& sensitivity, Quantity quantity,
                                    std::size_t parameter) {
  const std::vector<Quantity>& quantities = sensitivity.quantities;
  const auto found = std::find(quantities.begin(), quantities.end(), quantity);
  if (found == quantities.end()) return std::nullopt;
  return sensitivity.elasticity(static_cast<std::size_t>(found - quantities.begin()), parameter);
}

std::vector<std::size_t> by_falling_effect(const Jacobian& sensitivity) {
  std::vector<std::size_t> order(sensitivity.paths.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const Quantity quantity = quantity_of_effect(sensitivity);
  const auto effect = [&](std::size_t parameter) {
    return std::abs(elasticity_of(sensitivity, quantity, parameter).value_or(0.0));
  };
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return effect(a) > effect(b); });
  return order;
}

std::string margin_text(const ChangeableDrive& drive, const HuntingMargin& margin,
                        const AngleUnit& angle) {
  std::vector<std::vector<std::string>> rows = {{"parameter", "now", "down to", "up to"}};
  bool hunts = false;
  for (const ParameterMargin& one : margin.parameters) {
    hunts = hunts || one.hunts;
    if (!one.below && !one.above) continue;
    const ChangeableNumber& number = drive.number(one.parameter);
    rows.push_back({number.name, value_text(number, one.present, angle),
                    boundary_text(number, one, one.below, angle),
                    boundary_text(number, one, one.above, angle)});
  }
  const std::string what = hunts ? "Where hunting ends" : "Where hunting begins";
  std::string text =
      what + ", one parameter at a time" +
      (rows.size() == 1 ? ": nowhere within a factor of a thousand\n" : "\n" + table_text(rows));
  std::string rest = overall_text(margin.overall, hunts);
  if (drive.drivetrain().restitution > 0.0) {
    rest += (rest.empty() ? "" : " ") +
            std::string(
                "With bounces, the values above come from a scan and are not proved to be the "
                "nearest. The combined change is the smallest after which rest ") +
            (hunts ? "is stable; hunting may remain beside it." : "is unstable.");
  }
  return rest.empty() ? text : text + wrapped(rest);
}

std::string sensitivity_text(const Jacobian& sensitivity) {
  const std::string& why = sensitivity.reason;
  std::string text = "Sensitivities: per cent for one per cent more";
  text += why.empty() ? "\n" : "; " + why + "\n";
  const bool has_any = std::any_of(sensitivity.slopes.begin(), sensitivity.slopes.end(),
                                   [](const auto& slope) { return slope.has_value(); });
  if (!has_any) return text;
  std::vector<Quantity> columns;
  std::vector<std::string> titles = {"number"};
  for (const Quantity quantity : sensitivity.quantities) {
    if (quantity == Quantity::period || quantity == Quantity::center) continue;
    columns.push_back(quantity);
    titles.push_back(words_of(quantity));
  }
  std::vector<std::vector<std::string>> rows = {titles};
  for (const std::size_t parameter : by_falling_effect(sensitivity)) {
    std::vector<std::string> row = {sensitivity.paths[parameter]};
    bool has_one = false;
    for (const Quantity quantity : columns) {
      const std::optional<double> elasticity = elasticity_of(sensitivity, quantity, parameter);
      row.push_back(elasticity ? fmt::format("{:+.3f}", *elasticity) : "–");
      has_one = has_one || elasticity;
    }
    if (has_one) rows.push_back(std::move(row));
  }
  return text + table_text(rows);
}

nlohmann::ordered_json margin_json(const ChangeableDrive& drive, const HuntingMargin& margin) {
  Json json;
  json["parameters"] = json_list(margin.parameters, [&](const ParameterMargin& one) {
    return Json{
        {"parameter", one.parameter},          {"unit", drive.number(one.parameter).unit},
        {"present", json_number(one.present)}, {"below", json_optional(one.below)},
        {"above", json_optional(one.above)},   {"certified", one.kind == SearchKind::certified}};
  });
  json["overall"] = nullptr;
  if (const std::optional<LogChange>& change = margin.overall.change) {
    json["overall"] = {{"distance", json_number(change->length())},
                       {"motor_inertia", json_number(change->motor_inertia)},
                       {"load_inertia", json_number(change->load_inertia)},
                       {"motor_friction", json_number(change->motor_friction)},
                       {"load_friction", json_number(change->load_friction)},
                       {"stiffness", json_number(change->stiffness)}};
  }
  return json;
}

nlohmann::ordered_json sensitivity_json(const Jacobian& jacobian) {
  Json numbers = Json::array();
  for (std::size_t j = 0; j < jacobian.paths.size(); ++j) {
    Json json = {{"parameter", jacobian.paths[j]}, {"present", json_number(jacobian.present[j])}};
    for (std::size_t i = 0; i < jacobian.quantities.size(); ++i) {
      json[std::string(name_of(jacobian.quantities[i]))] = {
          {"slope", json_optional(jacobian.slope(i, j))},
          {"elasticity", json_optional(jacobian.elasticity(i, j))}};
    }
    numbers.push_back(std::move(json));
  }
  return {{"available", jacobian.reason.empty()},
          {"reason", jacobian.reason.empty() ? Json() : Json(jacobian.reason)},
          {"numbers", std::move(numbers)}};
}

}  // namespace gearlash
