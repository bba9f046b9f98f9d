// A number of a drive with the error of its way here.
#pragma once

#include <cmath>

#include "base/interval.hpp"

namespace gearlash {

/// Numbers made from a drive's data, which rounding has changed by at most this many units in the
/// last place.
inline Interval datum(double value) {
  constexpr double units = 64.0;
  const double error = units * 0x1p-53 * std::abs(value);
  return {outward::below(value - error), outward::above(value + error)};
}

}  // namespace gearlash
