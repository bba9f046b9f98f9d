// Infinity and not-a-number, named once for all rooms.
#pragma once

#include <limits>

namespace gearlash {

inline constexpr double infinity = std::numeric_limits<double>::infinity();
inline constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

}  // namespace gearlash
