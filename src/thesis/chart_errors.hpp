// How far the charts of 1960 are off, over the whole of their grid.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "gearlash/progress.hpp"
#include "model/normalized_servo.hpp"
#include "picture/cell_map.hpp"
#include "thesis/settled_cycle.hpp"

namespace gearlash::thesis {

/// The grid of figures 2, 3 and 7 to 11: friction ratios 0.04 … 1 (0.04 only where these figures
/// have it: damping 0.1, or inertia ratio 1), damping 0.1 … 0.6, inertia ratios 1/9 … 9; backlash
/// 0.3.
std::vector<NormalizedServo> charted_servos();

/// Sizes are empty where there is no limit cycle.
struct ChartError {
  NormalizedServo servo;
  std::optional<double> program;
  std::optional<double> exact;

  /// program/exact − 1 where both hunt.
  std::optional<double> relative() const {
    if (!program || !exact) return std::nullopt;
    return *program / *exact - 1.0;
  }
};

/// `cycle_of` runs the program for one servo.
std::vector<ChartError> chart_errors(
    const std::function<SettledCycle(const ProgramParameters&)>& cycle_of,
    Progress& progress = no_progress());

/// The errors as a map, a panel for each friction ratio, in per cent.
CellMap error_map(const std::vector<ChartError>& errors);

}  // namespace gearlash::thesis
