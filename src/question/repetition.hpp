// Whether motion that no cycle was closed on repeats all the same.
#pragma once

#include "gearlash/answer.hpp"

namespace gearlash {

/// Whether the swings of a motion repeat: to 0.1 %, after some of them, or, behind an encoder,
/// within a step of it at a steady pace. A sampled drive whose encoder reads the same steps again
/// and again has no derivative by which Newton's method could close a cycle.
[[nodiscard]] bool repeats(const IrregularMotion& motion);

}  // namespace gearlash
