#include <array>
#include <cmath>
#include <string>

#include "analysis/grid/chart_cells.hpp"
#include "analysis/grid/grid_evaluation.hpp"
#include "analysis/grid/grid_points.hpp"
#include "base/range_check.hpp"
#include "gearlash/chart.hpp"

namespace gearlash {
namespace {

/// A chart is held in memory, including the points compared between the values of its axes.
constexpr std::size_t most_points = 100'000'000;

/// The requirements of a cubic beyond those of a grid.
void check_axis(RangeCheck& check, const Axis& axis, const std::string& name) {
  if (axis.values.size() < CubicAxis::fewest_values) {
    check.refuse(
        name, std::to_string(axis.values.size()) + " values",
        "must be at least " + std::to_string(CubicAxis::fewest_values) + ": a cubic needs them");
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
  if (points > static_cast<double>(most_points)) {
    check.refuse("points", exact_text(points),
                 "must be at most " + std::to_string(most_points) +
                     ", those between the values included: a chart is held in memory");
  }
  require_none(check.within("tolerance", tolerance, 0.0, 1.0).faults());
  // A value half-way to a damping of 0 may be refused.
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

class DesignChart::Cells {
 public:
  Cells(Grid grid, Quantity quantity, const DesignChartOptions& options);

  ChartAnswer look_up(std::span<const double> place) const;

  Grid grid;
  Quantity quantity;
  ChartAccuracy accuracy{};

 private:
  void solve(std::span<const double> place, ChartAnswer& answer) const;
  [[noreturn]] void refuse(std::size_t count) const;

  GridPoints points_;
  CubicTable table_{};                      ///< straightened
  std::vector<detail::ChartCell> cells_{};  ///< the last axis fastest
};

DesignChart::Cells::Cells(Grid sound_grid, Quantity of, const DesignChartOptions& options)
    : grid(std::move(sound_grid)), quantity(of), points_(grid) {
  const Grid refined_grid = detail::refined(grid);
  const Table points = detail::solve_points(refined_grid, quantity, options.threads);
  table_ = CubicTable(grid.axes, detail::values_of_nodes(refined_grid, quantity, points[quantity]));
  detail::ExaminedCells examined =
      detail::examine_cells(table_, refined_grid, quantity, points, options);
  cells_ = std::move(examined.cells);
  accuracy = examined.accuracy;
}

// All paths return one object, so that none is copied. A copy would take longer than the cubic.
ChartAnswer DesignChart::Cells::look_up(std::span<const double> place) const {
  ChartAnswer answer;
  const std::vector<CubicAxis>& axes = table_.axes();
  if (place.size() != axes.size()) refuse(place.size());
  std::array<CubicPlace, CubicTable::most_axes> places;
  std::size_t index = 0;
  for (std::size_t axis = 0; axis < axes.size(); ++axis) {
    if (!axes[axis].contains(place[axis])) return answer;
    places[axis] = axes[axis].at(place[axis]);
    index = index * axes[axis].intervals() + places[axis].interval;
  }
  const detail::ChartCell& cell = cells_[index];
  if (std::isnan(cell.error)) {
    solve(place, answer);
    return answer;
  }
  answer.verdict = cell.verdict;
  answer.error = cell.error;
  answer.source = ChartSource::interpolated;
  if (cell.has_value) {
    answer.value = detail::unstraightened(quantity, table_.at({places.data(), axes.size()}));
  }
  return answer;
}

void DesignChart::Cells::solve(std::span<const double> place, ChartAnswer& answer) const {
  const PointAnswer found = answer_at(points_, place, quantity);
  if (!found.is_drive) return;
  answer.verdict = found.verdict;
  answer.error = 0.0;
  answer.source = ChartSource::solved;
  const double value = of_motion(quantity, found.verdict, found.value);
  if (!std::isnan(value)) answer.value = value;
}

void DesignChart::Cells::refuse(std::size_t count) const {
  throw InvalidInput(
      {{"place", std::to_string(count) + " values",
        "must be " + std::to_string(table_.axes().size()) + ", one for each axis", ""}});
}

DesignChart::DesignChart(Grid grid, Quantity quantity, const DesignChartOptions& options) {
  require_sound(grid, options.tolerance);
  cells_ = std::make_shared<const Cells>(std::move(grid), quantity, options);
}

ChartAnswer DesignChart::look_up(std::span<const double> place) const {
  return cells_->look_up(place);
}

const Grid& DesignChart::grid() const noexcept { return cells_->grid; }
Quantity DesignChart::quantity() const noexcept { return cells_->quantity; }
const ChartAccuracy& DesignChart::accuracy() const noexcept { return cells_->accuracy; }

}  // namespace gearlash
