// Targets as they are typed: "amplitude <= 1 arcmin", "no-hunting", "amplitude <= 1 deg and
// frequency >= 5 Hz".
#pragma once

#include <string_view>

#include "gearlash/design.hpp"

namespace gearlash {

/// Whether a frequency means anything: a normalised servo without natural_frequency has none.
enum class TimeScale { known, unknown };

/// Conditions joined by "and": no-hunting, or a quantity, <=, <, >= or >, and its limit.
/// Quantities by their names and older names (gearlash/quantity.hpp): amplitude (an angle; a bare
/// number is in radians), frequency ("5 Hz", "30 rad/s") and period ("0.2 s"), which a servo that
/// comes to rest keeps, and growth-at-rest (a number). A limit itself is permitted, with < as with
/// <=. Throws InvalidInput, naming `field`, with all that is wrong: unknown quantities, wrong
/// units, contradictions (faults(Target)).
Target read_target(std::string_view field, std::string_view text, TimeScale time_scale);

}  // namespace gearlash
