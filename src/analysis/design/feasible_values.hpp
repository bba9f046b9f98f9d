// The values of one parameter with which a drive meets its target, all others as they are.
#pragma once

#include <string_view>

#include "analysis/design/changeable_drive.hpp"
#include "gearlash/design.hpp"

namespace gearlash {

/// A feasible value is never skipped by certified search: the range is cut into boxes until the
/// limit cycles of each are proved to keep the target all, or none (bound_cycles()), or it is too
/// narrow to matter (1e-10, more where limits are nearly touched); between two that differ the end
/// of the interval is closed in on with performance_of(), so that each end put back meets the
/// target.
///
/// A scan, with bounces, tries 65 values, halves (six times at most) what lies between two of them
/// for as long as the distance to a limit changes there by more than it is, or the cycle of one is
/// known and that of the other not (twice everywhere that it hunts, where one is not), and follows
/// growth at rest, which is soon worked out, at 1,025 values. It can miss what is
/// narrower than the first of these steps; and it knows those cycles that analyse_limit_cycles()
/// finds. Backlash is not scanned: sizes are in proportion to it, and nothing else depends on it.
///
/// Precondition: faults(target) is empty. Throws InvalidInput for a number that the drive has
/// not.
FeasibleValues feasible_values(const ChangeableDrive& drive, std::string_view parameter,
                               const Target& target);

}  // namespace gearlash
