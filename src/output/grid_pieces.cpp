#include "output/grid_pieces.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <future>
#include <thread>

namespace gearlash {
namespace {

using Clock = std::chrono::steady_clock;

/// How many points are worked out and handed on at a time.
class PieceLength {
 public:
  PieceLength(const ServoGrid& grid, std::size_t longest)
      : longest_(longest), may_change_(grid.may_bounce()) {
    if (may_change_) points_ = shortest_;
  }

  std::size_t points() const { return points_; }

  void heed(Clock::duration of_a_piece) {
    constexpr auto aim = std::chrono::seconds(1);
    if (!may_change_) return;
    if (of_a_piece < aim / 2) points_ = std::min(2 * points_, longest_);
    if (of_a_piece > 2 * aim) points_ = std::max(shortest_, points_ / 2);
  }

 private:
  std::size_t longest_;
  /// evaluate() gives a core eight servos that bounce at a time.
  std::size_t shortest_ = std::min<std::size_t>(
      longest_, std::size_t{8} * std::max(1U, std::thread::hardware_concurrency()));
  std::size_t points_ = longest_;
  bool may_change_;
};

struct WorkedOut {
  GridCount count;
  Clock::duration duration;
};

}  // namespace

GridCount evaluate_in_pieces(const ServoGrid& grid, std::size_t first, std::size_t longest,
                             const GridSink& take, const GoingOn& going_on) {
  const std::size_t points = grid.size();
  GridCount total;
  const auto is_stopped = [&] { return first < points && going_on && !going_on(first); };
  if (is_stopped()) {
    total.stopped = true;
    return total;
  }
  PieceLength length(grid, longest);
  // Into a table of as many rows as the piece has points.
  const auto work_out = [&](std::size_t begin, CycleTable& table) {
    const std::size_t count = box_length(grid, begin, length.points());
    if (table.rows() != count) table = CycleTable(count);
    // Where no thread can be had, the piece is worked out when it is asked for.
    return std::async(std::launch::async | std::launch::deferred, [&, begin, count] {
      const Clock::time_point start = Clock::now();
      const GridCount solved = evaluate(
          grid, begin, count, table.columns(),
          {.going_on = [&](std::size_t done) { return !going_on || going_on(begin + done); }});
      return WorkedOut{solved, Clock::now() - start};
    });
  };
  std::array<CycleTable, 2> tables;
  std::future<WorkedOut> working;  // after what it works on, so that it ends first
  if (first < points) working = work_out(first, tables[0]);
  for (std::size_t index = 0; first < points; index = 1 - index) {
    const WorkedOut piece = working.get();
    total.stopped = piece.count.stopped;
    if (total.stopped) break;
    length.heed(piece.duration);
    const CycleTable& table = tables[index];
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
