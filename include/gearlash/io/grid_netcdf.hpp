// The limit cycles of a grid of servos as a NetCDF-4 file, written whole or piece by piece.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "gearlash/chart/cycle_table.hpp"
#include "gearlash/chart/region_boundary.hpp"
#include "gearlash/chart/servo_grid.hpp"
#include "gearlash/io/grid_table.hpp"
#include "gearlash/io/output_file.hpp"
#include "gearlash/io/report_units.hpp"

namespace gearlash {

/// What a file of a grid says.
struct GridContents {
  ServoGrid grid;
  std::vector<CycleQuantity> quantities;  ///< beside the verdict
  Provenance provenance;
  std::string source_text = {};  ///< of the file that asked for it; empty when there was none
  std::vector<MapCurve> hunting_boundary = {};  ///< of a map, whose axes are y and x
};

/// A file that is being written. One dimension an axis, named as its input, with the axis's values;
/// the other inputs as numbers; the verdict as flags and each quantity over all dimensions, NaN
/// where it is not known, each with its long_name and with units as UDUNITS knows them, for which
/// times, speeds and energies are normalised (ω_n = 1, K = 1); the command and the version of
/// Gearlash. The boundary is a list of points, with NaN between curves. CF conventions 1.8; the
/// same grid gives the same bytes, in whatever pieces it is written.
///
/// Every member throws OutputError, naming the file as `shown_name`, where it cannot be written.
class GridNetcdf {
 public:
  /// A new file in which every value has its place and none is written yet.
  static GridNetcdf create(const std::filesystem::path& path, const std::string& shown_name,
                           const GridContents& contents);
  /// A file that create() made of the same contents, to go on with.
  static GridNetcdf reopen(const std::filesystem::path& path, const std::string& shown_name,
                           const GridContents& contents);
  ~GridNetcdf();
  GridNetcdf(GridNetcdf&& other) noexcept;
  GridNetcdf& operator=(GridNetcdf&& other) = delete;

  /// The points from `first` on, as many as the table has rows. Precondition: they are a box of the
  /// grid, see box_length().
  void write(std::size_t first, const CycleTable& cycles);
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

/// The whole table with every quantity, in place of output.write(). Throws OutputError where it
/// cannot be written, and for "-" and devices, into which NetCDF cannot write.
void write_grid_netcdf(const GridTable& table, const OutputFile& output);

}  // namespace gearlash
