// From what step on a drive hunts or runs away.
#pragma once

#include <functional>
#include <vector>

#include "general/attractors/attractors.hpp"
#include "general/attractors/search_setting.hpp"

namespace gearlash::drive {

/// Among the starts at rest beside the reference: for each direction, and for hunting and running
/// away each, the smallest step of which either face leads there, if a smaller one does not. Steps
/// between it and the next smaller one are bisected with `end_of`, as long as it decides.
/// None for a reference or a load torque that moves.
std::vector<Threshold> thresholds_of(const SearchSetting& setting,
                                     const std::vector<Outcome>& outcomes, int bisections,
                                     const std::function<MotionEnd(const ShaftStates&)>& end_of);

}  // namespace gearlash::drive
