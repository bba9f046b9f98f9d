// A range of numbers.
#pragma once

namespace gearlash {

/// All numbers from low to high.
struct Bounds {
  double low = 0.0;
  double high = 0.0;

  bool contains(double value) const { return low <= value && value <= high; }
  bool operator==(const Bounds&) const = default;
};

}  // namespace gearlash
