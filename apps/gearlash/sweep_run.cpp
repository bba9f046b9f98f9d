#include "sweep_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <system_error>
#include <vector>

#include "analysis/grid/grid_pieces.hpp"
#include "base/checksum.hpp"
#include "output/grid_netcdf.hpp"
#include "output/output_file.hpp"
#include "output/reduced_grid_data.hpp"
#include "sweep_part.hpp"
#include "terminal.hpp"

namespace gearlash {
namespace {

/// Points that are held in memory, written and recorded together: 50 MB.
constexpr std::size_t longest_piece = std::size_t{1} << 19U;

void require_room(const SweepPart& part, std::size_t bytes) {
  std::error_code error;
  const std::filesystem::space_info space = std::filesystem::space(part.data(), error);
  const std::size_t taken = part.bytes();
  if (error || bytes <= taken || bytes - taken <= space.available) return;
  constexpr double gigabyte = 1e9;
  throw OutputError(fmt::format("{}: cannot be written: needs {:.3g} GB, {:.3g} GB are free",
                                part.shown_output(), static_cast<double>(bytes - taken) / gigabyte,
                                static_cast<double>(space.available) / gigabyte));
}

/// Checksum of a file by variable, so that it does not depend on the blocks.
class ChecksumOfData {
 public:
  explicit ChecksumOfData(const SweepFile& sweep)
      : quantities_(sweep.quantities), numbers_(sweep.quantities.size()) {}

  void add(const Table& table) {
    for (const Verdict verdict : table.verdicts()) {
      verdicts_.add(static_cast<std::uint64_t>(verdict));
    }
    for (std::size_t i = 0; i < quantities_.size(); ++i) {
      for (const double number : table[quantities_[i]]) {
        numbers_[i].add(std::bit_cast<std::uint64_t>(number));
      }
    }
  }
  std::uint64_t value() const {
    Checksum all = verdicts_;
    for (const Checksum& numbers : numbers_) all.add(numbers.value());
    return all.value();
  }

 private:
  std::vector<Quantity> quantities_;
  Checksum verdicts_;
  std::vector<Checksum> numbers_;
};

/// One sweep. Only the calling thread writes, because HDF5 prints its errors in every thread except
/// the one in which NetCDF was started.
class Sweeping {
 public:
  Sweeping(const SweepFile& sweep, const Provenance& provenance, SweepPart& part,
           const SweepRecord& begun)
      : sweep_(sweep),
        provenance_(provenance),
        part_(part),
        recorded_(begun.run),
        checksum_(sweep),
        file_(begun.run.points_done > 0 ? reopen() : create()) {
    if (begun.run.points_done > 0) require_data_of(begun);
  }

  /// Returns what was written and recorded.
  SweepRun run(Progress& progress) {
    const GridCount count = evaluate_in_pieces(
        sweep_.grid, sweep_.quantities, recorded_.points_done, longest_piece,
        [&](const GridPiece& piece) {
          file_.write(piece);
          checksum_.add(piece.table);
          SweepRun run = recorded_;
          run.count.add(piece.count);
          run.points_done += piece.table.rows();
          file_.flush();  // first, so that the record never runs ahead of the disk
          record(run);
        },
        progress, cli::steady_seconds);
    if (!count.stopped) file_.close();
    return recorded_;
  }

 private:
  static constexpr char not_whole[] = "must be the complete files of an unfinished sweep";

  GridContents contents() const {
    return {sweep_.grid, sweep_.quantities, provenance_, sweep_.text};
  }

  GridNetcdf create() {
    record(recorded_);
    return GridNetcdf::create(part_.data(), part_.shown_output(), contents());
  }

  GridNetcdf reopen() {
    try {
      return GridNetcdf::reopen(part_.data(), part_.shown_output(), contents());
    } catch (const OutputError&) {
      part_.refuse(not_whole);
    }
  }

  void require_data_of(const SweepRecord& begun) {
    try {
      Table table;
      for (std::size_t first = 0; first < begun.run.points_done; first += table.rows()) {
        const std::size_t left = begun.run.points_done - first;
        table =
            Table(box_length(sweep_.grid, first, std::min(left, longest_piece)), sweep_.quantities);
        file_.read(first, table);
        checksum_.add(table);
      }
    } catch (const OutputError&) {
      part_.refuse(not_whole);
    }
    if (checksum_.value() != begun.checksum_of_data) {
      part_.refuse("must be unchanged since the sweep stopped");
    }
  }

  void record(const SweepRun& run) {
    part_.write_record(sweep_, provenance_, {.run = run, .checksum_of_data = checksum_.value()});
    recorded_ = run;
  }

  const SweepFile& sweep_;
  const Provenance& provenance_;
  SweepPart& part_;
  SweepRun recorded_;
  ChecksumOfData checksum_;
  GridNetcdf file_;
};

/// One sweep that keeps no points.
class Reducing {
 public:
  Reducing(const SweepFile& sweep, const Provenance& provenance, SweepPart& part,
           const SweepRecord& begun)
      : sweep_(sweep),
        provenance_(provenance),
        part_(part),
        done_(begun.run),
        reduced_(sweep.grid, sweep.quantities, sweep.keep) {
    if (done_.points_done == 0) {
      record();
      part_.begin_without_data();
    } else if (!reduced_.unpack(begun.reduced) || reduced_.points() != done_.points_done) {
      part_.refuse("must be unchanged since the sweep stopped");
    }
  }

  SweepRun run(const std::filesystem::path& output, Progress& progress) {
    const auto take = [&](const GridPiece& piece) {
      reduced_.add(piece.table);
      done_.count.add(piece.count);
      done_.points_done += piece.table.rows();
      record_now_and_then();
    };
    evaluate_in_pieces(sweep_.grid, sweep_.quantities, done_.points_done, longest_reduced_piece,
                       take, progress, cli::steady_seconds);
    record();
    if (done_.points_done < sweep_.grid.size()) return done_;
    const GridContents contents{sweep_.grid, sweep_.quantities, provenance_, sweep_.text};
    OutputFile file(output);
    write_reduced_netcdf(contents, reduced_, file);
    file.commit();
    part_.finish_without_data();
    done_.summary = reduced_text(contents, reduced_);
    return done_;
  }

 private:
  /// Points that are held in memory together; a multiple of longest_run.
  static constexpr std::size_t longest_reduced_piece = std::size_t{1} << 15U;

  /// Takes some percent of the time at most.
  void record_now_and_then() {
    constexpr double share = 0.03;
    constexpr double least_pause = 1.0;
    const double now = cli::steady_seconds();
    if (now < next_record_) return;
    record();
    const double end = cli::steady_seconds();
    next_record_ = end + std::max(least_pause, (end - now) / share);
  }

  void record() {
    part_.write_record(sweep_, provenance_, {.run = done_, .reduced = reduced_.packed()});
  }

  const SweepFile& sweep_;
  const Provenance& provenance_;
  SweepPart& part_;
  SweepRun done_;
  ReducedGrid reduced_;
  double next_record_ = 0.0;
};

}  // namespace

SweepRun run_sweep(const SweepFile& sweep, const Provenance& provenance,
                   const std::filesystem::path& output, SweepStart start, Progress& progress) {
  SweepPart part(output);
  if (part.is_begun() && start == SweepStart::anew) {
    throw InvalidInput({{"--output", part.shown_output(),
                         "must have no unfinished sweep beside it: continue " + part.shown_files() +
                             " with --resume, or remove both to start again",
                         ""}});
  }
  const SweepRecord begun = part.is_begun() ? part.read_record(sweep, provenance) : SweepRecord{};
  if (sweep.keep.anything()) {
    return Reducing(sweep, provenance, part, begun).run(output, progress);
  }
  require_room(part, netcdf_bytes({sweep.grid, sweep.quantities, provenance, ""}));
  Sweeping sweeping(sweep, provenance, part, begun);
  SweepRun run = sweeping.run(progress);
  if (run.points_done == sweep.grid.size()) part.finish();
  return run;
}

}  // namespace gearlash
