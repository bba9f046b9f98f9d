// The answers of a grid as a NetCDF-4 file, written whole or in parts.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "output/grid_description.hpp"
#include "output/writing_process.hpp"
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
/// It is written by a child process, because HDF5 (1.10.8) crashes or ends the program where some
/// of its calls or allocations fail. A crash is an OutputError here. One thread at a time may call
/// its members.
///
/// Every member throws OutputError, naming the file as `shown_name`, if the file cannot be written.
/// create() and reopen() also throw what WritingProcess throws.
class GridNetcdf {
 public:
  /// Makes a file in which every value has its place and no point is written yet.
  static GridNetcdf create(const std::filesystem::path& path, const std::string& shown_name,
                           const GridContents& contents);
  /// Reopens a file that create() made with the same contents, to resume writing. Throws
  /// OutputError also if its attributes or axes are not those of `contents`.
  static GridNetcdf reopen(const std::filesystem::path& path, const std::string& shown_name,
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
  void flush();
  /// Writes everything to the file.
  void close();

 private:
  GridNetcdf(const std::string& shown_name, const GridContents& contents,
             const std::function<Server()>& begin);

  Grid grid_;
  std::vector<Quantity> quantities_;
  std::unique_ptr<WritingProcess> process_;
};

/// The number of bytes of the values in such a file.
std::size_t netcdf_bytes(const GridContents& contents);

}  // namespace gearlash
