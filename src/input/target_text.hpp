// Reading typed targets: "amplitude <= 1 arcmin", "no-hunting", "amplitude <= 1 deg and frequency
// >= 5 Hz".
#pragma once

#include <string_view>

#include "gearlash/design.hpp"
#include "input/drive_file.hpp"

namespace gearlash {

/// The names of all quantities, or those of a kind.
std::vector<std::string> names_of_quantities(std::optional<QuantityKind> kind = {});

/// Whether frequencies are defined: a normalised servo without natural_frequency has none.
enum class TimeScale { known, unknown };

/// Reads conditions joined by "and": no-hunting, no-hunting-if-disturbed, no-runaway, or a
/// quantity, one of <=, <, >= and >, and its limit. Quantities have their names and older names
/// (gearlash/quantity.hpp): amplitude (an angle; by `bare_numbers` also in radians without unit),
/// frequency ("5 Hz",
/// "30 rad/s"), period ("0.2 s"), growth-at-rest (a number) and so on. A drive that comes to rest
/// meets any condition on frequency or period. The sign < permits the limit itself, as <= does.
/// Throws InvalidInput, naming `field`, with every fault: unknown quantities, wrong units,
/// contradictions (faults(Target)).
Target read_target(std::string_view field, std::string_view text, TimeScale time_scale,
                   BareNumbers bare_numbers = BareNumbers::in_si);

}  // namespace gearlash
