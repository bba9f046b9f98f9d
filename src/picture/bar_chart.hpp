// Horizontal bars with names, the first on top, drawn by gnuplot.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "picture/line_chart.hpp"

namespace gearlash {

struct Bar {
  std::string name = {};
  double value = 0.0;                         ///< from 0, to either side
  std::optional<double> part = std::nullopt;  ///< part of the value, drawn dark
};

struct BarChart {
  std::string title = {};
  std::string subtitle = {};
  std::string label = {};  ///< label of the axis of values
  std::vector<Bar> bars = {};
  std::string value_meaning = {};  ///< for the legend, shown if there are parts
  std::string part_meaning = {};
};

/// Returns the bytes of the picture; the same chart gives the same SVG. Throws OutputError if
/// gnuplot is missing or fails. Precondition: at least one bar, finite values.
std::string draw_bar_chart(const BarChart& chart, PictureFormat format);

}  // namespace gearlash
