// Cycles over one parameter: stable and unstable branches, and the borders between them.
#pragma once

#include "gearlash/grid.hpp"
#include "gearlash/plot.hpp"
#include "gearlash/units.hpp"
#include "question/map/bifurcations.hpp"

namespace gearlash {

/// Of a grid that has no one axis of 2 to 1000 numbers, and of a quantity that cycles lack: they
/// have amplitude, motor_amplitude, period, frequency and multiplier. `fields` name the axes and
/// the quantity.
std::vector<Fault> faults_of_branches(const Grid& grid, Quantity quantity,
                                      const std::vector<std::string>& fields = {"axes", "axes",
                                                                                "quantity"});
/// The quantity of every cycle over the grid's one axis: stable branches as thick lines, unstable
/// ones dashed, irregular motion as crosses, rest as a line at amplitude 0, and borders as marks
/// whose shape tells their word, or as a dotted upright line if they are of all motion. Angles are
/// in the author's unit, other units those of the registry. Amplitudes that differ by more than a
/// factor of 30 have a logarithmic axis, with rest at its foot. Precondition: no
/// faults_of_branches().
Plot bifurcation_plot(const BifurcationDiagram& diagram, const Grid& grid, Quantity quantity);

}  // namespace gearlash
