// The answers of a grid as CSV and JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "analysis/grid/grid_points.hpp"
#include "analysis/grid/region_boundary.hpp"
#include "output/output_file.hpp"
#include "output/report_units.hpp"

namespace gearlash {

/// A grid worked out, a row a point.
struct GridTable {
  Grid grid{};
  Table table{};
  Provenance provenance{};
  std::optional<std::vector<MapCurve>> hunting_boundary{};      ///< of a map
  std::optional<std::vector<MapCurve>> dissipative_boundary{};  ///< likewise
};

/// How sure the verdicts on the grid's drives are: "computed", "enclosed", "searched", or two of
/// them with what each is said of.
std::string certainty_of(const Grid& grid);

/// drive_json() without what stands on the axes.
nlohmann::ordered_json fixed_parameters(const Grid& grid);

/// A line a point: the values of the axes, the verdict and every quantity, in SI; empty where not
/// known.
void write_grid_csv(const GridTable& table, const TextSink& sink);

/// As docs/schemas has it: axes, and each quantity as an array with the last axis fastest; null
/// where not known. A map's boundary as a list of curves, each a list of points [x, y]. `verb`:
/// "chart" or "map".
void write_grid_json(const GridTable& table, const std::string& verb, const TextSink& sink);

}  // namespace gearlash
