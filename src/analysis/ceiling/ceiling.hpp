// The ceiling of a drive's motion.
#pragma once

#include "gearlash/answer.hpp"
#include "model/drive.hpp"

namespace gearlash {

/// Proved, with outward rounding, of every drive whose numbers agree with the given ones to 64
/// units in the last place. Precondition: a sound drive with settled signals.
Ceiling ceiling_of(const drive::ReducedDrive& drive);

}  // namespace gearlash
