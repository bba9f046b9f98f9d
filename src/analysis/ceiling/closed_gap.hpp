// The motion of the loop with its gap closed.
#pragma once

#include "model/drive.hpp"

namespace gearlash {

/// Whether it is along the reference, at rest or on a ramp, where no load torque moves it away: the
/// reference is 0, or the controller knows reference and position by their difference alone.
/// Precondition: a linear controller.
bool follows_reference(const drive::ReducedDrive& drive);

}  // namespace gearlash
