// The answers of a grid as a map.
#pragma once

#include <optional>

#include "output/grid_table.hpp"
#include "picture/plot.hpp"

namespace gearlash {

/// In the table's unit of angles: its regions in colours, their borders, and contours of the
/// quantity. If an axis has words, or drives are searched at few points and without a target, each
/// point is a cell instead, with its number, or a dot at rest; a frame if it meets the target.
/// Curves are thinned by less than is visible, so that the finest grid gives a small file.
/// Precondition: two axes, y and x, each with at least two values; a table that is no table of
/// cells has its boundaries.
Plot map_plot(const GridTable& table, Quantity quantity);

/// The quantity whose contours a map of searched drives shows too: the proved bound of every
/// motion. Empty for a quantity without one.
std::optional<Quantity> ceiling_over(Quantity quantity);

}  // namespace gearlash
