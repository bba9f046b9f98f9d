// The lowest and the highest of numbers that come one after another.
#pragma once

#include <algorithm>

#include "base/special_numbers.hpp"
#include "gearlash/bounds.hpp"

namespace gearlash {

/// Of no number yet: from infinity to −infinity.
struct Extent : Bounds {
  Extent() : Bounds{infinity, -infinity} {}

  void include(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  double width() const { return high > low ? high - low : 0.0; }
  double middle() const { return 0.5 * (low + high); }
};

}  // namespace gearlash
