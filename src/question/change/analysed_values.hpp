// The drives along a line that meet a target, by searches on a grid and by following between.
#pragma once

#include <vector>

#include "gearlash/design.hpp"
#include "question/family/analysed_line.hpp"
#include "question/map/cycle_following.hpp"

namespace gearlash {

/// Fills in the intervals of values that meet the target. `found` has its range, and its grid
/// rises. The drive is analysed afresh at each value of the grid and at the ends of intervals.
/// Between two values, of which one meets the target, following closes in on the last one that
/// does. If that misses the target when it is analysed afresh, the search between is repeated
/// without following; if values just inside do, the interval ends before them. A value whose drive
/// is unsound does not meet the target. Returns the fresh analysis at `found.closest`, or nullptr.
/// Precondition: a sound drive and target.
AnalysedLine::Known searched_values(const DriveAlong& drive, const Target& target,
                                    const Wanted& wanted, FeasibleValues& found,
                                    Progress& progress);

/// The same for the choices of a word, each by itself.
AnalysedLine::Known searched_words(const DriveAlong& drive, const Target& target,
                                   const Wanted& wanted, FeasibleValues& found, Progress& progress);

}  // namespace gearlash
