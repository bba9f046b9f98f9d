// The values of one parameter for which a drive meets its target, all other parameters fixed.
#pragma once

#include <string_view>

#include "gearlash/design.hpp"
#include "gearlash/progress.hpp"
#include "question/change/target.hpp"
#include "question/family/analysed_line.hpp"

namespace gearlash {

// What is bounded is certified, and what is not is searched within it, so that a condition more
// never loses a proof. In closed form with plastic contact the bounds are those of boxes
// (bounds_of()): the range is halved until each part is proved to keep these conditions, all of it
// or none, or is too narrow to matter (1e-10, wider where limits are nearly touched). Between two
// parts that differ the end of the interval is located, so that it meets the target.
//
// With bounces a scan tries 65 values. It halves an interval between two of them, six times at
// most, while the distance to a limit changes there by more than that distance, or while the cycle
// at only one of its ends is known. Where a cycle is unknown it also halves every interval that
// hunts, twice. Growth at rest is cheap and is computed at 1,025 values. A scan can miss what is
// narrower than the first of these steps, and it knows only the cycles that analyse_limit_cycles()
// finds. Backlash is not scanned: amplitudes are proportional to it, and nothing else depends on
// it.
//
// Any other drive is analysed at each value of the axis (analysed_values.hpp).
//
// Figures, which are computed without the motions that the drive ends in, are scanned within the
// intervals that the other conditions leave.

/// axis_to_search() of gearlash/design.hpp; faults name `field`. Precondition: a sound drive.
Axis axis_to_search(std::string_view field, const Drive& drive, std::string_view parameter);

/// values() of gearlash/design.hpp, and the fresh analysis of a search at the closest value;
/// nullptr where there is none.
FeasibleValues values(const Drive& drive, const Axis& axis, const Target& target,
                      Progress& progress, AnalysedLine::Known& at_closest);

}  // namespace gearlash
