// The answers of a grid as a NetCDF file, written whole or in parts.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "output/grid_description.hpp"
#include "output/netcdf_file.hpp"
#include "question/map/grid_pieces.hpp"
#include "question/map/map_regions.hpp"

namespace gearlash {

/// A file that is being written. Each axis is a dimension, named as its column (column_name()),
/// with the axis's values or the words of its choices. Over all dimensions the file has the verdict
/// as flags and each quantity, NaN where it is not known. It also has the drive's other numbers,
/// the drive as TOML, and the command and version of Gearlash. Variables have a long_name and SI
/// units as UDUNITS spells them. The boundary is a list of points with NaN between curves. The file
/// follows the CF conventions 1.8. The same grid gives the same bytes, however the writing is
/// divided. From the beginning every value has its place, so that a file of a killed program can be
/// read.
///
/// Every member throws what NetcdfFile throws. The descriptor is that of NetcdfFile.
class GridNetcdf {
 public:
  /// Makes the file anew; no point is written yet.
  static GridNetcdf create(int descriptor, const std::string& shown_name,
                           const GridContents& contents);
  /// Opens a file that create() made with the same contents, to resume writing. Throws OutputError
  /// for any other file.
  static GridNetcdf reopen(int descriptor, const std::string& shown_name,
                           const GridContents& contents);

  void write(const GridPiece& piece);
  /// Fills the table with the file's values of written points: as many as the table has rows, from
  /// `first` on. Columns of quantities that the file does not have stay unchanged.
  void read(std::size_t first, Table& table) const;
  /// Writes the boundary of a map with the axes y and x. Call it once. Without a curve it writes
  /// nothing.
  void write_boundary(const std::vector<MapCurve>& boundary);
  /// Writes whether each point meets a target, as flags. Call it once, before write_boundary().
  void write_target(std::span<const PlaceKind> kinds);
  void flush() { file_.flush(); }

 private:
  GridNetcdf(NetcdfFile file, const GridContents& contents)
      : file_(std::move(file)), contents_(contents) {}

  NetcdfFile file_;
  GridContents contents_;
  GridExtras extras_{};
};

/// Evaluates the grid into such a file, each block written while the next one is computed; with the
/// boundary of a map if it is asked for. `progress` and `seconds` as in evaluate_in_pieces().
RowCount write_grid_netcdf(int descriptor, const std::string& shown_name,
                           const GridContents& contents, bool has_boundary, Progress& progress,
                           const Stopwatch& seconds);

/// The number of bytes of the values in such a file.
std::size_t netcdf_bytes(const GridContents& contents);

}  // namespace gearlash
