// The lowest and the highest of numbers that come one after another.
#pragma once

#include <algorithm>

#include "base/special_numbers.hpp"
#include "gearlash/bounds.hpp"

namespace gearlash {

/// Makes bounds contain others.
inline void widen(Bounds& bounds, const Bounds& by) {
  bounds = {std::min(bounds.low, by.low), std::max(bounds.high, by.high)};
}

/// Of no number yet: from infinity to −infinity.
struct Extent : Bounds {
  Extent() : Bounds{infinity, -infinity} {}

  void include(double value) { widen(*this, {value, value}); }
  void include(const Bounds& values) { widen(*this, values); }
  double width() const { return high > low ? high - low : 0.0; }
  double middle() const { return 0.5 * (low + high); }
};

}  // namespace gearlash
