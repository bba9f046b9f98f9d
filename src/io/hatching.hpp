// Hatching over the servos of a map that have no limit cycle.
#pragma once

#include <vector>

#include "gearlash/io/grid_table.hpp"
#include "paper.hpp"

namespace gearlash {

/// Lines at 45° on paper, each of two points, cut off where they meet the boundary: over places
/// whose growth at rest is at most 1, but not in cells of the grid of which nothing is known, whose
/// points all lie on the other side, or of which one hunts none the less (where faces bounce, rest
/// and a limit cycle can both be stable). Precondition: `table` has its hunting boundary, two axes.
std::vector<MapCurve> hatching(const GridTable& table, const Paper& paper);

}  // namespace gearlash
