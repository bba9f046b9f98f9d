// The ceiling of a drive's motion.
#pragma once

#include "gearlash/answer.hpp"
#include "model/enclosed_drive.hpp"

namespace gearlash {

/// Proved, with outward rounding, of every drive that is enclosed.
Ceiling ceiling_of(const EnclosedDrive& drive);

}  // namespace gearlash
