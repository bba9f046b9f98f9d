// Reading values with production tolerances from TOML: "0.61 oz in2 ± 10 %", { min, max }, lots.
#pragma once

#include <toml++/toml.h>

#include <functional>
#include <optional>
#include <string>

#include "gearlash/tolerance.hpp"
#include "gearlash/units.hpp"

namespace gearlash {

struct TolerancedValue {
  Measured nominal;
  std::optional<Distribution> distribution;  ///< in SI; nothing for an exact value
};

/// Reads one exact value, named `field` in errors. Throws InvalidInput.
using ExactReader = std::function<Measured(const std::string& field, const toml::node& value)>;

/// Reads a value that `read_exact` reads, or
///   "A ± B", "A ± 10 %"                 uniform about A (also "+-", "+/-")
///   { value = A, tolerance = B }        the same; A or B with units, or B in per cent
///   { value = A, normal = B }           normal, standard deviation B; min and max may be added
///   { min = A, max = B }                uniform between; nominal: value if given, or the middle
///   { lots = [A, { value = B, weight = 3 }] }   nominal: the first of the heaviest
/// Throws InvalidInput with one fault.
TolerancedValue read_toleranced(const std::string& field, const toml::node& value,
                                const ExactReader& read_exact);

}  // namespace gearlash
