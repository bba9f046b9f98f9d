// How a chart's cells are told apart: those that may be interpolated, and those that may not.
#pragma once

#include <cstddef>
#include <vector>

#include "analysis/grid/cubic_table.hpp"
#include "gearlash/chart.hpp"

namespace gearlash::detail {

/// The quantity as it is interpolated: 1/(1 + μ₀) for growth at rest (0 where a shaft has
/// no friction, ½ where hunting ends).
double straightened(Quantity quantity, double value);
/// The quantity again.
double unstraightened(Quantity quantity, double value);

/// The axes with a value half-way, in the axis's own scale, between each two, and with three
/// between the first two and the last two.
Grid refined(const Grid& grid);

/// The growth at rest and the quantity at the points of a refined grid, NaN where there is no
/// cycle. Precondition: faults(refined_grid) is empty.
Table solve_points(const Grid& refined_grid, Quantity quantity, std::size_t threads);

/// The straightened values of the points of the grid itself.
std::vector<double> values_of_nodes(const Grid& refined_grid, Quantity quantity,
                                    std::span<const double> values);

struct ChartCell {
  double error;  ///< stated; NaN where the servo is to be solved
  Verdict verdict;
  bool has_value;
};

/// The cells of a table and how well it does in them.
struct ExaminedCells {
  std::vector<ChartCell> cells;
  ChartAccuracy accuracy;
};

ExaminedCells examine_cells(const CubicTable& table, const Grid& refined_grid, Quantity quantity,
                            const Table& points, const DesignChartOptions& options);

}  // namespace gearlash::detail
