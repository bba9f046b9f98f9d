#include "analysis/grid/grid_pieces.hpp"

#include <algorithm>
#include <array>
#include <future>
#include <mutex>
#include <thread>

#include "base/progress_part.hpp"

namespace gearlash {
namespace {

/// How many points are worked out and handed on at a time.
class PieceLength {
 public:
  PieceLength(const EnginesNeeded& engines, std::size_t longest, const Stopwatch& seconds)
      : longest_(longest),
        shortest_(std::min<std::size_t>(
            longest,
            (engines.search ? 1U : 8U) * std::max(1U, std::thread::hardware_concurrency()))),
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
  std::size_t shortest_;  ///< what evaluate() gives to all cores at a time
  std::size_t points_;
  bool may_change_;
};

/// Of two threads: that which works, and that which takes.
class OneAtATime : public Progress {
 public:
  explicit OneAtATime(Progress& progress) : progress_(progress) {}
  bool go_on(double share, std::size_t bytes = 0) override {
    const std::scoped_lock lock(hearing_);
    return progress_.go_on(share, bytes);
  }

 private:
  Progress& progress_;
  std::mutex hearing_;
};

struct WorkedOut {
  GridCount count;
  double seconds;
};

}  // namespace

GridCount evaluate_in_pieces(const Grid& grid, std::span<const Quantity> quantities,
                             std::size_t first, std::size_t longest, const GridSink& take,
                             Progress& progress, const Stopwatch& seconds) {
  const GridPoints grid_points(grid);
  const std::size_t points = grid.size();
  const auto share_of = [&](std::size_t done) {
    return static_cast<double>(done) / static_cast<double>(points);
  };
  OneAtATime heard(progress);
  GridCount total;
  const auto is_stopped = [&] { return first < points && !heard.go_on(share_of(first)); };
  if (is_stopped()) {
    total.stopped = true;
    return total;
  }
  PieceLength length(grid_points.engines(), longest, seconds);
  const auto now = [&] { return seconds ? seconds() : 0.0; };
  // Into a table of as many rows as the piece has points.
  const auto work_out = [&](std::size_t begin, Table& table) {
    const std::size_t count = box_length(grid, begin, length.points());
    if (table.rows() != count) table = Table(count, quantities);
    // Where no thread can be had, the piece is worked out when it is asked for.
    return std::async(std::launch::async | std::launch::deferred, [&, begin, count] {
      const double start = now();
      ProgressPart part(heard, share_of(begin), share_of(begin + count));
      const GridCount solved = evaluate(grid, grid_points, begin, count, columns_of(table), part);
      return WorkedOut{solved, now() - start};
    });
  };
  std::array<Table, 2> tables;
  std::future<WorkedOut> working;  // after what it works on, so that it ends first
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
    // A piece that a core works out at one go ends without asking.
    total.stopped = is_stopped();
    if (total.stopped) break;
  }
  return total;
}

}  // namespace gearlash
