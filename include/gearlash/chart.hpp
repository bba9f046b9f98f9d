// A chart for programs: computed once, looked up in nanoseconds, with a stated error.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <optional>
#include <span>

#include "gearlash/answer.hpp"
#include "gearlash/grid.hpp"
#include "gearlash/quantity.hpp"

namespace gearlash {

/// The source of an answer.
enum class ChartSource : std::uint8_t {
  interpolated,  ///< from a cell of similar servos
  solved,        ///< on the spot, where interpolation would exceed the tolerance
  outside        ///< none: the place is off the chart, or is no valid drive
};

/// "interpolated", "solved", "outside".
[[nodiscard]] const char* name_of(ChartSource source);

/// In SI.
struct ChartAnswer {
  std::optional<double> value{};         ///< empty where there is no cycle
  Verdict verdict = Verdict::undecided;  ///< of the drive there
  /// Stated error, relative (absolute for a growth at rest below 1), without rounding. 0 where
  /// solved; empty outside.
  std::optional<double> error{};
  ChartSource source = ChartSource::outside;  ///< where the value comes from

  bool operator==(const ChartAnswer&) const = default;
};

/// How well a chart interpolates. Errors are as in ChartAnswer; measured errors are relative to the
/// least value in their cell. All are 0 for a chart that interpolates nowhere.
struct ChartAccuracy {
  double stated_error = 0.0;       ///< the largest of all cells; at most the tolerance
  double largest_error = 0.0;      ///< the largest at a checked point
  double typical_error = 0.0;      ///< median over the cells of the largest in each
  std::size_t checked_points = 0;  ///< between the values of the axes, in interpolated cells
  double solved_share = 0.0;       ///< of the cells; a finer grid lowers it and is faster

  bool operator==(const ChartAccuracy&) const = default;
};

struct DesignChartOptions {
  double tolerance = 1e-3;  ///< largest relative error that an interpolated answer may have, 0 … 1
  std::size_t threads = 0;  ///< for building; 0: one per core
};

/// One quantity of the limit cycle over one to five parameters of a drive. A drive without a closed
/// form needs a search for each point. Copies share the computed values.
///
/// Interpolation is cubic along each axis. Growth at rest is interpolated as 1/(1 + μ₀), which
/// stays smooth where μ₀ grows to infinity. Building the chart compares every cell with servos
/// solved half-way between the axes' values: 3ⁿ − 2ⁿ points for n axes, at the middles of its
/// edges, of its faces and of the cell itself. The end intervals of an axis are also compared at
/// their quarters: an error that happens to be small half-way would not show in a cell beyond,
/// because there is none.
///
/// An error is largest about half-way. The value may be many times smaller towards a corner, and
/// the same error is relatively larger there. So the largest error in a cell is divided by the
/// least value in the cell (growth at rest in its interpolated form). The stated error of a cell is
/// 3.2 times the largest such error of the cell and of the cells that touch it, which covers a jump
/// of the slope anywhere on one axis. It is an estimate, not a bound;
/// docs/explanation/chart-errors.md reports how well it did.
///
/// A cell is interpolated if its stated error is within the tolerance and its points, and those of
/// each cell that touches it, are similar: one verdict, all with values or all without, and μ₀
/// farther from 1 than it varies within the cell, so that hunting does not end between the points.
/// Elsewhere each look-up solves the servo, in about a microsecond with plastic contact, in
/// milliseconds with restitution. So no stated error exceeds the tolerance on any grid; a finer
/// grid is only faster. With restitution the verdict rests on a search, and one cycle may replace
/// another; a change within less than half a cell may then be missed.
///
/// The result is the same to the bit for any number of building threads. Concurrent look-ups are
/// safe.
class DesignChart {
 public:
  /// Throws InvalidInput for a grid with faults (faults(grid); its axes are called "axis 1", …) or
  /// without axes; for an axis with fewer than four values, an infinite one or, where logarithmic,
  /// 0; for more than 100,000,000 points, including those compared between the values; and for a
  /// tolerance outside its range.
  DesignChart(Grid grid, Quantity quantity, const DesignChartOptions& options = {});

  /// The answer at a place, one value for each axis in their order. Gives ChartSource::outside
  /// beyond the axes' ranges and for NaN: nothing is extrapolated. Allocates nothing, except where
  /// a drive that bounces is solved. Throws InvalidInput for another number of values.
  [[nodiscard]] ChartAnswer look_up(std::span<const double> place) const;
  [[nodiscard]] ChartAnswer look_up(std::initializer_list<double> place) const {
    return look_up(std::span<const double>(place.begin(), place.size()));
  }

  [[nodiscard]] const Grid& grid() const noexcept;
  [[nodiscard]] Quantity quantity() const noexcept;
  [[nodiscard]] const ChartAccuracy& accuracy() const noexcept;

 private:
  class Cells;  // the computed values
  std::shared_ptr<const Cells> cells_;
};

}  // namespace gearlash
