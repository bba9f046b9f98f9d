// Evaluation of grids of any size, piece by piece in little memory.
#pragma once

#include <cstddef>
#include <functional>

#include "question/family/evaluation.hpp"

namespace gearlash {

/// A computed piece: as many points from `first` on as the table has rows.
struct GridPiece {
  std::size_t first;
  const Table& table;
  RowCount count;
};
using GridSink = std::function<void(const GridPiece&)>;

/// A clock of the caller, in s. The library itself reads no clock.
using Stopwatch = std::function<double()>;

/// Evaluates the points from `first` on, on all cores, and passes the pieces to `take` in order.
/// While `take` has one piece, which it may write to a file, the next one is computed. `take` is
/// called in the calling thread; an exception from it ends the work and is rethrown.
///
/// A piece has at most `longest` points. Where faces bounce or drives are searched, its length
/// adapts until a piece takes about a second by `seconds`; without a clock it is a few points for
/// each core. Two pieces are held in memory. `progress` receives the share of the whole grid,
/// before the work and now and then. It can stop the work after a piece or within one, which is
/// then lost; the count reports the stop. Precondition: as in evaluate(), longest > 0, `first` is 0
/// or the end of a piece. Searched drives have the same answers in pieces as at once if `longest`
/// is a multiple of longest_run.
RowCount evaluate_in_pieces(const Grid& grid, std::span<const Quantity> quantities,
                            std::size_t first, std::size_t longest, const GridSink& take,
                            Progress& progress = no_progress(), const Stopwatch& seconds = {});

/// The number of points of a piece from `first` on, `most` at most: it ends at the end of a line
/// along the last axis, or in the line in which it begins. Precondition: first < grid.size(), most
/// > 0.
std::size_t piece_length(const Grid& grid, std::size_t first, std::size_t most);

}  // namespace gearlash
