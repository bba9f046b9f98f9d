// The answers of a grid as a family of curves.
#pragma once

#include "gearlash/plot.hpp"
#include "output/grid_table.hpp"

namespace gearlash {

/// The quantity over the last axis: one curve for each value of the first of two axes, one curve
/// for a single axis. With plastic contact, curves of quantities that vanish with the cycle
/// continue to the end of hunting. A point without neighbours is a mark, as is every point on an
/// axis of words. Precondition: one axis or two.
Plot chart_plot(const GridTable& table, Quantity quantity);

/// A picture has no room for infinity, for many curves, or for the digits of a very narrow axis.
/// `fields` name the axes; default: their paths. `has_curves`: the first of two axes is theirs.
std::vector<Fault> faults_of_picture(const Grid& grid, const std::vector<std::string>& fields,
                                     bool has_curves);

}  // namespace gearlash
