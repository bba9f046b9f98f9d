// The answers of a grid as a family of curves.
#pragma once

#include "output/grid_table.hpp"
#include "picture/line_chart.hpp"

namespace gearlash {

/// The quantity over the last axis, a curve for each value of the first, or one curve where there
/// is one axis. With plastic contact the curves of what vanishes with the cycle are drawn on to
/// where hunting ends. A drive without neighbours is a mark, as is each one on an axis of words.
/// Precondition: one axis or two.
LineChart chart_of(const GridTable& table, Quantity quantity);

}  // namespace gearlash
