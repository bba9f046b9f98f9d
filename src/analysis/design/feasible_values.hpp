// The values of one parameter for which a drive meets its target, all other parameters fixed.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "analysis/design/changeable_drive.hpp"
#include "gearlash/design.hpp"
#include "gearlash/progress.hpp"

namespace gearlash {

/// Certified search misses no feasible value. It divides the range into boxes until the limit
/// cycles of each box are proved to keep the target all, or none (bound_cycles()), or the box is
/// too narrow to matter (1e-10, wider where limits are nearly touched). Between two boxes that
/// differ it locates the end of the interval with performance_of(), so that each end returned meets
/// the target.
///
/// A scan, used with bounces, tries 65 values. It halves an interval between two of them, six times
/// at most, while the distance to a limit changes there by more than that distance, or while the
/// cycle at only one of its ends is known. Where a cycle is unknown it also halves every interval
/// that hunts, twice. Growth at rest is cheap and is computed at 1,025 values. A scan can miss what
/// is narrower than the first of these steps, and it knows only the cycles that
/// analyse_limit_cycles() finds. Backlash is not scanned: amplitudes are proportional to it, and
/// nothing else depends on it.
///
/// Precondition: faults(target) is empty. Throws InvalidInput for a number that the drive does not
/// have.
FeasibleValues feasible_values(const ChangeableDrive& drive, std::string_view parameter,
                               const Target& target, Progress& progress = no_progress());

/// Whether the closed form answers for this target and these parameters: names, or axes as they are
/// typed. A name that is no parameter of the drive counts as one of the closed form, which knows
/// more (ChangeableDrive), and lists what it knows.
bool is_closed_form_task(const Drive& drive, const Target& target,
                         const std::vector<std::string>& parameters);

}  // namespace gearlash
