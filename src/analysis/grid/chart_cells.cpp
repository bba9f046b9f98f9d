#include "analysis/grid/chart_cells.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "analysis/grid/grid_evaluation.hpp"
#include "base/on_threads.hpp"
#include "base/special_numbers.hpp"

namespace gearlash::detail {
namespace {

using Position = std::array<std::size_t, CubicTable::most_axes>;

/// Points, nodes or cells: numbered with the last axis fastest.
struct Box {
  std::vector<std::size_t> sizes;

  std::size_t size() const {
    std::size_t all = 1;
    for (const std::size_t size : sizes) all *= size;
    return all;
  }
  std::size_t index_of(const Position& position) const {
    std::size_t index = 0;
    for (std::size_t axis = 0; axis < sizes.size(); ++axis) {
      index = index * sizes[axis] + position[axis];
    }
    return index;
  }
  Position position_of(std::size_t index) const {
    Position position = {};
    for (std::size_t axis = sizes.size(); axis-- > 0;) {
      position[axis] = index % sizes[axis];
      index /= sizes[axis];
    }
    return position;
  }
};

/// The number of parts into which an interval is divided for comparison. The end intervals have
/// four: an error that happens to be small half-way would not show in a cell beyond, because there
/// is none.
std::size_t parts_of(std::size_t interval, std::size_t intervals) {
  return interval == 0 || interval + 1 == intervals ? 4 : 2;
}

/// The index of a node among the points of its axis.
std::size_t point_of_node(std::size_t node, std::size_t intervals) {
  if (node == 0) return 0;
  return 2 * node + (node < intervals ? 2 : 4);
}

std::size_t intervals_of(std::size_t points) { return (points - 5) / 2; }

Box points_of(const Grid& refined_grid) {
  Box box;
  for (const Axis& axis : refined_grid.axes) box.sizes.push_back(axis.values.size());
  return box;
}

Box nodes_of(const Grid& refined_grid) {
  Box box = points_of(refined_grid);
  for (std::size_t& size : box.sizes) size = intervals_of(size) + 1;
  return box;
}

Box cells_of(const Grid& refined_grid) {
  Box box = points_of(refined_grid);
  for (std::size_t& size : box.sizes) size = intervals_of(size);
  return box;
}

double half_way(double one, double next, bool logarithmic) {
  return logarithmic ? std::sqrt(one) * std::sqrt(next) : 0.5 * one + 0.5 * next;
}

/// The values that divide an interval into two or four parts.
std::vector<double> values_between(double one, double next, std::size_t parts, bool logarithmic) {
  const double middle = half_way(one, next, logarithmic);
  if (parts == 2) return {middle};
  return {half_way(one, middle, logarithmic), middle, half_way(middle, next, logarithmic)};
}

/// The error as in ChartAnswer::error. `error` (not negative) and `value` are straightened.
double relative_error(Quantity quantity, double error, double value) {
  if (error == 0.0) return 0.0;
  if (quantity != Quantity::growth_at_rest) return error / value;
  // Growth is 1/value − 1, so a value too small causes a larger error than one too large.
  const double too_small = value - error;
  if (too_small <= 0.0) return infinity;
  const double error_of_growth = error / (too_small * value);
  return error_of_growth / std::max(1.0 / value - 1.0, 1.0);
}

struct Range {
  double least = infinity;
  double greatest = -infinity;

  /// Adds a number; NaN is ignored.
  void add(double value) {
    least = std::fmin(least, value);
    greatest = std::fmax(greatest, value);
  }
  /// 0 if there are numbers of both signs.
  double least_magnitude() const { return std::max({least, -greatest, 0.0}); }
};

/// Whether the points of a cell, added one after the other, are similar.
class Likeness {
 public:
  void add(Verdict verdict, double growth_at_rest, double value) {
    if (points_ == 0) verdict_ = verdict;
    same_verdict_ &= verdict == verdict_;
    if (!std::isnan(value)) ++values_;
    if (value == 0.0) ++zeros_;
    ++points_;
    place_.add(straightened(Quantity::growth_at_rest, growth_at_rest));
  }

  Verdict verdict() const { return verdict_; }
  bool has_value() const { return values_ > 0; }

  bool all_alike() const {
    return same_verdict_ && verdict_ != Verdict::undecided && all_or_none(values_) &&
           all_or_none(zeros_) && far_from_end_of_hunting();
  }

 private:
  bool all_or_none(std::size_t count) const { return count == 0 || count == points_; }

  /// Whether growth at rest is farther from 1 than it varies, so that hunting ends nowhere between
  /// the points.
  bool far_from_end_of_hunting() const {
    constexpr double end = 0.5;
    const double distance = std::max(place_.least - end, end - place_.greatest);
    return distance > place_.greatest - place_.least;
  }

  std::size_t points_ = 0;
  std::size_t values_ = 0;
  std::size_t zeros_ = 0;  // no derivative need show where growth at rest reaches 0
  Verdict verdict_ = Verdict::undecided;
  bool same_verdict_ = true;
  Range place_;  // of growth at rest, straightened
};

/// Compares a table with the solved points of its cells, one cell at a time.
class CellExamination {
 public:
  CellExamination(const CubicTable& table, const Grid& refined_grid, Quantity quantity,
                  const Table& solved)
      : table_(table),
        grid_(refined_grid),
        quantity_(quantity),
        solved_(solved),
        points_(points_of(refined_grid)) {}

  /// The largest error found in the cell, relative to the least value in it. An error is largest
  /// about half-way, but the value may be many times smaller towards a corner, and the error
  /// relatively larger there. Infinite where the points are not similar, NaN where a value is
  /// missing.
  ChartCell examined(const Position& cell) const {
    const Box points = points_of_cell(cell);
    Likeness likeness;
    Range values;          // straightened
    double largest = 0.0;  // error of the straightened value
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Position offset = points.position_of(i);
      const Position point = point_at(cell, offset);
      const std::size_t row = points_.index_of(point);
      const double exact = straightened(quantity_, solved_[quantity_][row]);
      likeness.add(solved_.verdict(row), solved_[Quantity::growth_at_rest][row],
                   solved_[quantity_][row]);
      values.add(exact);
      if (is_node(offset, points) || std::isnan(exact) || std::isnan(largest)) continue;
      const double error = std::abs(interpolated(cell, point) - exact);
      largest = error <= largest ? largest : error;  // NaN propagates
    }
    const double error = relative_error(quantity_, largest, values.least_magnitude());
    return {likeness.all_alike() ? error : infinity, likeness.verdict(), likeness.has_value()};
  }

  /// The number of points compared in a cell.
  std::size_t checked_points(const Position& cell) const {
    const Box points = points_of_cell(cell);
    return points.size() - (std::size_t{1} << points.sizes.size());
  }

 private:
  Box points_of_cell(const Position& cell) const {
    Box box;
    for (std::size_t axis = 0; axis < points_.sizes.size(); ++axis) {
      box.sizes.push_back(parts_of(cell[axis], intervals_of(points_.sizes[axis])) + 1);
    }
    return box;
  }

  static bool is_node(const Position& offset, const Box& points_of_cell) {
    for (std::size_t axis = 0; axis < points_of_cell.sizes.size(); ++axis) {
      if (offset[axis] != 0 && offset[axis] + 1 != points_of_cell.sizes[axis]) return false;
    }
    return true;
  }

  Position point_at(const Position& cell, const Position& offset) const {
    Position point = {};
    for (std::size_t axis = 0; axis < points_.sizes.size(); ++axis) {
      point[axis] = point_of_node(cell[axis], intervals_of(points_.sizes[axis])) + offset[axis];
    }
    return point;
  }

  double interpolated(const Position& cell, const Position& point) const {
    std::array<CubicPlace, CubicTable::most_axes> places;
    const std::size_t axes = table_.axes().size();
    for (std::size_t axis = 0; axis < axes; ++axis) {
      const double value = grid_.axes[axis].values[point[axis]];
      places[axis] = table_.axes()[axis].at(value, cell[axis]);
    }
    return table_.at({places.data(), axes});
  }

  const CubicTable& table_;
  const Grid& grid_;
  Quantity quantity_;
  const Table& solved_;
  Box points_;
};

/// For each cell the largest error of itself and its two neighbors on one axis, of those known.
std::vector<double> largest_beside(const std::vector<double>& errors, const Box& cells,
                                   std::size_t axis) {
  std::size_t stride = 1;
  for (std::size_t i = axis + 1; i < cells.sizes.size(); ++i) stride *= cells.sizes[i];
  std::vector<double> largest = errors;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const std::size_t along = i / stride % cells.sizes[axis];
    if (along > 0) largest[i] = std::fmax(largest[i], errors[i - stride]);
    if (along + 1 < cells.sizes[axis]) largest[i] = std::fmax(largest[i], errors[i + stride]);
  }
  return largest;
}

/// The stated error of each cell, from the largest error found in it and in the cells that touch
/// it. The error of a smooth quantity is nowhere much more than 1.3 times as large. The factor
/// below covers a quantity whose slope jumps at the worst place in the first or last cell of an
/// axis.
std::vector<double> stated_errors(const std::vector<ChartCell>& found, const Box& cells) {
  constexpr double safety = 3.2;
  std::vector<double> errors;
  errors.reserve(found.size());
  for (const ChartCell& cell : found) errors.push_back(cell.error);
  for (std::size_t axis = 0; axis < cells.sizes.size(); ++axis) {
    errors = largest_beside(errors, cells, axis);
  }
  for (double& error : errors) error *= safety;
  return errors;
}

/// The median; 0 if there are no errors.
double typical(std::vector<double> errors) {
  if (errors.empty()) return 0.0;
  const auto middle = errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2);
  std::nth_element(errors.begin(), middle, errors.end());
  return *middle;
}

/// The accuracy of a chart. Cells with a NaN error are solved; `found` has the errors measured in
/// the cells.
ChartAccuracy accuracy_of(const std::vector<ChartCell>& cells, const std::vector<ChartCell>& found,
                          const CellExamination& examination, const Box& box) {
  ChartAccuracy accuracy;
  std::vector<double> errors;
  std::size_t solved = 0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (std::isnan(cells[i].error)) {
      ++solved;
    } else if (cells[i].has_value) {
      errors.push_back(found[i].error);
      accuracy.checked_points += examination.checked_points(box.position_of(i));
      accuracy.stated_error = std::max(accuracy.stated_error, cells[i].error);
      accuracy.largest_error = std::max(accuracy.largest_error, found[i].error);
    }
  }
  accuracy.typical_error = typical(std::move(errors));
  accuracy.solved_share = static_cast<double>(solved) / static_cast<double>(cells.size());
  return accuracy;
}

}  // namespace

double straightened(Quantity quantity, double value) {
  return quantity == Quantity::growth_at_rest ? 1.0 / (1.0 + value) : value;
}

double unstraightened(Quantity quantity, double value) {
  return quantity == Quantity::growth_at_rest ? std::max(1.0 / value - 1.0, 0.0) : value;
}

Grid refined(const Grid& grid) {
  Grid finer = grid;
  for (Axis& axis : finer.axes) {
    const std::vector<double> nodes = axis.values;
    const std::size_t intervals = nodes.size() - 1;
    axis.values = {nodes.front()};
    for (std::size_t i = 0; i < intervals; ++i) {
      const std::vector<double> between =
          values_between(nodes[i], nodes[i + 1], parts_of(i, intervals), axis.logarithmic);
      axis.values.insert(axis.values.end(), between.begin(), between.end());
      axis.values.push_back(nodes[i + 1]);
    }
  }
  return finer;
}

Table solve_points(const Grid& refined_grid, Quantity quantity, std::size_t threads) {
  const std::array wanted = {Quantity::growth_at_rest, quantity};
  Table table(refined_grid.size(), wanted);
  evaluate(refined_grid, GridPoints(refined_grid), 0, table.rows(), columns_of(table),
           no_progress(), {.threads = threads});
  const std::span<double> values = table.column(quantity);
  for (std::size_t row = 0; row < table.rows(); ++row) {
    values[row] = of_motion(table, quantity, row);
  }
  return table;
}

std::vector<double> values_of_nodes(const Grid& refined_grid, Quantity quantity,
                                    std::span<const double> values) {
  const Box points = points_of(refined_grid);
  const Box nodes = nodes_of(refined_grid);
  std::vector<double> of_nodes(nodes.size());
  for (std::size_t i = 0; i < of_nodes.size(); ++i) {
    Position point = nodes.position_of(i);
    for (std::size_t axis = 0; axis < points.sizes.size(); ++axis) {
      point[axis] = point_of_node(point[axis], nodes.sizes[axis] - 1);
    }
    of_nodes[i] = straightened(quantity, values[points.index_of(point)]);
  }
  return of_nodes;
}

ExaminedCells examine_cells(const CubicTable& table, const Grid& refined_grid, Quantity quantity,
                            const Table& points, const DesignChartOptions& options) {
  const CellExamination examination(table, refined_grid, quantity, points);
  const Box cells = cells_of(refined_grid);
  std::vector<ChartCell> found(cells.size());
  on_threads(options.threads, found.size(),
             [&](std::size_t i) { found[i] = examination.examined(cells.position_of(i)); });
  const std::vector<double> stated = stated_errors(found, cells);
  std::vector<ChartCell> decided = found;
  for (std::size_t i = 0; i < decided.size(); ++i) {
    double& error = decided[i].error;
    if (decided[i].has_value && !std::isnan(error)) error = stated[i];
    if (!(error <= options.tolerance)) error = std::numeric_limits<double>::quiet_NaN();
  }
  return {decided, accuracy_of(decided, found, examination, cells)};
}

}  // namespace gearlash::detail
