// The answers of a grid as a map.
#pragma once

#include <string>

#include "output/grid_table.hpp"
#include "picture/contour_map.hpp"

namespace gearlash {

/// Contours of the quantity, the hunting-free boundary, and hatching where there is no limit cycle.
/// Precondition: two axes, y and x, each with two finite values or more; the table has its
/// boundary.
ContourMap map_of(const GridTable& table, Quantity quantity);

/// The picture: contours of what is known in closed form. Where drives are searched, or words stand
/// on an axis, each point is a cell with its number, as far as there is room for one; a dot stands
/// for rest. Precondition: two axes, y and x, of two values or more.
std::string draw_grid_map(const GridTable& table, Quantity quantity, PictureFormat format);

}  // namespace gearlash
