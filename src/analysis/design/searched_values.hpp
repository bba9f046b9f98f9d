// The drives along a line that meet a target, by searches on a grid and by following between.
#pragma once

#include <vector>

#include "analysis/grid/cycle_following.hpp"
#include "gearlash/design.hpp"

namespace gearlash {

/// What feasible_values() of an axis finds, with the numbers of the line for values of a parameter.
/// `grid`: the numbers at which the drive is analysed afresh, rising. Precondition: the target has
/// no faults.
FeasibleValues feasible_along(const DriveAlong& drive, const std::vector<double>& grid,
                              const Target& target, Progress& progress);

}  // namespace gearlash
