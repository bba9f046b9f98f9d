// Sweeps of any size into a NetCDF file, in little memory, that may be stopped and gone on with.
#pragma once

#include <cstddef>
#include <filesystem>

#include "analysis/grid/grid_evaluation.hpp"
#include "input/sweep_file.hpp"
#include "output/report_units.hpp"

namespace gearlash {

enum class SweepStart {
  anew,   ///< an unfinished sweep into the same file is an InvalidInput
  resume  ///< goes on with the unfinished sweep, or starts where there is none
};

struct SweepRun {
  GridCount count;              ///< of all points, those of earlier runs included
  std::size_t points_done = 0;  ///< all of them, unless stopped; those that a resumed run finds
};

/// Works out the sweep and writes it, piece by piece, to OUTPUT.part beside OUTPUT.part.json, which
/// says how far it has come; when all is there, OUTPUT.part is renamed. Whenever the program is
/// stopped, killed, or fails because the disk is full, the two files remain, and SweepStart::resume
/// goes on from the last piece: the finished file has the same bytes as one of an uninterrupted
/// run. Memory: some 130 MB for any number of points. `progress` as in evaluate_in_pieces().
///
/// The command of `provenance` is written into the file as it is. Throws InvalidInput for an
/// unfinished sweep that is not to be gone on with, or that is of another sweep file or version;
/// OutputError where a file cannot be written, or the disk has not the room.
SweepRun run_sweep(const SweepFile& sweep, const Provenance& provenance,
                   const std::filesystem::path& output, SweepStart start,
                   Progress& progress = no_progress());

}  // namespace gearlash
