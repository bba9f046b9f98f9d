// The distance of any drive from the border of hunting, by one parameter and by several.
#pragma once

#include <optional>
#include <vector>

#include "gearlash/design.hpp"
#include "question/analyse.hpp"

namespace gearlash {

/// False at the very ends of a normal form's ranges, where rounding puts its drivetrain outside
/// them: margins() then throws.
bool has_margins(const Analysis& analysis);

/// The nearest ends of intervals, where `quiet` are the values without hunting.
ParameterMargin margin_of(const FeasibleValues& quiet);

/// The border of one parameter from values() for always_at_rest(). `hunts`: whether the
/// drive is not known to rest at present. A border that was searched, and beyond which the drive is
/// unsound or its motion unknown, is none of hunting. Throws InvalidInput.
ParameterMargin parameter_margin(const Drive& drive, const Axis& axis, bool hunts,
                                 Progress& progress = no_progress());

/// The combined change; the margins are those of `axes`. Empty if no parameter has a border at a
/// finite ratio, or if the search was stopped before it had one.
std::optional<CombinedMargin> combined_margin(const Drive& drive, const std::vector<Axis>& axes,
                                              const std::vector<ParameterMargin>& margins,
                                              bool hunts, Progress& progress = no_progress());

}  // namespace gearlash
