// How long a motion takes to rest.
#pragma once

#include <optional>

#include "general/attractors/motion_watch.hpp"

namespace gearlash::drive {

/// s from the end of a motion: until its steps are within `band`, by their law; 0 if they are.
///   Σ d qᵏ over k = 1 … n,  n = ⌈ln(band/size)/ln ratio⌉
/// Infinite where that is beyond the largest double.
double time_until_within(double band, const ShrinkingSteps& steps);

/// s: the last time at which the load was farther than `band`, rad, from its final position, rad
/// from the reference; 0 if it never was. From the turns of the watch. Between two of them the
/// motion is simulated again, and after the last on to that time. Empty if the motion does not get
/// there by itself within many times what was watched, or if it is stopped.
std::optional<double> last_time_outside(double band, double final, const Watch& watch,
                                        const SearchSetting& setting, std::size_t step_limit);

}  // namespace gearlash::drive
