#include "gearlash/io/sweep_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <future>
#include <system_error>
#include <thread>

#include "gearlash/io/grid_netcdf.hpp"
#include "gearlash/io/large_table.hpp"
#include "gearlash/io/output_file.hpp"
#include "sweep_part.hpp"

namespace gearlash {
namespace {

using Clock = std::chrono::steady_clock;

/// How many points are held in memory, written and recorded at a time: 50 MB; where faces bounce,
/// as many as take about a second, which is found by and by.
class PieceLength {
 public:
  explicit PieceLength(const ServoGrid& grid) : may_change_(grid.may_bounce()) {
    if (may_change_) points_ = shortest_;
  }

  std::size_t points() const { return points_; }

  void heed(Clock::duration of_a_piece) {
    constexpr auto aim = std::chrono::seconds(1);
    if (!may_change_) return;
    if (of_a_piece < aim / 2) points_ = std::min(2 * points_, longest);
    if (of_a_piece > 2 * aim) points_ = std::max(shortest_, points_ / 2);
  }

 private:
  static constexpr std::size_t longest = std::size_t{1} << 19U;
  /// evaluate() gives a core eight servos that bounce at a time.
  std::size_t shortest_ = 8 * std::max(1U, std::thread::hardware_concurrency());
  std::size_t points_ = longest;
  bool may_change_;
};

struct Piece {
  GridCount count;
  Clock::duration duration;
};

void require_room(const SweepPart& part, std::size_t bytes) {
  std::error_code error;
  const std::filesystem::space_info space = std::filesystem::space(part.data(), error);
  const std::size_t taken = part.bytes();
  if (error || bytes <= taken || bytes - taken <= space.available) return;
  constexpr double gigabyte = 1e9;
  throw OutputError(fmt::format("{}: cannot be written: {:.3g} GB are wanting, {:.3g} GB are free",
                                part.shown_output(), static_cast<double>(bytes - taken) / gigabyte,
                                static_cast<double>(space.available) / gigabyte));
}

void add(GridCount& total, const GridCount& piece) {
  total.solved.side_by_side += piece.solved.side_by_side;
  total.solved.one_by_one += piece.solved.one_by_one;
  total.refused += piece.refused;
}

/// One sweep under way: while a piece is written, the next is worked out. It is the calling thread
/// that writes, because HDF5 prints its errors in all but the thread in which NetCDF was started.
class Sweeping {
 public:
  Sweeping(const SweepFile& sweep, const Provenance& provenance, SweepPart& part,
           const SweepRun& begun)
      : sweep_(sweep),
        provenance_(provenance),
        part_(part),
        file_(open()),
        length_(sweep.grid),
        recorded_(begun) {
    if (!part.is_begun()) record(begun);
  }

  /// What was written and recorded in the end.
  SweepRun run(const GoingOn& going_on) {
    const std::size_t points = sweep_.grid.size();
    std::size_t first = recorded_.points_done;
    if (going_on && !going_on(first)) return recorded_;
    std::future<Piece> working;
    if (first < points) working = work_out(first, tables_[0], going_on);
    for (std::size_t index = 0; first < points; index = 1 - index) {
      const Piece piece = working.get();
      if (piece.count.stopped) return recorded_;
      length_.heed(piece.duration);
      const CycleTable& table = tables_[index];
      const std::size_t next = first + table.rows();
      if (next < points) working = work_out(next, tables_[1 - index], going_on);
      file_.write(first, table);
      SweepRun run = recorded_;
      add(run.count, piece.count);
      run.points_done = next;
      record(run);
      first = next;
      // A piece that a core works out at one go ends without asking.
      if (first < points && going_on && !going_on(first)) return recorded_;
    }
    file_.close();
    return recorded_;
  }

 private:
  GridNetcdf open() {
    const GridContents contents{sweep_.grid, sweep_.quantities, provenance_, sweep_.text};
    if (part_.is_begun()) {
      try {
        return GridNetcdf::reopen(part_.data(), part_.shown_output(), contents);
      } catch (const OutputError&) {
        part_.refuse("must be the whole files that an unfinished sweep leaves");
      }
    }
    part_.remove_record();  // it would be taken for that of the new data
    return GridNetcdf::create(part_.data(), part_.shown_output(), contents);
  }

  /// The piece that starts with point `first`, into a table of as many rows as it has points.
  std::future<Piece> work_out(std::size_t first, CycleTable& table, const GoingOn& going_on) {
    const std::size_t count = box_length(sweep_.grid, first, length_.points());
    if (table.rows() != count) table = large_cycle_table(count);
    return std::async(std::launch::async, [this, first, count, &table, &going_on] {
      const Clock::time_point start = Clock::now();
      const GridCount solved = evaluate(
          sweep_.grid, first, count, table.columns(),
          {.going_on = [&](std::size_t done) { return !going_on || going_on(first + done); }});
      return Piece{solved, Clock::now() - start};
    });
  }

  /// In this order, so that a record never tells of what is not on the disk.
  void record(const SweepRun& run) {
    file_.flush();
    part_.write_record(sweep_, provenance_, run);
    recorded_ = run;
  }

  const SweepFile& sweep_;
  const Provenance& provenance_;
  SweepPart& part_;
  GridNetcdf file_;
  PieceLength length_;
  SweepRun recorded_;
  std::array<CycleTable, 2> tables_;
};

}  // namespace

SweepRun run_sweep(const SweepFile& sweep, const Provenance& provenance,
                   const std::filesystem::path& output, SweepStart start, const GoingOn& going_on) {
  SweepPart part(output);
  if (part.is_begun() && start == SweepStart::anew) {
    throw InvalidInput({{"--output", part.shown_output(),
                         "must not have an unfinished sweep beside it: --resume goes on with " +
                             part.shown_files() + ", or remove both to start again",
                         ""}});
  }
  const SweepRun begun = part.is_begun() ? part.read_record(sweep, provenance) : SweepRun{};
  require_room(part, netcdf_bytes({sweep.grid, sweep.quantities, provenance, ""}));
  Sweeping sweeping(sweep, provenance, part, begun);
  const SweepRun run = sweeping.run(going_on);
  if (run.points_done == sweep.grid.size()) part.finish();
  return run;
}

}  // namespace gearlash
