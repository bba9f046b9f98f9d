// The errors of the charts of 1960 over their whole grid.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "gearlash/plot.hpp"
#include "gearlash/progress.hpp"
#include "model/normalized_servo.hpp"
#include "thesis/settled_cycle.hpp"

namespace gearlash::thesis {

/// The grid of figures 2, 3 and 7 to 11: friction ratios 0.04 … 1 (0.04 only for damping 0.1 or
/// inertia ratio 1, as in these figures), damping 0.1 … 0.6, inertia ratios 1/9 … 9; backlash 0.3.
std::vector<NormalizedServo> charted_servos();

/// Amplitudes in rad; nothing without a limit cycle.
struct ChartError {
  NormalizedServo servo;
  std::optional<double> program;
  std::optional<double> exact;

  /// program/exact − 1 if both hunt.
  std::optional<double> relative() const {
    if (!program || !exact) return std::nullopt;
    return *program / *exact - 1.0;
  }
};

/// `cycle_of` runs the program for one servo. A servo at which Progress stops the work is left out,
/// and those after it.
std::vector<ChartError> chart_errors(
    const std::function<SettledCycle(const ProgramParameters&, Progress&)>& cycle_of,
    Progress& progress = no_progress());

/// The errors in per cent as cells, with a panel for each friction ratio.
Plot error_plot(const std::vector<ChartError>& errors);

}  // namespace gearlash::thesis
