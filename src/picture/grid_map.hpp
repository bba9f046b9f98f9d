// The answers of a grid as a map.
#pragma once

#include <optional>

#include "gearlash/plot.hpp"
#include "output/grid_table.hpp"

namespace gearlash {

/// In the table's unit of angles: its regions in colours, their borders, and contours of the
/// quantity. If an axis has words, or drives are searched at few points and without a target, each
/// point is a cell instead, with its number, or a dot at rest; a frame if it meets the target.
/// Curves are thinned by less than is visible, so that the finest grid gives a small file.
/// Precondition: two axes, y and x, each with at least two values; a table that is no table of
/// cells has its boundaries.
Plot map_plot(const GridTable& table, Quantity quantity);

/// What a table needs for pictures of the quantity. A map without a target of searched drives shows
/// the proved bound of every motion too.
std::vector<Quantity> quantities_drawn(const Grid& grid, Quantity quantity, bool has_ceiling);

/// Where the grid's drive lies on its map; empty where it lacks the value of an axis.
std::optional<MapPoint> place_on_map(const Grid& grid);

}  // namespace gearlash
