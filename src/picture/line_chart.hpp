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
  std::optional<double> low = std::nullopt;  ///< as the data have it where not given
  std::optional<double> high = std::nullopt;
  std::vector<std::pair<std::string, double>> tics = {};  ///< gnuplot's own where empty
};

/// One curve: a line, marks on it that belong to it, and open circles where it ends.
struct ChartCurve {
  std::string name = {};              ///< in the legend
  std::vector<ChartPoint> line = {};  ///< what is not finite parts it
  std::vector<ChartPoint> marks = {};
  std::vector<ChartPoint> ends = {};
};

struct LineChart {
  std::string title = {};
  std::string subtitle = {};
  ChartAxis x = {};
  ChartAxis y = {};
  std::vector<ChartCurve> curves = {};
  std::string line_meaning = {};  ///< what lines, marks and open circles are, told in the legend
  std::string mark_meaning = {};
  std::string end_meaning = {};
  std::string empty_meaning = {};  ///< told amid the axes where there is nothing to draw
  double mark_size = 0.8;          ///< in gnuplot's units
};

/// Bytes of the picture; the same chart gives the same SVG. Curves differ in colour, dash and mark.
/// Throws OutputError where gnuplot is missing or fails.
std::string draw_line_chart(const LineChart& chart, PictureFormat format);

}  // namespace gearlash
