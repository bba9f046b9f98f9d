// The curves that bound a region of the plane of two axes.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "analysis/grid/axis.hpp"

namespace gearlash {

/// Values of the two inputs on a map's axes.
struct MapPoint {
  double x = 0.0;
  double y = 0.0;

  bool operator==(const MapPoint&) const = default;
};

/// Joined by straight lines in the axes' own scales; a ring where the last point is the first.
using MapCurve = std::vector<MapPoint>;

/// On which side of its boundary a place is.
enum class Side : unsigned char { inside, outside, unknown };

/// How closely the curves follow the boundary. Lengths are shares of the axes.
struct CurveAccuracy {
  int halvings = 60;             ///< of the line on which the boundary is sought
  double straightness = 2e-4;    ///< about as far may the boundary leave its chord
  double shortest_chord = 2e-3;  ///< no chord that short is divided further
};

/// The boundary of the region whose places are inside, with the region on its left (x to the right,
/// y upwards).
///
/// `corners` tells the sides of the grid's points, x fastest. Where the ends of an edge of the grid
/// differ the boundary crosses it, at a place found by bisection; the crossings of a cell are
/// joined (two of each side in opposite corners: as the cell's middle says), and a chord is
/// divided, at a place found by bisection across it, until it is straight enough. So a coarse grid
/// gives a smooth curve whose every point is on the boundary, on the inside; what is smaller than a
/// cell is missed. A curve ends at the edge of the plane or next to what is unknown. The same for
/// any number of threads; `side_at` is called from several at once.
std::vector<MapCurve> boundary_of_region(const Axis& x, const Axis& y,
                                         std::span<const Side> corners,
                                         const std::function<Side(const MapPoint&)>& side_at,
                                         const CurveAccuracy& accuracy = {});

}  // namespace gearlash
