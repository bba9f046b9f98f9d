// Sweeps into a NetCDF file, in little memory, that can be stopped and resumed.
#pragma once

#include <array>
#include <filesystem>

#include "gearlash/input.hpp"
#include "gearlash/output.hpp"
#include "gearlash/units.hpp"
#include "question/map/grid_pieces.hpp"

namespace gearlash {

/// OUTPUT.part and OUTPUT.part.json, beside the file that a symbolic link leads to.
std::array<std::filesystem::path, 2> unfinished_files(const std::filesystem::path& output);

enum class SweepStart : bool {
  anew,   ///< an unfinished sweep into the same file is an InvalidInput
  resume  ///< resumes the unfinished sweep, or starts a new one
};

/// Evaluates the sweep and writes it, block by block, to OUTPUT.part, with its progress in
/// OUTPUT.part.json. OUTPUT.part is renamed when it is complete. If the program is stopped or
/// killed, or the disk is full, the two files remain, and SweepStart::resume continues after the
/// last block. The finished file has the same bytes as one of an uninterrupted run. Memory: two
/// blocks, about 160 MB. `progress` and `seconds` as in evaluate_in_pieces().
///
/// Returns the count of all points done, those of earlier runs included: fewer than the grid has if
/// `progress` stopped the work. The command of `provenance` is written into the file. Throws
/// InvalidInput for an unfinished sweep that is not to be resumed, or that is of another sweep file
/// or version. Throws OutputError if a file cannot be written or the disk has too little room.
RowCount run_sweep(const SweepFile& sweep, const Provenance& provenance,
                   const std::filesystem::path& output, SweepStart start,
                   Progress& progress = no_progress(), const Stopwatch& seconds = {});

}  // namespace gearlash
