#include "question/map/grid_pieces.hpp"

#include <algorithm>
#include <array>
#include <future>
#include <thread>

#include "base/progress_part.hpp"
#include "base/shared_progress.hpp"
#include "question/family/followed_drives.hpp"

namespace gearlash {
namespace {

/// The number of points in the next piece.
class PieceLength {
 public:
  PieceLength(const EnginesNeeded& engines, std::size_t longest, const Stopwatch& seconds)
      : longest_(longest),
        shortest_(
            std::min<std::size_t>(longest, (engines.search ? longest_run : 8U) *
                                               std::max(1U, std::thread::hardware_concurrency()))),
        points_(longest),
        may_change_(seconds && (engines.bounces || engines.search)) {
    if (engines.bounces || engines.search) points_ = shortest_;
  }

  std::size_t points() const { return points_; }

  void heed(double seconds_of_a_piece) {
    constexpr double aim = 1.0;
    if (!may_change_) return;
    if (seconds_of_a_piece < 0.5 * aim) points_ = std::min(2 * points_, longest_);
    if (seconds_of_a_piece > 2.0 * aim) points_ = std::max(shortest_, points_ / 2);
  }

 private:
  std::size_t longest_;
  std::size_t shortest_;  ///< what evaluate() distributes to all cores at a time
  std::size_t points_;
  bool may_change_;
};

struct WorkedOut {
  RowCount count;
  double seconds;
};

}  // namespace

std::size_t piece_length(const Grid& grid, std::size_t first, std::size_t most) {
  const std::size_t line = grid.axes.back().values.size();
  const std::size_t left = line - first % line;
  const std::size_t points = std::min(most, grid.size() - first);
  return points < left ? points : points - (points - left) % line;
}

RowCount evaluate_in_pieces(const Grid& grid, std::span<const Quantity> quantities,
                            std::size_t first, std::size_t longest, const GridSink& take,
                            Progress& progress, const Stopwatch& seconds) {
  const Family family(grid);
  const std::size_t points = grid.size();
  const auto share_of = [&](std::size_t done) {
    return static_cast<double>(done) / static_cast<double>(points);
  };
  SerialProgress heard(progress);
  RowCount total;
  const auto is_stopped = [&] { return first < points && !heard.go_on(share_of(first)); };
  if (is_stopped()) {
    total.stopped = true;
    return total;
  }
  PieceLength length(family.engines(), longest, seconds);
  const auto now = [&] { return seconds ? seconds() : 0.0; };
  // Computes a piece into a table with one row per point.
  const auto work_out = [&](std::size_t begin, Table& table) {
    const std::size_t count = piece_length(grid, begin, length.points());
    if (table.rows() != count) table = Table(count, quantities);
    // Without a free thread the piece is computed when it is needed.
    return std::async(std::launch::async | std::launch::deferred, [&, begin, count] {
      const double start = now();
      ProgressPart part(heard, share_of(begin), share_of(begin + count));
      const RowCount solved = evaluate(family, grid, begin, table, part);
      return WorkedOut{solved, now() - start};
    });
  };
  std::array<Table, 2> tables;
  std::future<WorkedOut> working;  // declared after its data, so that it is destroyed first
  if (first < points) working = work_out(first, tables[0]);
  for (std::size_t index = 0; first < points; index = 1 - index) {
    const WorkedOut piece = working.get();
    total.stopped = piece.count.stopped;
    if (total.stopped) break;
    length.heed(piece.seconds);
    const Table& table = tables[index];
    const std::size_t next = first + table.rows();
    if (next < points) working = work_out(next, tables[1 - index]);
    take({first, table, piece.count});
    total.add(piece.count);
    first = next;
    // A piece that one core computes in one step ends without calling progress.
    total.stopped = is_stopped();
    if (total.stopped) break;
  }
  return total;
}

}  // namespace gearlash
