// The answers of a grid as a NetCDF-4 file, written whole or piece by piece.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "analysis/grid/grid_pieces.hpp"
#include "analysis/grid/region_boundary.hpp"
#include "output/netcdf_file.hpp"
#include "output/output_file.hpp"
#include "output/report_units.hpp"

namespace gearlash {

/// What a file of a grid says.
struct GridContents {
  Grid grid;
  std::vector<Quantity> quantities;  ///< beside the verdict
  Provenance provenance;
  std::string source_text = {};  ///< of the file that asked for it; empty when there was none
};

/// A file that is being written. One dimension an axis, named as its column (column_name()), with
/// the axis's values, or the words of its choices; the drive's other numbers; the verdict as flags
/// and each quantity over all dimensions, NaN where it is not known, each with its long_name and
/// with SI units as UDUNITS knows them; the drive as TOML; the command and the version of Gearlash.
/// The boundary is a list of points, with NaN between curves. CF conventions 1.8; the same grid
/// gives the same bytes, in whatever pieces it is written.
///
/// Every member throws OutputError, naming the file as `shown_name`, where it cannot be written.
class GridNetcdf {
 public:
  /// A new file in which every value has its place and none is written yet.
  static GridNetcdf create(const std::filesystem::path& path, const std::string& shown_name,
                           const GridContents& contents);
  /// A file that create() made of the same contents, to go on with. OutputError too where its
  /// attributes or axes are not those of `contents`.
  static GridNetcdf reopen(const std::filesystem::path& path, const std::string& shown_name,
                           const GridContents& contents);

  void write(const GridPiece& piece);
  /// Of points that were written, from `first` on as many as the table has rows (a box of the
  /// grid), what the file holds; the columns of other quantities stay.
  void read(std::size_t first, Table& table) const;
  /// Of a map, whose axes are y and x, once; no curve: nothing is written.
  void write_boundary(const std::vector<MapCurve>& boundary);
  /// Brings what was written to the disk (fsync).
  void flush() { file_.flush(); }
  void close() { file_.close(); }

 private:
  GridNetcdf(NetcdfFile file, const GridContents& contents)
      : file_(std::move(file)), grid_(contents.grid), quantities_(contents.quantities) {}
  void describe(const GridContents& contents);
  /// Whether the file says of the grid what describe() wrote.
  bool describes(const GridContents& contents) const;
  void find_variables();
  void claim_places();
  void begin_flush_now_and_then(const GridPiece& piece);

  NetcdfFile file_;
  Grid grid_;
  std::vector<Quantity> quantities_;
  NetcdfVariable verdict_ = 0;
  std::vector<NetcdfVariable> variables_;  ///< of the quantities
  std::vector<signed char> flags_;
  std::size_t flushed_ = 0;  ///< points written before the last begin_flush()
};

/// Bytes that the values of such a file take.
std::size_t netcdf_bytes(const GridContents& contents);

}  // namespace gearlash
