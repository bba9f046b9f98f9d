// Two limits with all numbers between them, and points and curves in a plane.
#pragma once

#include <vector>

namespace gearlash {

/// All numbers from low to high, both included.
struct Bounds {
  double low = 0.0;   ///< the least of them
  double high = 0.0;  ///< the greatest

  [[nodiscard]] bool contains(double value) const { return low <= value && value <= high; }
  bool operator==(const Bounds&) const = default;
};

/// A point in the plane of two axes.
struct MapPoint {
  double x = 0.0;  ///< on the axis to the right
  double y = 0.0;  ///< on the axis upwards

  bool operator==(const MapPoint&) const = default;
};

/// Points joined by straight lines in the axes' own scales; closed if the last point equals the
/// first.
using MapCurve = std::vector<MapPoint>;

}  // namespace gearlash
