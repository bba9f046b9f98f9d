// Evaluation of the drives of a family on all cores, into columns or one by one.
#pragma once

#include <cstddef>
#include <functional>
#include <span>

#include "closed_form/lanes/cycle_batch.hpp"
#include "question/analyse.hpp"
#include "question/family/family.hpp"
#include "question/family/followed_drives.hpp"

namespace gearlash {

/// The threads and the vector unit to use.
struct Workers {
  std::size_t threads = 0;  ///< 0: one per core
  VectorUnit unit = widest_vector_unit();
};

/// How the drives were answered.
struct RowCount {
  BatchCount solved{};       ///< in closed form
  std::size_t searched = 0;  ///< by the general engine
  std::size_t refused = 0;   ///< no valid drive: verdict undecided, numbers NaN
  std::size_t unproved = 0;  ///< undecided because the requested proof left them open
  bool stopped = false;      ///< before all were done

  std::size_t points() const {
    return solved.side_by_side + solved.one_by_one + searched + refused;
  }
  /// Adds the counts of other drives.
  void add(const RowCount& others);
};

/// The values of a family's parameters, drive by drive.
struct FamilyRows {
  std::size_t count = 0;
  /// Writes the values of the drives from `first` on, one drive after another, until `values` is
  /// full. Called from several threads at a time.
  std::function<void(std::size_t first, std::span<double> values)> fill{};
  /// Drives beside each other on a line of so many may be followed where they are searched, in runs
  /// of so many. Row 0 lies `into_line` drives into its line.
  std::size_t line = 1;
  std::size_t run = longest_run;
  std::size_t into_line = 0;
};

/// The points `first` … first + count − 1 of a grid, in order. The grid must outlive the rows.
FamilyRows rows_of(const Grid& grid, std::size_t first, std::size_t count);
/// Drives with the values of `table`, one drive after another. The values must outlive the rows.
FamilyRows rows_of(std::span<const double> table, std::size_t width);

/// Receives the answer of a row from several threads at a time; nullptr: no valid drive. Rows that
/// a stop left out have none.
using TakeRow = std::function<void(std::size_t row, const Answer* answer)>;

/// What is asked of every drive.
struct AskedOfRows {
  CycleColumns columns{};  ///< of `count` rows each; the verdict's is among them if there are any
  TakeRow take{};
  /// Of drives that are searched. Figures of columns are computed in any case.
  Wanted wanted{.proofs = false, .borders = false};
  SearchScope scope{};  ///< of drives that are searched, less the drive to be followed
  /// Verdicts in closed form that are not proved become undecided.
  bool proved = false;
  /// Every drive is analysed by itself. Else answers in closed form that are taken have the
  /// verdict, the growth at rest, and the amplitude and the period of one motion, unless `whole`.
  bool one_by_one = false;
  bool whole = false;  ///< all that analyse() gives, with the verdict of the columns
};

/// Evaluates the drives on all cores; see evaluate() in gearlash/grid.hpp. The same bits for any
/// number of threads. Precondition: drives between the ends that the family was made with.
RowCount evaluate(const Family& family, const FamilyRows& rows, const AskedOfRows& asked,
                  Progress& progress = no_progress(), const Workers& workers = {});

/// The grid's points from `first` on, into all rows of a table. Precondition: a family of the grid.
RowCount evaluate(const Family& family, const Grid& grid, std::size_t first, Table& table,
                  Progress& progress = no_progress(), const Workers& workers = {});

/// The table's own columns.
CycleColumns columns_of(Table& table);

/// The quantities that a table of such a grid has unless others are named: the closed form gives
/// fewer than a search. Those of a step take milliseconds each, and are left out.
std::span<const Quantity> quantities_known(const EnginesNeeded& engines);

/// A quantity of the motion: NaN where the drive comes to rest, where a table has amplitude 0.
double motion_value(const Table& table, Quantity quantity, std::size_t row);

/// The answer at one place between the points, as a table of one row; as evaluate().
Table answer_at(const Family& family, std::span<const double> place, Quantity quantity,
                Progress& progress = no_progress());

}  // namespace gearlash
