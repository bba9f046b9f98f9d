// The answers of a grid as a map.
#pragma once

#include <optional>
#include <string>

#include "output/grid_table.hpp"
#include "picture/contour_map.hpp"

namespace gearlash {

/// In the table's unit of angles: contours of the quantity, the hunting-free boundary, and hatching
/// where there is no limit cycle; of a table with regions these are coloured instead. Precondition:
/// two axes, y and x, each with at least two finite values; the table has its boundary.
ContourMap map_of(const GridTable& table, Quantity quantity);

/// The picture: map_of(). If an axis has words, or drives are searched at few points and without a
/// target, each point is a cell instead, with its number, or a dot at rest; a frame if it meets the
/// target. Precondition: two axes, y and x, each with at least two values.
std::string draw_grid_map(const GridTable& table, Quantity quantity, PictureFormat format);

/// The quantity whose contours a map of searched drives shows too: the proved bound of every
/// motion. Empty for a quantity without one.
std::optional<Quantity> ceiling_over(Quantity quantity);

}  // namespace gearlash
