// Over which values of a parameter a target on the ceiling is proved.
#pragma once

#include "gearlash/design.hpp"

namespace gearlash {

/// Whether all that a target asks is that ceilings stay at or below limits.
bool is_of_ceilings(const Target& target);

/// Halves the interval until the ceilings of all drives of a part are proved to keep the limits,
/// the part is 1e-9 of the interval wide, or `most_boxes` were bounded. Preconditions:
/// is_of_ceilings(), a number of the drive, sound drives at both ends.
IntervalProof prove_target(const Drive& drive, std::string_view path, const Bounds& interval,
                           const Target& target, std::size_t most_boxes = 8000,
                           Progress& progress = no_progress());

}  // namespace gearlash
