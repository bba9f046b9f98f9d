// Grids of any size, worked out piece by piece in little memory.
#pragma once

#include <cstddef>
#include <functional>

#include "analysis/grid/grid_evaluation.hpp"

namespace gearlash {

/// What was worked out: as many points from `first` on as the table has rows, a box of the grid
/// (see box_length()).
struct GridPiece {
  std::size_t first;
  const Table& table;
  GridCount count;
};
using GridSink = std::function<void(const GridPiece&)>;

/// A clock of the caller's, s: the library looks at none.
using Stopwatch = std::function<double()>;

/// Works out the points from `first` on, on all cores, and gives them to `take` in their order:
/// while it has one piece, which it may write to a file, the next is worked out. `take` is called
/// in the calling thread; what it throws ends the work, and is thrown on.
///
/// A piece has `longest` points at most; where faces bounce or drives are searched, as many as
/// take about a second by `seconds`, which is found by and by; without it a few for each core. Two
/// of them are held in memory. `progress` hears the share of the whole grid before the work and now
/// and then; it stops it after a piece or in one that is then lost, and the count says so.
/// Precondition: as in evaluate(), longest > 0, `first` is 0 or where a box ended.
GridCount evaluate_in_pieces(const Grid& grid, std::span<const Quantity> quantities,
                             std::size_t first, std::size_t longest, const GridSink& take,
                             Progress& progress = no_progress(), const Stopwatch& seconds = {});

}  // namespace gearlash
