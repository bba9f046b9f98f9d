#include "base/arithmetic.hpp"

#include <limits>

namespace gearlash {

std::string_view fault_of_arithmetic() {
  using Limits = std::numeric_limits<double>;
  // Volatile, so that they are computed here and now.
  volatile double one = 1.0;
  volatile double tenth_of_unit = 0.1 * Limits::epsilon();
  volatile double most_of_unit = 0.9 * Limits::epsilon();
  const double above = one + tenth_of_unit;
  const double below = -one - tenth_of_unit;
  const double next = one + most_of_unit;
  if (above != 1.0 || below != -1.0 || next != 1.0 + Limits::epsilon()) {
    return "this thread does not round to the nearest number";
  }
  // Twice half a unit vanishes, unless it is kept to more digits meanwhile.
  volatile double half_of_unit = 0.5 * Limits::epsilon();
  if ((one + half_of_unit) + half_of_unit != 1.0) {
    return "this thread computes with other digits than a double has";
  }
  volatile double least = Limits::min();
  volatile double subnormal = Limits::denorm_min();
  if (0.5 * least == 0.0 || subnormal + subnormal == 0.0 || subnormal == 0.0) {
    return "this thread takes numbers below 2.2e-308 for 0";
  }
  return {};
}

}  // namespace gearlash
