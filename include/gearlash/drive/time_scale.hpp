// How fast a drive is.
#pragma once

#include "gearlash/drive/drive.hpp"

namespace gearlash::drive {

/// s: the period of the loop with both shafts as one, 2π/ω with ω where the loop gain is last 1;
/// of a drive whose controller asks for nothing that of a sampling period, or 1 s. A scale for
/// times, no more. Precondition: sound.
double slow_time(const Drive& drive);

}  // namespace gearlash::drive
