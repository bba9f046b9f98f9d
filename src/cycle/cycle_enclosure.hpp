// What interval arithmetic proves of the cycle of one servo, and of the motions that end in it.
#pragma once

#include "gearlash/cycle/limit_cycle.hpp"

namespace gearlash {

/// As bound_cycles() takes them. The box is that of one servo: as narrow as its data allow.
CycleEnclosure enclose_cycle(const ServoBox& box, double guessed_flight_time);

}  // namespace gearlash
