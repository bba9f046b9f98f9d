#include "picture/tornado.hpp"

#include <cmath>

#include "output/change_report.hpp"

namespace gearlash {

BarChart tornado_of(const Jacobian& sensitivity) {
  const Quantity quantity = quantity_of_effect(sensitivity);
  const bool has_amplitude = quantity == Quantity::amplitude;
  BarChart chart{.title = has_amplitude ? "What the amplitude of the limit cycle depends on"
                                        : "What the growth at rest depends on",
                 .label = std::string(has_amplitude ? "amplitude" : "growth at rest") +
                          ", per cent for one per cent more"};
  for (const std::size_t parameter : by_falling_effect(sensitivity)) {
    const auto elasticity = elasticity_of(sensitivity, quantity, parameter);
    if (elasticity && std::isfinite(*elasticity)) {
      chart.bars.push_back({sensitivity.paths[parameter], *elasticity});
    }
  }
  return chart;
}

}  // namespace gearlash
