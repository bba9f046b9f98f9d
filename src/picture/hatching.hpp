// Hatching of a part of a map.
#pragma once

#include <functional>
#include <vector>

#include "output/grid_table.hpp"
#include "picture/paper.hpp"

namespace gearlash {

/// The area to hatch. Lines are cut where they meet the boundary.
struct Hatched {
  /// Whether to hatch a stretch of a line, judged by its middle: a stretch does not cross the
  /// boundary.
  std::function<bool(const MapPoint& middle)> stretch;
  /// Whether to leave out a short part of such a stretch, judged by its middle; may be empty.
  std::function<bool(const MapPoint& middle)> left_out = {};
};

/// Which lines are drawn.
enum class HatchLines {
  first,  ///< evenly spaced
  second  ///< half-way between the first
};

/// Hatching lines at 45° on paper, each of two points.
std::vector<MapCurve> hatching(const std::vector<MapCurve>& boundary, const Paper& paper,
                               const Hatched& hatched, HatchLines lines = HatchLines::first);

/// Hatches the parts of a map where growth at rest is at most 1. A cell of the grid is left out if
/// nothing is known of a corner, if all corners lie on the other side, or if a corner at rest also
/// has a limit cycle (with bouncing faces both can be stable). Precondition: `table` has its
/// hunting boundary and two axes.
std::vector<MapCurve> hatching(const GridTable& table, const Paper& paper);

}  // namespace gearlash
