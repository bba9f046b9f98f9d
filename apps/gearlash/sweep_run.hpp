// Sweeps of any size into a NetCDF file, in little memory, that can be stopped and resumed.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "analysis/grid/grid_evaluation.hpp"
#include "input/sweep_file.hpp"
#include "output/report_units.hpp"

namespace gearlash {

enum class SweepStart {
  anew,   ///< an unfinished sweep into the same file is an InvalidInput
  resume  ///< resumes the unfinished sweep, or starts a new one
};

struct SweepRun {
  GridCount count;              ///< of all points, those of earlier runs included
  std::size_t points_done = 0;  ///< includes those of earlier runs; all unless stopped
  std::string summary{};        ///< of a complete sweep that keeps no points: its tables
};

/// Evaluates the sweep and writes it, block by block, to OUTPUT.part, with its progress in
/// OUTPUT.part.json. OUTPUT.part is renamed when it is complete. If the program is stopped or
/// killed, or the disk is full, the two files remain, and SweepStart::resume continues after the
/// last block. The finished file has the same bytes as one of an uninterrupted run. Memory: about
/// 130 MB for any number of points. `progress` as in evaluate_in_pieces().
///
/// A sweep that does not keep every point (SweepFile::keep) has its state in OUTPUT.part.json alone
/// and writes OUTPUT at the end; what it keeps is the same for any number of runs and threads. It
/// needs memory for what it keeps, and some MB.
///
/// The command of `provenance` is written into the file. Throws InvalidInput for an unfinished
/// sweep that is not to be resumed, or that is of another sweep file or version. Throws OutputError
/// if a file cannot be written or the disk has too little room.
SweepRun run_sweep(const SweepFile& sweep, const Provenance& provenance,
                   const std::filesystem::path& output, SweepStart start,
                   Progress& progress = no_progress());

}  // namespace gearlash
