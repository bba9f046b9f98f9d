// The answers of a grid as a family of curves.
#pragma once

#include "output/grid_table.hpp"
#include "picture/plot.hpp"

namespace gearlash {

/// The quantity over the last axis: one curve for each value of the first of two axes, one curve
/// for a single axis. With plastic contact, curves of quantities that vanish with the cycle
/// continue to the end of hunting. A point without neighbours is a mark, as is every point on an
/// axis of words. Precondition: one axis or two.
Plot chart_plot(const GridTable& table, Quantity quantity);

}  // namespace gearlash
