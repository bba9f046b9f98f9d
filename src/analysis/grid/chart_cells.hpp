// How a chart's cells are told apart: those that may be interpolated, and those that may not.
#pragma once

#include <cstddef>
#include <vector>

#include "analysis/grid/design_chart.hpp"

namespace gearlash::detail {

/// The quantity as it is interpolated: 1/(1 + μ₀) for growth at rest (0 where a shaft has
/// no friction, ½ where hunting ends).
double straightened(CycleQuantity quantity, double value);
/// The quantity again.
double unstraightened(CycleQuantity quantity, double value);

/// The axes with a value half-way, in the axis's own scale, between each two, and with three
/// between the first two and the last two.
ServoGrid refined(const ServoGrid& grid);

/// What is known of the points of a refined grid, the last axis fastest.
struct SolvedPoints {
  std::vector<Verdict> verdict;
  std::vector<double> growth_at_rest;
  std::vector<double> value;  ///< of the chart's quantity
};

/// Precondition: validate(refined_grid) is empty.
SolvedPoints solve_points(const ServoGrid& refined_grid, CycleQuantity quantity,
                          std::size_t threads);

/// The straightened values of the points of the grid itself.
std::vector<double> values_of_nodes(const ServoGrid& refined_grid, CycleQuantity quantity,
                                    const std::vector<double>& values);

/// The cells of a table and how well it does in them.
struct ExaminedCells {
  std::vector<ChartCell> cells;
  ChartAccuracy accuracy;
};

ExaminedCells examine_cells(const CubicTable& table, const ServoGrid& refined_grid,
                            CycleQuantity quantity, const SolvedPoints& points,
                            const DesignChartOptions& options);

}  // namespace gearlash::detail
