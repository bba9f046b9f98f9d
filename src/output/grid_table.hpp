// The answers of a grid as CSV and JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "output/output_file.hpp"
#include "output/report_units.hpp"
#include "question/map/map_regions.hpp"

namespace gearlash {

/// A computed grid, with one row for each point.
struct GridTable {
  Grid grid{};
  Table table{};
  Provenance provenance{};
  AngleUnit angle{};                                            ///< of pictures
  std::optional<Target> target{};                               ///< of a map that asks for one
  std::string target_text{};                                    ///< as typed
  std::optional<MapPoint> present{};                            ///< the drive as it is, for a mark
  std::vector<PlaceKind> kinds{};                               ///< of the points, by the target
  std::optional<std::vector<MapCurve>> hunting_boundary{};      ///< for a map only
  std::optional<std::vector<MapCurve>> dissipative_boundary{};  ///< for a map only
  /// For a map with a target, or of searched drives: there the regions of kinds of motion.
  std::optional<std::vector<MapRegion>> regions{};
};

/// Evaluates the grid into the columns of `table`, and judges its points by the target.
RowCount work_out(GridTable& table, Progress& progress = no_progress());

/// Adds a map's borders: where hunting ends in closed form, and its regions. `table` is complete,
/// its axes are y, x, and it has growth at rest.
void add_borders(GridTable& table, Progress& progress = no_progress());

/// The certainty of the grid's verdicts: "computed", "enclosed", "searched", or two of them with
/// the drives that each applies to.
std::string certainty_of(const Grid& grid);

/// drive_json() without the parameters of the axes.
nlohmann::ordered_json fixed_parameters(const Grid& grid);

/// One line for each point: the values of the axes, the verdict, whether a target is met, and every
/// quantity, in SI; empty if not known.
void write_grid_csv(const GridTable& table, const TextSink& sink);

/// The JSON of docs/schemas: the axes, and each quantity as an array with the last axis fastest,
/// null if not known. A map's boundary is a list of curves, each a list of points [x, y]. `verb`:
/// "chart" or "map".
void write_grid_json(const GridTable& table, const std::string& verb, const TextSink& sink);

}  // namespace gearlash
