// Axes as they are typed: "damping=0.1:0.6:11", "inertia-ratio=1/9:9:200:log", "damping=0.1,0.2".
#pragma once

#include <string_view>

#include "analysis/grid/axis.hpp"

namespace gearlash {

/// name=from:to:count, name=from:to:count:log, or name=a,b,c; the name is an input of the servo,
/// numbers may be fractions, and those of the backlash may have their unit ("1 arcmin"). Throws
/// InvalidInput, naming `field`, for anything else, with all that is wrong.
Axis read_axis(std::string_view field, std::string_view text);

}  // namespace gearlash
