// The limit cycles of a grid of servos as text, JSON and a family of curves.
#pragma once

#include <optional>
#include <vector>

#include "analysis/grid/region_boundary.hpp"
#include "analysis/grid/servo_grid.hpp"
#include "closed_form/lanes/cycle_table.hpp"
#include "output/output_file.hpp"
#include "output/report_units.hpp"
#include "picture/line_chart.hpp"

namespace gearlash {

/// A grid worked out, a row a point. Normalised: times in units of 1/ω_n.
struct GridTable {
  ServoGrid grid;
  CycleTable cycles;
  Provenance provenance;
  std::optional<std::vector<MapCurve>> hunting_boundary = std::nullopt;      ///< of a map
  std::optional<std::vector<MapCurve>> dissipative_boundary = std::nullopt;  ///< likewise
};

/// A line a point: the inputs on the axes, the verdict and every quantity; empty where not known.
void write_grid_csv(const GridTable& table, const TextSink& sink);

/// Axes, and each quantity as an array with the last axis fastest; null where not known. A map's
/// boundary as a list of curves, each a list of points [x, y].
void write_grid_json(const GridTable& table, const TextSink& sink);

/// The quantity over the last axis, a curve for each value of the first, or one curve where there
/// is one axis. With plastic contact the curves of what vanishes with the cycle are drawn on to
/// where hunting ends. A servo without neighbours is a mark. With the backlash 1 and on no axis the
/// angles are told in backlashes. Precondition: one axis or two.
LineChart chart_of(const GridTable& table, CycleQuantity quantity);

}  // namespace gearlash
