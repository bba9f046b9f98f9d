// Evaluation of the points of a grid on all cores, into columns.
#pragma once

#include <cstddef>
#include <limits>
#include <span>

#include "closed_form/lanes/cycle_batch.hpp"
#include "question/map/grid_points.hpp"

namespace gearlash {

/// The threads and the vector unit to use.
struct Workers {
  std::size_t threads = 0;  ///< 0: one per core
  VectorUnit unit = widest_vector_unit();
};

/// How the points of a grid were answered.
struct GridCount {
  BatchCount solved{};       ///< in closed form
  std::size_t searched = 0;  ///< by the general engine
  std::size_t refused = 0;   ///< no valid drive: verdict undecided, numbers NaN
  std::size_t unproved = 0;  ///< undecided because the requested proof left them open
  bool stopped = false;      ///< before all points were done

  std::size_t points() const {
    return solved.side_by_side + solved.one_by_one + searched + refused;
  }
  /// Adds the counts of other points.
  void add(const GridCount& others);
};

/// Evaluates `count` points from `first` on into the columns' rows 0 … count − 1; see evaluate() in
/// gearlash/grid.hpp. Precondition: faults(grid) is empty, the points are the grid's, first + count
/// ≤ size(), the verdict is among the columns.
GridCount evaluate(const Grid& grid, const GridPoints& points, std::size_t first, std::size_t count,
                   const CycleColumns& columns, Progress& progress = no_progress(),
                   const Workers& workers = {});

/// The same for the drives of a list. Precondition: faults(list) is empty, `points` are of
/// grid_of_ends().
void evaluate(const DriveList& list, const GridPoints& points, const CycleColumns& columns,
              Progress& progress);

/// The table's own columns.
CycleColumns columns_of(Table& table);

/// The quantities that a table of such a grid has unless others are named: the closed form gives
/// fewer than a search. Those of a step take milliseconds each, and are left out.
std::span<const Quantity> quantities_known(const EnginesNeeded& engines);

/// A quantity of the motion: NaN where the drive comes to rest, where a table has amplitude 0.
double of_motion(const Table& table, Quantity quantity, std::size_t row);
double of_motion(Quantity quantity, Verdict verdict, double value);

/// The answer at one place between the points; undecided and NaN where there is no valid drive.
struct PointAnswer {
  Verdict verdict = Verdict::undecided;
  double value = std::numeric_limits<double>::quiet_NaN();
};
/// As evaluate().
PointAnswer answer_at(const GridPoints& points, std::span<const double> place, Quantity quantity,
                      Progress& progress = no_progress());

/// The number of points from `first` on, `most` at most, that form a box of the grid: some values
/// of one axis with all values of the axes after it. Precondition: `first` is 0 or the end of such
/// a box; most > 0.
std::size_t box_length(const Grid& grid, std::size_t first, std::size_t most);

}  // namespace gearlash
