// The limit cycles of a grid of servos as a map.
#pragma once

#include "output/grid_table.hpp"
#include "picture/contour_map.hpp"

namespace gearlash {

/// Contours of the quantity, the hunting-free boundary, and hatching where there is no limit cycle.
/// Precondition: two axes, y and x, each with two finite values or more; the table has its
/// boundary.
ContourMap map_of(const GridTable& table, CycleQuantity quantity);

}  // namespace gearlash
