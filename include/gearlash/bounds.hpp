// Two limits, and all numbers between them.
#pragma once

namespace gearlash {

/// All numbers from low to high, both included.
struct Bounds {
  double low = 0.0;   ///< the least of them
  double high = 0.0;  ///< the greatest

  [[nodiscard]] bool contains(double value) const { return low <= value && value <= high; }
  bool operator==(const Bounds&) const = default;
};

}  // namespace gearlash
