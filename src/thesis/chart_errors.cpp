#include "thesis/chart_errors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/progress_part.hpp"
#include "base/special_numbers.hpp"
#include "picture/curve_panel.hpp"
#include "picture/plot_making.hpp"
#include "thesis/exact_curve.hpp"
#include "thesis/figures.hpp"

namespace gearlash::thesis {

std::vector<NormalizedServo> charted_servos() {
  std::vector<NormalizedServo> servos;
  for (const double friction_ratio : charted_friction_ratios) {
    for (int tenth = 1; tenth <= charted_dampings; ++tenth) {
      for (const double inertia_ratio : charted_inertia_ratios) {
        const bool in_figure_2_or_3 = tenth == 1 || inertia_ratio == 1.0;
        if (friction_ratio == 0.04 && !in_figure_2_or_3) continue;
        servos.push_back(charted_servo(tenth / 10.0, inertia_ratio, friction_ratio));
      }
    }
  }
  return servos;
}

std::vector<ChartError> chart_errors(
    const std::function<SettledCycle(const ProgramParameters&, Progress&)>& cycle_of,
    Progress& progress) {
  const std::vector<NormalizedServo> servos = charted_servos();
  std::vector<ChartError> errors;
  for (const NormalizedServo& servo : servos) {
    ProgressPart part(progress, errors.size(), servos.size());
    const SettledCycle cycle = cycle_of(program_parameters(servo), part);
    if (!part.go_on(1.0)) break;  // the run may have been broken off
    errors.push_back({servo, cycle.hunts ? std::optional(cycle.amplitude) : std::nullopt,
                      exact_amplitude(servo)});
  }
  return errors;
}

Plot error_plot(const std::vector<ChartError>& errors) {
  constexpr double rests = std::numeric_limits<double>::infinity();
  Cells cells{.columns = {"1/9", "1/4", "1", "4", "9"},
              .largest = 4.0,
              .letters = 0.7,
              .dot_meaning = "comes to rest"};
  for (int tenth = 1; tenth <= charted_dampings; ++tenth) {
    cells.rows.push_back(fmt::format("0.{}", tenth));
  }
  Plot plot{.title = "The charts of 1960 against the exact sizes",
            .subtitles = {"error of the size in per cent; empty where the thesis has no point"},
            .columns = std::vector<PlotColumn>(3)};
  for (std::size_t i = 0; i < charted_friction_ratios.size(); ++i) {
    const double friction_ratio = charted_friction_ratios.at(i);
    cells.values.assign(charted_dampings, std::vector(charted_inertia_ratios.size(), not_a_number));
    for (const ChartError& error : errors) {
      if (error.servo.friction_ratio != friction_ratio) continue;
      const auto row = static_cast<std::size_t>(std::lround(10.0 * error.servo.damping) - 1);
      const auto column = static_cast<std::size_t>(std::find(charted_inertia_ratios.begin(),
                                                             charted_inertia_ratios.end(),
                                                             error.servo.inertia_ratio) -
                                                   charted_inertia_ratios.begin());
      cells.values.at(row).at(column) = 100.0 * error.relative().value_or(rests);
    }
    const std::size_t column = i % plot.columns.size();
    Panel panel = cell_panel(cells, "inertia ratio", column == 0 ? "damping" : "");
    panel.title = fmt::format("friction ratio {}", friction_ratio);
    panel.height = 230.0;
    plot.columns[column].push_back(std::move(panel));
  }
  return finished(std::move(plot));
}

}  // namespace gearlash::thesis
