#include "picture/answer_bars.hpp"

#include <algorithm>
#include <cmath>

#include "output/change_report.hpp"
#include "picture/curve_panel.hpp"

namespace gearlash {

Plot ceiling_plot(const AnswerReport& report) {
  const Ceiling& ceiling = *report.answer.ceiling;
  std::vector<Bar> bars;
  for (const CeilingTerm& term : ceiling.terms) {
    bars.push_back({.name = term.source, .value = report.angle.from_radians(term.load)});
  }
  std::stable_sort(bars.begin(), bars.end(),
                   [](const Bar& a, const Bar& b) { return a.value > b.value; });
  return plot_of("What the ceiling of the load is made of",
                 "no motion exceeds " + swing_bound_text(*ceiling.load, report.angle, 4) +
                     " in the end (proved)",
                 bar_panel(bars, {.name = "term of the ceiling", .unit = report.angle.name}));
}

std::optional<Plot> tornado_plot(const Jacobian& sensitivity) {
  const Quantity quantity = quantity_of_effect(sensitivity);
  const bool has_amplitude = quantity == Quantity::amplitude;
  std::vector<Bar> bars;
  for (const std::size_t parameter : by_falling_effect(sensitivity)) {
    const auto elasticity = elasticity_of(sensitivity, quantity, parameter);
    if (elasticity && std::isfinite(*elasticity)) {
      bars.push_back({sensitivity.paths[parameter], *elasticity});
    }
  }
  if (bars.empty()) return std::nullopt;
  const std::string name = has_amplitude ? "amplitude" : "growth at rest";
  return plot_of(has_amplitude ? "What the amplitude of the limit cycle depends on"
                               : "What the growth at rest depends on",
                 "", bar_panel(bars, {.name = name + ", per cent for one per cent more"}));
}

}  // namespace gearlash
