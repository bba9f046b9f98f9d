// What a tuning makes small and limits, with its derivatives by the tuned values.
#pragma once

#include <optional>
#include <span>

#include "gearlash/tune.hpp"
#include "numeric/box_minimum.hpp"

namespace gearlash {

/// Whether drives may have them: the aim is the bandwidth, the limits are of amplitudes, frequency,
/// period, growth at rest, bandwidth and phase margin, and rest is asked for of the closed form
/// alone.
bool may_have_slopes(const TuneTask& task);

/// Of one unit with tuned values: −ln of the bandwidth as the size; the phase margin that is asked
/// for and each limit of the target as a share of that limit, the growth at rest of a drive with a
/// closed form as the limit of hunting. Derivatives, by differences(), are along the axes, each
/// from 0 to 1. Empty where any of them has none: a loop that is not stable, irregular motion,
/// encoder steps, a computer's ticks, values of 0. Precondition: may_have_slopes().
std::optional<SlopedNumbers> slopes_of_unit(const Drive& unit, const TuneTask& task,
                                            Progress& progress);

}  // namespace gearlash
