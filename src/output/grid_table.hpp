// The answers of a grid as CSV and JSON.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "gearlash/output.hpp"
#include "gearlash/units.hpp"
#include "output/json_writer.hpp"
#include "question/map/map_regions.hpp"

namespace gearlash {

/// A computed grid, with one row for each point.
struct GridTable {
  Grid grid{};
  Table table{};
  Provenance provenance{};
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

/// The regions of kinds of motion, or those where the target is met. Precondition: has_regions().
std::vector<MapRegion> regions_of(const GridTable& table, Progress& progress = no_progress());

/// The certainty of the grid's verdicts: "computed", "enclosed", "searched", or two of them with
/// the drives that each applies to.
std::string certainty_of(const Grid& grid);

/// parameter_values() without the parameters of the axes.
ByName<ParameterValue> fixed_parameters(const Grid& grid);

/// One line for each point: the values of the axes, the verdict, whether a target is met, and every
/// quantity, in SI; empty if not known. Names of columns have the unit: "amplitude_rad".
void write_grid_csv(const GridTable& table, const TextSink& sink);

struct GridAxis {
  std::string path{};                    ///< of its parameter
  std::string unit{};                    ///< SI; "1" of a bare number, empty of words
  bool is_logarithmic = false;           ///< how its values are spaced
  std::vector<ParameterValue> values{};  ///< every one, in order
};

/// "gearlash/grid/3": the answers of a chart or a map, in lists with a value for each point.
struct GridDocument {
  std::string certainty{};              ///< of the verdicts
  ByName<ParameterValue> drive{};       ///< the parameters that do not vary, by their paths
  std::vector<std::string> defaults{};  ///< the paths of those that have their default value
  std::vector<GridAxis> axes{};         ///< what varies, the last axis fastest
  std::string target_text{};            ///< of a map that asks for one; else empty
  std::span<const Verdict> verdicts{};  ///< of each point
  std::span<const PlaceKind> kinds{};   ///< whether it meets the target, of a map that asks
  ByName<std::span<const double>>
      columns{};  ///< each quantity that a drive of the grid has; NaN: not known
  std::optional<std::vector<MapCurve>> hunting_boundary{};  ///< of a map: where hunting ends
  std::optional<std::vector<MapCurve>>
      dissipative_boundary{};                       ///< of a map: beyond it none can hunt
  std::optional<std::vector<MapRegion>> regions{};  ///< of a map: of kinds of motion
  Provenance provenance{};                          ///< how it was made
};
/// The table must outlive it.
GridDocument document_of(const GridTable& table);

void write_grid_json(const GridTable& table, const TextSink& sink);

}  // namespace gearlash
