// Grids of any size, worked out piece by piece in little memory.
#pragma once

#include <cstddef>
#include <functional>

#include "analysis/grid/servo_grid.hpp"
#include "closed_form/lanes/cycle_table.hpp"

namespace gearlash {

/// What was worked out: as many points from `first` on as the table has rows, a box of the grid
/// (see box_length()).
struct GridPiece {
  std::size_t first;
  const CycleTable& cycles;
  GridCount count;
};
using GridSink = std::function<void(const GridPiece&)>;

/// Works out the points from `first` on, on all cores, and gives them to `take` in their order:
/// while it has one piece, which it may write to a file, the next is worked out. `take` is called
/// in the calling thread; what it throws ends the work, and is thrown on.
///
/// A piece has `longest` points at most; where faces bounce, as many as take about a second, which
/// is found by and by. Two of them are held in memory, 97 bytes a point. `going_on` hears before
/// the work and now and then, in one thread at a time, how many points of the grid are done; false
/// stops, after a piece or in one that is then lost, and the count says so. Precondition: as in
/// evaluate(), longest > 0, `first` is 0 or where a box ended.
GridCount evaluate_in_pieces(const ServoGrid& grid, std::size_t first, std::size_t longest,
                             const GridSink& take, const GoingOn& going_on = {});

}  // namespace gearlash
