#include "picture/ceiling_picture.hpp"

#include <algorithm>

namespace gearlash {

BarChart ceiling_bars(const AnswerReport& report) {
  const Ceiling& ceiling = *report.answer.ceiling;
  BarChart chart{.title = "What the ceiling of the load is made of",
                 .subtitle = "no motion exceeds " +
                             swing_bound_text(*ceiling.load, report.angle, 4) +
                             " in the end (proved)",
                 .label = "term of the ceiling (" + std::string(report.angle.name) + ")"};
  for (const CeilingTerm& term : ceiling.terms) {
    chart.bars.push_back({.name = term.source, .value = report.angle.from_radians(term.load)});
  }
  std::stable_sort(chart.bars.begin(), chart.bars.end(),
                   [](const Bar& a, const Bar& b) { return a.value > b.value; });
  return chart;
}

}  // namespace gearlash
