#include "gearlash/grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/lists.hpp"
#include "base/range_check.hpp"
#include "question/family/evaluation.hpp"

namespace gearlash {
namespace {

/// The faults of the drive at the ends of the axes, if every combination of ends has faults. Single
/// combinations may be no valid drive (a massless load without friction) where others are.
std::vector<Fault> faults_of_corners(const Grid& grid, bool are_axes_sound) {
  if (!are_axes_sound) return {};  // they cannot replace faulty values of the drive
  std::vector<Fault> found;
  for (const std::vector<double>& corner : corners_of(grid.axes)) {
    found = faults(drive_with(grid.drive, grid.axes, corner));
    if (found.empty()) break;
  }
  return found;
}

/// Whether two axes vary the same parameter.
bool are_same(const Axis& one, const Axis& other, const Drive& drive) {
  if (one.path.find('[') != std::string::npos) return one.path == other.path;
  const Parameter* parameter = parameter_of(one, drive);
  return parameter != nullptr && parameter == parameter_of(other, drive);
}

/// The smallest and the largest value of each path on an axis. Words have no order: all of them.
Grid grid_of_ends(const DriveList& list) {
  Grid grid{.drive = list.drive};
  for (std::size_t i = 0; i < list.paths.size(); ++i) {
    Axis axis{.path = list.paths[i]};
    const std::span<const double> values = list.values[i];
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    axis.values.push_back(*least);
    if (*least < *most) axis.values.push_back(*most);
    grid.axes.push_back(std::move(axis));
  }
  return grid;
}

/// Faults of the shape of a list, and of values that are no numbers.
std::vector<Fault> faults_of_columns(const DriveList& list) {
  RangeCheck check;
  if (list.paths.size() != list.values.size()) {
    check.refuse("values", std::to_string(list.values.size()) + " columns",
                 "must be as many as paths: " + std::to_string(list.paths.size()));
    return check.faults();
  }
  for (std::size_t i = 0; i < list.paths.size(); ++i) {
    const std::span<const double> values = list.values[i];
    if (values.size() != list.size() || values.empty()) {
      check.refuse(list.paths[i], std::to_string(values.size()) + " values",
                   "must be as many as " + list.paths.front() + " has, at least one");
    }
    if (const double* none = first_of(values, [](double value) { return std::isnan(value); })) {
      check.refuse(list.paths[i] + "[" + std::to_string(none - values.data()) + "]", "nan",
                   "must be a number");
    }
  }
  return check.faults();
}

}  // namespace

std::size_t Grid::size() const {
  std::size_t points = 1;
  for (const Axis& axis : axes) points *= axis.values.size();
  return points;
}

Drive Grid::at(std::size_t index) const { return drive_with(drive, axes, values_at(*this, index)); }

std::vector<Fault> faults(const Grid& grid, const std::vector<std::string>& fields) {
  RangeCheck check;
  double points = 1.0;
  const auto name_of_axis = [&](std::size_t i) {
    return i < fields.size() ? fields[i] : "axis " + std::to_string(i + 1);
  };
  for (std::size_t i = 0; i < grid.axes.size(); ++i) {
    const Axis& axis = grid.axes[i];
    check.include(faults_of_axis(axis, grid.drive, name_of_axis(i)));
    points *= static_cast<double>(axis.values.size());
    for (std::size_t j = 0; j < i; ++j) {
      if (!are_same(grid.axes[j], axis, grid.drive)) continue;
      check.refuse(name_of_axis(i), axis.path,
                   "must be another parameter than that of " + name_of_axis(j));
    }
  }
  if (points > most_points_of_a_grid) {
    check.refuse("points", exact_text(points),
                 "must be at most " + exact_text(most_points_of_a_grid) + " on all axes together");
  }
  const bool are_axes_sound = check.faults().empty();
  return check.include(faults_of_corners(grid, are_axes_sound)).faults();
}

std::vector<Fault> faults(const DriveList& list) {
  std::vector<Fault> found = faults_of_columns(list);
  return found.empty() ? faults(grid_of_ends(list), list.paths) : found;
}

Table::Table(std::size_t rows, std::span<const Quantity> quantities, std::size_t line)
    : verdicts_(rows, Verdict::undecided), line_(line == 0 ? rows : line) {
  for (const Quantity quantity : quantities) {
    columns_[static_cast<std::size_t>(quantity)].assign(rows,
                                                        std::numeric_limits<double>::quiet_NaN());
  }
}

bool Table::has(Quantity quantity) const noexcept {
  return !columns_[static_cast<std::size_t>(quantity)].empty();
}

std::span<const double> Table::operator[](Quantity quantity) const {
  const std::vector<double>& column = columns_[static_cast<std::size_t>(quantity)];
  if (column.empty() && rows() > 0) {
    require_none({{"quantity", std::string(name_of(quantity)),
                   "must be one of the quantities of the table"}});
  }
  return column;
}

std::span<double> Table::column(Quantity quantity) noexcept {
  return columns_[static_cast<std::size_t>(quantity)];
}

std::span<const double> Table::line(Quantity quantity, std::size_t number) const {
  return (*this)[quantity].subspan(number * line_, line_);
}

std::size_t Table::smallest(Quantity quantity, std::size_t number) const {
  const std::span<const double> values = line(quantity, number);
  std::size_t least = values.size();
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::isnan(values[i])) continue;
    if (least == values.size() || values[i] < values[least]) least = i;
  }
  return least;
}

Table evaluate(const Grid& grid, std::span<const Quantity> quantities, Progress& progress) {
  require_none(faults(grid));
  Table table(grid.size(), quantities, grid.axes.empty() ? 0 : grid.axes.back().values.size());
  evaluate(Family(grid), grid, 0, table, progress);
  return table;
}

Table evaluate(const DriveList& list, std::span<const Quantity> quantities, Progress& progress) {
  require_none(faults(list));
  Table table(list.size(), quantities);
  const FamilyRows rows{.count = list.size(),
                        .fill = [&](std::size_t first, std::span<double> values) {
                          const std::size_t width = list.paths.size();
                          for (std::size_t i = 0; i < values.size(); ++i) {
                            values[i] = list.values[i % width][first + i / width];
                          }
                        }};
  evaluate(Family(grid_of_ends(list)), rows, {.columns = columns_of(table)}, progress);
  return table;
}

}  // namespace gearlash
