// Whether an answer agrees with itself.
#pragma once

#include <string>
#include <vector>

#include "gearlash/answer.hpp"

namespace gearlash {

/// What in an answer cannot be true together, a sentence for each; none of a sound answer. No
/// cycle, irregular motion or rest is wider than the proved ceiling, where that bounds all motion;
/// starts end in what the answer lists; those that come to rest do so in one of its pieces, where
/// these are computed, to the uncertainty of the place (RestPlace). Rounding is allowed for: 1e-6
/// of the ceiling. Precondition: no sine drives the drive, as the ceiling leaves out the motion
/// that it forces.
std::vector<std::string> contradictions(const Answer& answer);

/// Makes an answer that contradicts itself undecided, with a note for each contradiction. It is a
/// fault of Gearlash, whichever side is wrong.
void withdraw_if_contradictory(Answer& answer);

}  // namespace gearlash
