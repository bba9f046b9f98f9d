#include "sweep_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <system_error>

#include "output/grid_netcdf.hpp"
#include "output/output_file.hpp"
#include "question/map/grid_pieces.hpp"
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

/// Point by point, so that the checksum does not depend on the blocks.
void add(Checksum& checksum, const Table& table, const std::vector<Quantity>& quantities) {
  std::vector<std::span<const double>> columns;
  for (const Quantity quantity : quantities) columns.push_back(table[quantity]);
  for (std::size_t row = 0; row < table.rows(); ++row) {
    checksum.add(static_cast<std::uint64_t>(table.verdict(row)));
    for (const auto& column : columns) checksum.add(std::bit_cast<std::uint64_t>(column[row]));
  }
}

/// The data of an unfinished sweep, which must be those that were recorded.
GridNetcdf reopened(const SweepPart& part, const GridContents& contents,
                    const SweepRecord& recorded) {
  try {
    GridNetcdf file = GridNetcdf::reopen(part.data(), part.shown_output(), contents);
    Checksum found;
    Table table;
    const std::size_t done = recorded.count.points();
    for (std::size_t first = 0; first < done; first += table.rows()) {
      const std::size_t rows =
          box_length(contents.grid, first, std::min(done - first, longest_piece));
      table = Table(rows, contents.quantities);
      file.read(first, table);
      add(found, table, contents.quantities);
    }
    if (found.value() != recorded.data.value()) part.refuse_changed();
    return file;
  } catch (const OutputError&) {
    part.refuse("must be the complete files of an unfinished sweep");
  }
}

}  // namespace

RowCount run_sweep(const SweepFile& sweep, const Provenance& provenance,
                   const std::filesystem::path& output, SweepStart start, Progress& progress) {
  SweepPart part(output);
  if (part.is_begun() && start == SweepStart::anew) {
    throw InvalidInput({{"--output", part.shown_output(),
                         "must have no unfinished sweep beside it: continue " + part.shown_files() +
                             " with --resume, or remove both to start again",
                         ""}});
  }
  const GridContents contents{sweep.grid, sweep.quantities, provenance, sweep.text};
  SweepRecord recorded = part.is_begun() ? part.read_record(contents) : SweepRecord{};
  require_room(part, netcdf_bytes(contents));
  const bool is_new = recorded.count.points() == 0;
  if (is_new) part.write_record(contents, recorded);
  GridNetcdf file = is_new ? GridNetcdf::create(part.data(), part.shown_output(), contents)
                           : reopened(part, contents, recorded);
  const RowCount count = evaluate_in_pieces(
      sweep.grid, sweep.quantities, recorded.count.points(), longest_piece,
      [&](const GridPiece& piece) {
        file.write(piece);
        file.flush();  // first, so that the record never runs ahead of the disk
        SweepRecord next = recorded;
        next.count.add(piece.count);
        add(next.data, piece.table, sweep.quantities);
        part.write_record(contents, next);
        recorded = next;
      },
      progress, cli::steady_seconds);
  if (count.stopped) return recorded.count;
  file.close();
  part.finish();
  return recorded.count;
}

}  // namespace gearlash
