// Infinity and not-a-number, named once for all rooms, and numbers that may be absent.
#pragma once

#include <cmath>
#include <limits>
#include <optional>

namespace gearlash {

inline constexpr double infinity = std::numeric_limits<double>::infinity();
inline constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// A number that may not have been computed: empty for NaN.
inline std::optional<double> known(double value) {
  return std::isnan(value) ? std::nullopt : std::optional(value);
}

}  // namespace gearlash
