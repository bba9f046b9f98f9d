#include "sweep_run.hpp"

#include <fmt/format.h>

#include <system_error>

#include "output/grid_netcdf.hpp"
#include "output/grid_pieces.hpp"
#include "output/output_file.hpp"
#include "sweep_part.hpp"

namespace gearlash {
namespace {

/// Points that are held in memory, written and recorded at a time: 50 MB.
constexpr std::size_t longest_piece = std::size_t{1} << 19U;

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

/// One sweep under way. It is the calling thread that writes, because HDF5 prints its errors in all
/// but the thread in which NetCDF was started.
class Sweeping {
 public:
  Sweeping(const SweepFile& sweep, const Provenance& provenance, SweepPart& part,
           const SweepRun& begun)
      : sweep_(sweep), provenance_(provenance), part_(part), file_(open()), recorded_(begun) {
    if (!part.is_begun()) record(begun);
  }

  /// What was written and recorded in the end.
  SweepRun run(const GoingOn& going_on) {
    const GridCount count = evaluate_in_pieces(
        sweep_.grid, recorded_.points_done, longest_piece,
        [&](const GridPiece& piece) {
          file_.write(piece);
          SweepRun run = recorded_;
          run.count.add(piece.count);
          run.points_done += piece.cycles.rows();
          record(run);
        },
        going_on);
    if (!count.stopped) file_.close();
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
  SweepRun recorded_;
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
