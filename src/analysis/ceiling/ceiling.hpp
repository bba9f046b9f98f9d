// The ceiling of a drive's motion.
#pragma once

#include "gearlash/answer.hpp"
#include "model/enclosed.hpp"

namespace gearlash {

/// Proved, with outward rounding, of every drive whose numbers are enclosed: of a single drive
/// those that agree to 64 units in the last place. Precondition: sound drives with settled signals,
/// of one form: see enclosed_drive().
Ceiling ceiling_of(const EnclosedDrive& drive);

}  // namespace gearlash
