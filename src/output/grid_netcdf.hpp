// The answers of a grid as a NetCDF-4 file, written whole or piece by piece.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "analysis/grid/grid_pieces.hpp"
#include "analysis/grid/region_boundary.hpp"
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
  ~GridNetcdf();
  GridNetcdf(GridNetcdf&& other) noexcept;
  GridNetcdf& operator=(GridNetcdf&& other) = delete;

  void write(const GridPiece& piece);
  /// Of points that were written, from `first` on as many as the table has rows (a box of the
  /// grid), what the file holds; the columns of other quantities stay.
  void read(std::size_t first, Table& table) const;
  /// Of a map, whose axes are y and x, once; no curve: nothing is written.
  void write_boundary(const std::vector<MapCurve>& boundary);
  /// Brings what was written to the disk (fsync).
  void flush();
  void close();

 private:
  class Layout;
  explicit GridNetcdf(std::unique_ptr<Layout> layout);

  std::unique_ptr<Layout> layout_;
};

/// Bytes that the values of such a file take.
std::size_t netcdf_bytes(const GridContents& contents);

}  // namespace gearlash
