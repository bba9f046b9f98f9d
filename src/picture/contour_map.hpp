// Contour maps with the hunting-free boundary and hatching, drawn by gnuplot.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "picture/line_chart.hpp"
#include "question/map/contours.hpp"

namespace gearlash {

/// A part of the map in one colour.
struct ColouredRegion {
  std::string meaning;  ///< for the legend
  std::string colour;   ///< "#rrggbb"
  std::vector<MapCurve> outlines;
};

/// Curves are in the values of the axes. Both axes have their ends.
struct ContourMap {
  std::string title = {};
  std::string subtitle = {};
  ChartAxis x = {};
  ChartAxis y = {};
  std::vector<ColouredRegion> regions = {};   ///< below all else; holes are covered by others
  std::vector<Contour> contours = {};         ///< by rising level, from light to dark, numbered
  std::vector<Contour> other_contours = {};   ///< of another quantity: dotted, numbered
  std::vector<MapCurve> boundary = {};        ///< bold
  std::vector<MapCurve> hatching = {};        ///< thin
  std::vector<MapCurve> inner_boundary = {};  ///< dashed
  std::vector<MapCurve> inner_hatching = {};  ///< between the lines of `hatching`
  std::optional<MapPoint> mark = std::nullopt;
  std::string contour_meaning = {};  ///< for the legend, as are the next five
  std::string other_meaning = {};
  std::string boundary_meaning = {};
  std::string hatching_meaning = {};
  std::string inner_meaning = {};
  std::string mark_meaning = {};
};

/// Returns the bytes of the picture; the same map gives the same SVG. Curves are thinned by less
/// than is visible, so that the finest grid gives a small file. Throws OutputError if gnuplot is
/// missing or fails.
std::string draw_contour_map(const ContourMap& map, PictureFormat format);

}  // namespace gearlash
