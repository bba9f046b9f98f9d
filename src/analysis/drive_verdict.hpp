// The answer that a search for attractors amounts to.
#pragma once

#include "general/attractors/attractors.hpp"

namespace gearlash::drive {

enum class DriveVerdict {
  comes_to_rest,           ///< from every start that was searched
  hunts,                   ///< in a cycle that repeats
  hunts_irregularly,       ///< in motion that was not seen to repeat
  hunts_if_disturbed,      ///< some starts lead to rest, others do not
  runs_away,               ///< no start stays bounded
  runs_away_if_disturbed,  ///< some do not
  undecided
};

/// By where the starts led.
DriveVerdict verdict_of(const AttractorSearch& search);

/// Of the cycles that are not unstable the largest; nullptr where there is none.
const FoundCycle* largest_stable(const AttractorSearch& search);

/// Whether a reference or a load torque swings for ever: what repeats is then no hunting by itself.
bool is_driven(const ReducedDrive& drive);

/// "hunts", "comes to rest", …
const char* name_of(DriveVerdict verdict);
/// Of a driven one that hunts "swings as it is driven".
const char* name_of(DriveVerdict verdict, const ReducedDrive& drive);

}  // namespace gearlash::drive
