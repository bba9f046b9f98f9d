// Over which values of a parameter a target on the ceiling is proved.
#pragma once

#include "gearlash/design.hpp"

namespace gearlash {

/// Whether the limit is that a ceiling stays at or below a value.
bool is_provable(const QuantityLimit& limit);

/// Halves the interval until the ceilings of all drives of a part are proved to keep the limits,
/// the part is 1e-9 of the interval wide, or `most_boxes` were bounded. Preconditions:
/// a target on limits that are is_provable() alone, a number of the drive, sound drives at both
/// ends.
IntervalProof prove_target(const Drive& drive, std::string_view path, const Bounds& interval,
                           const Target& target, std::size_t most_boxes = 8000,
                           Progress& progress = no_progress());

}  // namespace gearlash
