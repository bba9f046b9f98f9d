// Hatching over a part of a map.
#pragma once

#include <functional>
#include <vector>

#include "output/grid_table.hpp"
#include "picture/paper.hpp"

namespace gearlash {

/// What is to be hatched, between lines that are cut where they meet the boundary.
struct Hatched {
  /// Whether a stretch is, told by its middle: it does not cross the boundary.
  std::function<bool(const MapPoint& middle)> stretch;
  /// Whether a short part of such a stretch is to be left out, told likewise; may be empty.
  std::function<bool(const MapPoint& middle)> left_out = {};
};

/// Which lines are drawn.
enum class HatchLines {
  first,  ///< evenly spaced
  second  ///< half-way between those
};

/// Lines at 45° on paper, each of two points.
std::vector<MapCurve> hatching(const std::vector<MapCurve>& boundary, const Paper& paper,
                               const Hatched& hatched, HatchLines lines = HatchLines::first);

/// Over places of a map whose growth at rest is at most 1, but not in cells of the grid of which
/// nothing is known, whose points all lie on the other side, or of which one hunts none the less
/// (where faces bounce, rest and a limit cycle can both be stable). Precondition: `table` has its
/// hunting boundary, two axes.
std::vector<MapCurve> hatching(const GridTable& table, const Paper& paper);

}  // namespace gearlash
