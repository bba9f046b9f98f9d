#include "output/change_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/lists.hpp"
#include "gearlash/output.hpp"
#include "output/parameter_text.hpp"

namespace gearlash {
namespace {

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

std::string border_text(const ParameterText& text, const ParameterMargin& margin,
                        const std::optional<double>& value) {
  if (!value) return "–";
  const std::string shown = text.of(*value);
  return margin.present > 0.0 ? shown + " (" + change_text(*value / margin.present) + ")" : shown;
}

std::string combined_text(const HuntingMargin& margin) {
  if (!margin.combined) return "";
  const CombinedMargin& combined = *margin.combined;
  std::vector<std::string> changes;
  for (std::size_t i = 0; i < combined.parameters.size(); ++i) {
    if (combined.factors[i] == 1.0) continue;
    changes.push_back(combined.parameters[i] + " " + change_text(combined.factors[i]));
  }
  return (changes.size() == 1
              ? "No combined change was found that is smaller than that of one alone: "
              : "Smallest combined change found: ") +
         listed(changes) + ".";
}

std::string undecided_text(const Drive& drive, const HuntingMargin& margin) {
  const auto parts_of = [&](const ParameterMargin& one) {
    const ParameterText text(drive, one.parameter);
    const auto named = [&](const Bounds& part) { return one.parameter + " " + text.of(part); };
    return listed(one.undecided, named, "; ");
  };
  const std::string parts = listed(margin.parameters, parts_of, "; ");
  return parts.empty() ? "" : " Undecided: " + parts + ".";
}

/// What the search leaves open.
std::string search_text(const Drive& drive, const HuntingMargin& margin) {
  SearchedGrids grids(drive);
  for (const ParameterMargin& one : margin.parameters) grids.add(one);
  if (grids.text().empty()) return "";
  const std::string located = grids.located_text("Borders");
  return "Searched, not proved: a border nearer than the distance of two values tried may be "
         "missed "
         "(" +
         grids.text() + ")." + (located.empty() ? "" : located + ".") +
         undecided_text(drive, margin);
}

/// What a scan leaves open, where faces bounce.
std::string scanned_text(const HuntingMargin& margin) {
  const auto is_scanned = [](const ParameterMargin& one) {
    return one.kind == SearchKind::scanned;
  };
  if (!any_of(margin.parameters, is_scanned)) return "";
  return std::string(
             "With bounces, the values above come from a scan and are not proved to be the "
             "nearest. "
             "The combined change is the smallest after which rest ") +
         (margin.hunts ? "is stable; hunting may remain beside it." : "is unstable.");
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
  std::vector<std::size_t> order = indices(sensitivity.paths.size());
  const Quantity quantity = quantity_of_effect(sensitivity);
  // Equal ones differ in what is beyond the accuracy of differences.
  const auto falling_effect = [&](std::size_t parameter) {
    constexpr double known_parts = 1e6;
    return -std::round(known_parts *
                       std::abs(elasticity_of(sensitivity, quantity, parameter).value_or(0.0)));
  };
  sort_by(order, falling_effect);
  return order;
}

std::string margin_text(const Drive& drive, const HuntingMargin& margin) {
  TextRows rows = {{"parameter", "now", "down to", "up to"}};
  for (const ParameterMargin& one : margin.parameters) {
    const ParameterText text(drive, one.parameter);
    if (one.choices.empty() && !one.below && !one.above) continue;
    rows.push_back({one.parameter, text.of(one.present), border_text(text, one, one.below),
                    text.is_word()
                        ? listed(one.choices, [&](double choice) { return text.of(choice); })
                        : border_text(text, one, one.above)});
  }
  const bool is_closed = margin.overall.has_value();
  const std::string what = !margin.is_known ? "Where it is known to come to rest"
                           : is_closed
                               ? (margin.hunts ? "Where hunting ends" : "Where hunting begins")
                           : margin.hunts ? "Where it comes to rest"
                                          : "Where it begins to hunt or to run away";
  const std::string nowhere = is_closed ? ": nowhere within a factor of a thousand\n"
                                        : ": nowhere among the values tried\n";
  return what + ", one parameter at a time" +
         (rows.size() == 1 ? nowhere : "\n" + table_text(rows)) +
         sentences(
             {combined_text(margin), is_closed ? overall_text(*margin.overall, margin.hunts) : "",
              scanned_text(margin), search_text(drive, margin),
              margin.stopped ? "The search was stopped: what it did not reach is left out." : ""});
}

std::string sensitivity_text(const Jacobian& sensitivity) {
  const std::string& why = sensitivity.reason;
  std::string text = "Sensitivities: per cent for one per cent more";
  text += why.empty() ? "\n" : "; " + why + "\n";
  const auto is_known = [](const auto& slope) { return slope.has_value(); };
  if (!any_of(sensitivity.slopes, is_known)) return text;
  std::vector<Quantity> columns;
  TextRows rows = {{"number"}};
  for (const Quantity quantity : sensitivity.quantities) {
    if (quantity == Quantity::period || quantity == Quantity::center) continue;
    columns.push_back(quantity);
    rows.front().push_back(words_of(quantity));
  }
  for (const std::size_t parameter : by_falling_effect(sensitivity)) {
    TextRow row = {sensitivity.paths[parameter]};
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

}  // namespace gearlash
