// What charts and maps of a grid call its inputs and quantities.
#pragma once

#include <string>

#include "analysis/grid/servo_grid.hpp"
#include "closed_form/lanes/cycle_table.hpp"
#include "picture/line_chart.hpp"

namespace gearlash {

/// "damping 0.1, backlash 0.3": the inputs that are on no axis.
std::string fixed_inputs(const ServoGrid& grid, const char* separator);

/// "inertia ratio" for inertia_ratio.
std::string in_words(const char* name);

/// "Size of limit cycle (half peak-to-peak of the load)".
std::string title_of(CycleQuantity quantity);

/// " (rad)", nothing for a bare number. With the backlash 1 and on no axis angles are told in
/// backlashes.
std::string unit_in_brackets(CycleQuantity quantity, const ServoGrid& grid);

/// "size (rad)".
std::string label_of(CycleQuantity quantity, const ServoGrid& grid);

/// How sure the verdicts on the grid's servos are: "computed", "enclosed", or both with "searched"
/// for servos that bounce.
std::string certainty_of(const ServoGrid& grid);

/// The axis as it is drawn.
ChartAxis chart_axis(const Axis& axis);

}  // namespace gearlash
