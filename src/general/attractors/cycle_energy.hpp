// What feeds a motion, and what it loses.
#pragma once

#include "general/attractors/search_setting.hpp"

namespace gearlash::drive {

/// J, over a motion of setting.system that returns to its start: the springs of compliant faces and
/// the weight of the load give back what they take. Powers are integrated over each step of the
/// series, to rounding; impacts, of which bounces that settle are a sum, take the kinetic energy by
/// which the states before and after them differ.
EnergyBalance energy_of(const SearchSetting& setting, const hybrid::Trajectory& motion);

}  // namespace gearlash::drive
