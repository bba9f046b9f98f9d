// Horizontal bars with their names, the first one on top, drawn by gnuplot.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "picture/line_chart.hpp"

namespace gearlash {

struct Bar {
  std::string name = {};
  double value = 0.0;                         ///< from 0, to either side
  std::optional<double> part = std::nullopt;  ///< of it, drawn dark
};

struct BarChart {
  std::string title = {};
  std::string subtitle = {};
  std::string label = {};  ///< of the axis of values
  std::vector<Bar> bars = {};
  std::string value_meaning = {};  ///< told in the legend where there are parts
  std::string part_meaning = {};
};

/// Bytes of the picture; the same chart gives the same SVG. Throws OutputError where gnuplot is
/// missing or fails. Precondition: a bar or more, finite values.
std::string draw_bar_chart(const BarChart& chart, PictureFormat format);

}  // namespace gearlash
