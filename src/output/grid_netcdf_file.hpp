// The answers of a grid as a NetCDF-4 file, written whole or in parts.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "output/grid_description.hpp"
#include "output/netcdf_file.hpp"
#include "output/output_file.hpp"
#include "question/map/grid_pieces.hpp"
#include "question/map/map_regions.hpp"

namespace gearlash {

/// A file that is being written. Each axis is a dimension, named as its column (column_name()),
/// with the axis's values or the words of its choices. Over all dimensions the file has the verdict
/// as flags and each quantity, NaN where it is not known. It also has the drive's other numbers,
/// the drive as TOML, and the command and version of Gearlash. Variables have a long_name and SI
/// units as UDUNITS spells them. The boundary is a list of points with NaN between curves. The file
/// follows the CF conventions 1.8. The same grid gives the same bytes, however the writing is
/// divided.
///
/// Every member throws OutputError, naming the file as `shown_name`, if the file cannot be written.
class GridNetcdfFile {
 public:
  /// Makes a file in which every value has its place and no point is written yet.
  static GridNetcdfFile create(const std::filesystem::path& path, const std::string& shown_name,
                               const GridContents& contents);
  /// Reopens a file that create() made with the same contents, to resume writing. Throws
  /// OutputError also if its attributes or axes are not those of `contents`.
  static GridNetcdfFile reopen(const std::filesystem::path& path, const std::string& shown_name,
                               const GridContents& contents);

  void write(const GridPiece& piece);
  /// Fills the table with the file's values of written points: as many as the table has rows, from
  /// `first` on, which must be a box of the grid. Columns of quantities that the file does not have
  /// stay unchanged.
  void read(std::size_t first, Table& table) const;
  /// Writes the boundary of a map with the axes y and x. Call it once. Without a curve it writes
  /// nothing.
  void write_boundary(const std::vector<MapCurve>& boundary);
  /// Writes whether each point meets a target, as flags. Call it once, on a file of create().
  void write_target(std::span<const PlaceKind> kinds);
  /// Writes everything to the disk (fsync).
  void flush() { file_.flush(); }
  void close() { file_.close(); }

 private:
  GridNetcdfFile(NetcdfFile file, const GridContents& contents)
      : file_(std::move(file)), grid_(contents.grid), quantities_(contents.quantities) {}
  void describe(const GridContents& contents);
  /// Whether the file describes the grid as describe() wrote it.
  bool describes(const GridContents& contents) const;
  void find_variables();
  void claim_places();
  void begin_flush_now_and_then(const GridPiece& piece);

  NetcdfFile file_;
  Grid grid_;
  std::vector<Quantity> quantities_;
  std::vector<NetcdfDimension> dimensions_;  ///< of the axes, where it was created
  NetcdfVariable verdict_ = 0;
  std::vector<NetcdfVariable> variables_;  ///< of the quantities
  std::vector<signed char> flags_;
  std::size_t flushed_ = 0;  ///< points written before the last begin_flush()
};

}  // namespace gearlash
