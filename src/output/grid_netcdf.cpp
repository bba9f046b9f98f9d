#include "output/grid_netcdf.hpp"

#include <array>
#include <limits>
#include <utility>

#include "base/lists.hpp"
#include "base/progress_part.hpp"
#include "question/map/hunting_boundary.hpp"

namespace gearlash {
namespace {

/// The coordinates by axis: y, x.
std::array<std::vector<double>, 2> columns_of(const std::vector<MapCurve>& curves) {
  constexpr double gap = std::numeric_limits<double>::quiet_NaN();
  std::array<std::vector<double>, 2> columns;
  for (const MapCurve& curve : curves) {
    if (&curve != &curves.front()) {
      for (std::vector<double>& column : columns) column.push_back(gap);
    }
    for (const MapPoint& point : curve) {
      columns[0].push_back(point.y);
      columns[1].push_back(point.x);
    }
  }
  return columns;
}

/// The values begin where the header ends that has all extras, so that no value ever moves.
NetcdfLayout layout_of(const GridContents& contents, const GridExtras& extras) {
  const GridExtras all{.has_target = true, .boundary_points = 1};
  const std::size_t begin = layout_of(description_of(contents, all), 0).header_bytes;
  return layout_of(description_of(contents, extras), begin);
}

}  // namespace

GridNetcdf GridNetcdf::create(int descriptor, const std::string& shown_name,
                              const GridContents& contents) {
  return {NetcdfFile::create(descriptor, shown_name, layout_of(contents, {})), contents};
}

GridNetcdf GridNetcdf::reopen(int descriptor, const std::string& shown_name,
                              const GridContents& contents) {
  return {NetcdfFile::reopen(descriptor, shown_name, layout_of(contents, {})), contents};
}

void GridNetcdf::write(const GridPiece& piece) {
  file_.write(verdict_name, piece.first, std::as_bytes(piece.table.verdicts()));
  for (const Quantity quantity : contents_.quantities) {
    file_.write(name_of(quantity), piece.first, piece.table[quantity]);
  }
}

void GridNetcdf::read(std::size_t first, Table& table) const {
  file_.read(verdict_name, first, std::as_writable_bytes(table.column_of_verdicts()));
  for (const Quantity quantity : contents_.quantities) {
    file_.read(name_of(quantity), first, table.column(quantity));
  }
}

void GridNetcdf::write_boundary(const std::vector<MapCurve>& boundary) {
  if (boundary.empty()) return;
  const std::array<std::vector<double>, 2> columns = columns_of(boundary);
  extras_.boundary_points = columns.front().size();
  file_.extend(layout_of(contents_, extras_));
  for (std::size_t i = 0; i < columns.size(); ++i) {
    file_.write(boundary_name(contents_.grid.axes[i]), 0, columns[i]);
  }
}

void GridNetcdf::write_target(std::span<const PlaceKind> kinds) {
  extras_.has_target = true;
  file_.extend(layout_of(contents_, extras_));
  file_.write(target_name, 0, target_flags(kinds));
}

std::size_t netcdf_bytes(const GridContents& contents) {
  return contents.grid.size() * (1 + sizeof(double) * contents.quantities.size());
}

RowCount write_grid_netcdf(int descriptor, const std::string& shown_name,
                           const GridContents& contents, bool has_boundary, Progress& progress,
                           const Stopwatch& seconds) {
  constexpr std::size_t points_at_a_time = std::size_t{1} << 15U;  // 3 MB, which caches hold
  GridNetcdf file = GridNetcdf::create(descriptor, shown_name, contents);
  std::vector<double> growth_at_rest;
  if (has_boundary) growth_at_rest.reserve(contents.grid.size());
  const RowCount count = evaluate_in_pieces(
      contents.grid, contents.quantities, 0, points_at_a_time,
      [&](const GridPiece& piece) {
        file.write(piece);
        if (has_boundary) add_all(growth_at_rest, piece.table[Quantity::growth_at_rest]);
      },
      progress, seconds);
  if (has_boundary && !count.stopped) {
    ProgressPart at_end(progress, 1.0, 1.0);
    file.write_boundary(hunting_boundary(contents.grid, growth_at_rest, at_end));
  }
  return count;
}

}  // namespace gearlash
