// A map's curves in lengths on paper, so that straightness, distance and slope are those seen.
#pragma once

#include <vector>

#include "picture/line_chart.hpp"
#include "question/map/region_boundary.hpp"

namespace gearlash {

/// Distances to the right of and above the corner of the axes, in ninths of the picture's width.
struct PaperPoint {
  double right = 0.0;
  double up = 0.0;
};
using PaperLine = std::vector<PaperPoint>;

double distance(const PaperPoint& one, const PaperPoint& other);

/// The distance to the nearest point between `from` and `to`.
double distance_from_chord(const PaperPoint& point, const PaperPoint& from, const PaperPoint& to);

double length_of(const PaperLine& line);

/// Of a closed line, positive if it runs counterclockwise.
double area_within(const PaperLine& line);

/// The rectangle between the axes of a map.
class Paper {
 public:
  static constexpr double left_margin = 0.11;  ///< shares of the picture
  static constexpr double right_margin = 0.965;
  static constexpr double bottom_margin = 0.185;
  static constexpr double top_margin = 0.88;
  static constexpr double width = 9.0 * (right_margin - left_margin);
  static constexpr double height = 7.0 * (top_margin - bottom_margin);

  /// Precondition: both axes have their ends.
  Paper(const ChartAxis& x, const ChartAxis& y);

  PaperPoint point_on_paper(const MapPoint& point) const;
  MapPoint point_on_map(const PaperPoint& point) const;
  PaperLine line_on_paper(const MapCurve& curve) const;

 private:
  Axis x_;
  Axis y_;
};

/// The line reduced to few of its points, within `tolerance` (Douglas and Peucker, 1973).
PaperLine thinned(const PaperLine& line, double tolerance);

}  // namespace gearlash
