// The cells of a chart that may be interpolated, and those that may not.
#pragma once

#include <cstddef>
#include <vector>

#include "analysis/grid/cubic_table.hpp"
#include "gearlash/chart.hpp"

namespace gearlash::detail {

/// The form in which the quantity is interpolated: 1/(1 + μ₀) for growth at rest (0 where a shaft
/// has no friction, ½ where hunting ends), else the quantity itself.
double straightened(Quantity quantity, double value);
/// The inverse of straightened().
double unstraightened(Quantity quantity, double value);

/// The grid with an additional value half-way between each two of an axis, in the axis's own scale,
/// and three additional values in its first and last intervals.
Grid refined(const Grid& grid);

/// Growth at rest and the quantity at the points of a refined grid, NaN where there is no cycle.
/// Precondition: faults(refined_grid) is empty.
Table solve_points(const Grid& refined_grid, Quantity quantity, std::size_t threads);

/// The straightened values at the points of the unrefined grid.
std::vector<double> values_of_nodes(const Grid& refined_grid, Quantity quantity,
                                    std::span<const double> values);

struct ChartCell {
  double error;  ///< stated; NaN where the servo must be solved
  Verdict verdict;
  bool has_value;
};

/// The cells of a table and its accuracy in them.
struct ExaminedCells {
  std::vector<ChartCell> cells;
  ChartAccuracy accuracy;
};

ExaminedCells examine_cells(const CubicTable& table, const Grid& refined_grid, Quantity quantity,
                            const Table& points, const DesignChartOptions& options);

}  // namespace gearlash::detail
