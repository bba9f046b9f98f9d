// The curves that bound a region in the plane of two axes.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "gearlash/bounds.hpp"
#include "gearlash/progress.hpp"
#include "question/axis.hpp"

namespace gearlash {

/// The side of the boundary on which a place lies.
enum class Side : unsigned char { inside, outside, unknown };

/// How closely the curves follow the boundary. Lengths are shares of the axes.
struct CurveAccuracy {
  int halvings = 60;             ///< bisections along the line searched for the boundary
  double straightness = 2e-4;    ///< about the largest distance of the boundary from its chord
  double shortest_chord = 2e-3;  ///< shorter chords are not divided
  /// Points lie between the last places inside and outside, so that two regions side by side have
  /// the same border, found at the same places. Else they lie inside.
  bool is_midway = false;
};

/// Accurate enough for a picture: 2⁻²⁴ of the plane.
inline constexpr CurveAccuracy picture_accuracy{
    .halvings = 24, .straightness = 3e-4, .shortest_chord = 4e-3};

/// The boundary of the region of inside places, with the region on its left (x to the right, y
/// upwards).
///
/// `corners` holds the sides of the grid's points, x fastest. Where the ends of a grid edge differ,
/// the boundary crosses the edge, at a place found by bisection. The crossings of a cell are
/// joined; if opposite corners agree and neighbors differ, the cell's middle decides how. A chord
/// is divided, at a place found by bisection across it, until it is straight enough. So a coarse
/// grid gives a smooth curve whose every point is on the boundary, on the inside; features smaller
/// than a cell are missed. A curve ends at the edge of the plane or next to unknown places. The
/// result is the same for any number of threads; `side_at` is called from several at once. Progress
/// hears of the work that it goes on, and where it stops it all further places are unknown.
std::vector<MapCurve> boundary_of_region(const Axis& x, const Axis& y,
                                         std::span<const Side> corners,
                                         const std::function<Side(const MapPoint&)>& side_at,
                                         const CurveAccuracy& accuracy = {},
                                         Progress& progress = no_progress());

}  // namespace gearlash
