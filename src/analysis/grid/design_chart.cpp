#include "analysis/grid/design_chart.hpp"

#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

#include "analysis/grid/chart_cells.hpp"
#include "analysis/grid/grid_evaluation.hpp"
#include "base/range_check.hpp"

namespace gearlash {
namespace {

/// What a cubic asks for, beyond what a grid does.
void check_axis(RangeCheck& check, const Axis& axis, const std::string& name) {
  if (axis.values.size() < CubicAxis::fewest_values) {
    check.refuse(name, std::to_string(axis.values.size()) + " values",
                 "must be at least " + std::to_string(CubicAxis::fewest_values) +
                     ": a cubic goes through so many");
    return;
  }
  if (std::isinf(axis.values.back())) {
    check.refuse(name, exact_text(axis.values.back()), "must be finite to be interpolated");
  }
  if (axis.logarithmic && axis.values.front() == 0.0) {
    check.refuse(name, "0", "must be positive on a logarithmic axis");
  }
}

double points_with_those_between(const Grid& grid) {
  double points = 1.0;
  for (const Axis& axis : grid.axes) points *= 2.0 * static_cast<double>(axis.values.size()) + 3.0;
  return points;
}

void require_sound(const Grid& grid, double tolerance) {
  RangeCheck check;
  check.include(faults(grid));
  for (std::size_t i = 0; i < grid.axes.size(); ++i) {
    check_axis(check, grid.axes[i], "axis " + std::to_string(i + 1));
  }
  if (grid.axes.empty()) check.refuse("axes", "none", "must be at least one");
  if (grid.axes.size() > CubicTable::most_axes) {
    check.refuse("axes", std::to_string(grid.axes.size()),
                 "must be at most " + std::to_string(CubicTable::most_axes));
  }
  const double points = points_with_those_between(grid);
  if (points > static_cast<double>(most_points_of_a_design_chart)) {
    check.refuse("points", exact_text(points),
                 "must be at most " + std::to_string(most_points_of_a_design_chart) +
                     ", those between the values included: a chart is held in memory");
  }
  require_none(check.within("tolerance", tolerance, 0.0, 1.0).faults());
  // Half-way to a damping of 0 may be a damping that is refused.
  require_none(faults(detail::refined(grid)));
}

}  // namespace

const char* name_of(ChartSource source) {
  switch (source) {
    case ChartSource::interpolated:
      return "interpolated";
    case ChartSource::solved:
      return "solved";
    case ChartSource::outside:
      return "outside";
  }
  return "";
}

DesignChart::DesignChart(Grid grid, Quantity quantity, const DesignChartOptions& options)
    : grid_((require_sound(grid, options.tolerance), std::move(grid))),
      points_(grid_),
      quantity_(quantity) {
  const Grid refined_grid = detail::refined(grid_);
  const Table points = detail::solve_points(refined_grid, quantity, options.threads);
  table_ =
      CubicTable(grid_.axes, detail::values_of_nodes(refined_grid, quantity, points[quantity]));
  detail::ExaminedCells examined =
      detail::examine_cells(table_, refined_grid, quantity, points, options);
  cells_ = std::move(examined.cells);
  accuracy_ = examined.accuracy;
}

ChartAnswer DesignChart::look_up(std::span<const double> place) const {
  const std::vector<CubicAxis>& axes = table_.axes();
  if (place.size() != axes.size()) {
    throw std::invalid_argument("place: " + std::to_string(place.size()) + " values; must be " +
                                std::to_string(axes.size()) + ", one for each axis");
  }
  std::array<CubicPlace, CubicTable::most_axes> places;
  std::size_t index = 0;
  for (std::size_t axis = 0; axis < axes.size(); ++axis) {
    if (!axes[axis].contains(place[axis])) return {};
    places[axis] = axes[axis].at(place[axis]);
    index = index * axes[axis].intervals() + places[axis].interval;
  }
  const detail::ChartCell& cell = cells_[index];
  if (std::isnan(cell.error)) return solved(place);
  ChartAnswer answer{
      .verdict = cell.verdict, .error = cell.error, .source = ChartSource::interpolated};
  if (cell.has_value) {
    answer.value = detail::unstraightened(quantity_, table_.at({places.data(), axes.size()}));
  }
  return answer;
}

ChartAnswer DesignChart::solved(std::span<const double> place) const {
  const PointAnswer answer = answer_at(points_, place, quantity_);
  if (!answer.is_drive) return {};
  return {.value = of_motion(quantity_, answer.verdict, answer.value),
          .verdict = answer.verdict,
          .error = 0.0,
          .source = ChartSource::solved};
}

}  // namespace gearlash
