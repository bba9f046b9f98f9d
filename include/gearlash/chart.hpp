// A chart for programs: worked out once, looked up in nanoseconds, with a stated error.
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

/// Where an answer of a chart comes from.
enum class ChartSource : std::uint8_t {
  interpolated,  ///< between servos that are alike
  solved,        ///< at once, where interpolation would not keep the tolerance
  outside        ///< nowhere: the place is not on the chart, or is no servo
};

/// "interpolated", "solved", "outside".
[[nodiscard]] const char* name_of(ChartSource source);

/// In SI.
struct ChartAnswer {
  std::optional<double> value{};  ///< nothing where there is no cycle
  Verdict verdict = Verdict::undecided;
  /// Stated, relative (of a growth at rest below 1: absolute), beside rounding; 0 where solved;
  /// nothing outside.
  std::optional<double> error{};
  ChartSource source = ChartSource::outside;

  bool operator==(const ChartAnswer&) const = default;
};

/// How well a chart interpolates; errors as in ChartAnswer, those found relative to the least value
/// in their cell, 0 for a chart that interpolates nowhere.
struct ChartAccuracy {
  double stated_error = 0.0;       ///< largest of any answer; at most the tolerance
  double largest_error = 0.0;      ///< that was found at a checked point
  double typical_error = 0.0;      ///< median over the cells of the largest found in each
  std::size_t checked_points = 0;  ///< between the values of the axes, in interpolated cells
  double solved_share = 0.0;       ///< of the cells: too large? Then a finer grid is faster.

  bool operator==(const ChartAccuracy&) const = default;
};

struct DesignChartOptions {
  double tolerance = 1e-3;  ///< largest relative error that an interpolated answer may have, 0 … 1
  std::size_t threads = 0;  ///< to build with; 0: as many as the machine has cores
};

/// One quantity of the limit cycle over one to five parameters of a drive that has a closed form:
/// of others each cell takes searches. Copies share what was worked out.
///
/// Interpolation is by a cubic along each axis, of growth at rest as 1/(1 + μ₀), which stays smooth
/// where μ₀ grows to infinity. When the chart is built, every cell is compared with servos solved
/// half-way between the axes' values: 3ⁿ − 2ⁿ of them for n axes, in the middles of its edges, of
/// its faces and of itself. At both ends of an axis, where no cell beyond shows an error that is by
/// chance small half-way, they are solved at the quarters, too.
///
/// An error is largest about half-way, but the value may be many times smaller towards a corner,
/// and there the same error is relatively larger. So the largest that is found in a cell is taken
/// of the least value found in it, growth at rest as it is interpolated. The error stated of a cell
/// is 3.2 times the largest such one of it and of the cells that touch it, which covers a jump of
/// the slope anywhere on one axis. It is an estimate, not a bound; docs/design-charts.md says how
/// well it did.
///
/// A cell is interpolated where the error stated is within the tolerance and its points are alike,
/// as are those of each cell that touches it: with one verdict, with values or without, and with μ₀
/// farther from 1 than it varies within the cell, lest hunting ends between its points. Elsewhere
/// the servo is solved when it is looked up, in about a microsecond with plastic contact, in
/// milliseconds with restitution. So no error stated is above the tolerance, whatever the grid; a
/// finer grid is only faster. With restitution the verdict rests on a search and one cycle may take
/// over from another: what happens within less than half a cell may then be missed.
///
/// The same bits for any number of threads that build it. Any number may look up at once.
class DesignChart {
 public:
  /// Throws InvalidInput for a grid that is not sound (faults(grid); its axes are called "axis
  /// 1", …), has no axis, or an axis with fewer than four values, an infinite one or, where
  /// logarithmic, 0; for more than 100,000,000 points, those compared between the values included;
  /// and for a tolerance outside its range.
  DesignChart(Grid grid, Quantity quantity, const DesignChartOptions& options = {});

  /// The answer at a place, one value for each axis in their order. Outside the axes' ranges, and
  /// for a value that is no number, ChartSource::outside: nothing is extrapolated. Allocates
  /// nothing, but where a drive that bounces is solved. Throws InvalidInput for another number of
  /// values.
  [[nodiscard]] ChartAnswer look_up(std::span<const double> place) const;
  [[nodiscard]] ChartAnswer look_up(std::initializer_list<double> place) const {
    return look_up(std::span<const double>(place.begin(), place.size()));
  }

  [[nodiscard]] const Grid& grid() const noexcept;
  [[nodiscard]] Quantity quantity() const noexcept;
  [[nodiscard]] const ChartAccuracy& accuracy() const noexcept;

 private:
  class Cells;  // what was worked out
  std::shared_ptr<const Cells> cells_;
};

}  // namespace gearlash
