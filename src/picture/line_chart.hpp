// Charts of curves and points over a linear or logarithmic axis, drawn by gnuplot.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "picture/picture.hpp"

namespace gearlash {

struct ChartPoint {
  double x = 0.0;
  double y = 0.0;
};

struct ChartAxis {
  std::string label = {};
  bool logarithmic = false;
  std::optional<double> low = std::nullopt;  ///< nothing: the data's end
  std::optional<double> high = std::nullopt;
  std::vector<std::pair<std::string, double>> tics = {};  ///< empty: gnuplot's own
};

/// One curve: a line, marks that belong to it, and open circles at its ends.
struct ChartCurve {
  std::string name = {};              ///< for the legend
  std::vector<ChartPoint> line = {};  ///< interrupted at points that are not finite
  std::vector<ChartPoint> marks = {};
  std::vector<ChartPoint> ends = {};
};

struct LineChart {
  std::string title = {};
  std::string subtitle = {};
  ChartAxis x = {};
  ChartAxis y = {};
  std::vector<ChartCurve> curves = {};
  std::string line_meaning = {};  ///< for the legend, as are the next two
  std::string mark_meaning = {};
  std::string end_meaning = {};
  std::string empty_meaning = {};  ///< text between the axes if there is no curve
  double mark_size = 0.8;          ///< in gnuplot's units
};

/// Returns the bytes of the picture; the same chart gives the same SVG. Curves differ in colour,
/// dash and mark. Throws OutputError if gnuplot is missing or fails.
std::string draw_line_chart(const LineChart& chart, PictureFormat format);

}  // namespace gearlash
