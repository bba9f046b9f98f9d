// Cycles over one parameter: stable and unstable branches, and the borders between them.
#pragma once

#include "gearlash/grid.hpp"
#include "input/units.hpp"
#include "picture/plot.hpp"
#include "question/map/bifurcations.hpp"

namespace gearlash {

/// Whether a bifurcation picture can show the quantity: amplitude, motor_amplitude, period,
/// frequency, multiplier.
bool has_branches(Quantity quantity);

/// The quantity of every cycle over the grid's one axis: stable branches as thick lines, unstable
/// ones dashed, irregular motion as crosses, rest as a line at amplitude 0, and borders as marks
/// whose shape tells their word, or as a dotted upright line if they are of all motion. Borders of
/// one word at one place are drawn once. Angles are in the author's unit, other units those of the
/// registry. Amplitudes that differ by more than a factor of 30 have a logarithmic axis, with rest
/// at its foot. Preconditions: has_branches(quantity), one axis of numbers.
Plot bifurcation_plot(const BifurcationDiagram& diagram, const Grid& grid, Quantity quantity);

}  // namespace gearlash
