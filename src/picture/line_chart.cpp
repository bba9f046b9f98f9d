#include "picture/line_chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "picture/gnuplot.hpp"
#include "picture/gnuplot_script.hpp"

namespace gearlash {
namespace {

// Colours that colour-blind readers distinguish (Okabe and Ito); dashes and marks do the same in
// grey.
constexpr std::array colours = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                "#000000", "#56b4e9", "#e69f00"};
constexpr std::array dashes = {"1",     "(10,4)", "(4,3)",        "(12,3,3,3)",
                               "(2,2)", "(16,4)", "(8,3,2,3,2,3)"};
constexpr std::array marks = {5, 7, 9, 11, 13, 15, 3};

std::string legend(const LineChart& chart, PictureFormat format) {
  std::vector<std::string> names;
  for (const ChartCurve& curve : chart.curves) names.push_back(curve.name);
  for (const std::string& meaning : {chart.line_meaning, chart.mark_meaning, chart.end_meaning}) {
    if (!meaning.empty()) names.push_back(meaning);
  }
  return legend_below(names, format).commands;
}

DataBlock points(const std::string& name, const std::vector<ChartPoint>& data) {
  DataBlock block(name);
  for (const ChartPoint& point : data) {
    if (std::isfinite(point.y)) {
      block.row(point.x, point.y);
    } else {
      block.gap();
    }
  }
  return block;
}

/// Data and layers, bottom to top.
struct Drawing {
  std::string data = {};
  std::vector<std::string> layers = {};
};

void add_curve(const ChartCurve& curve, std::size_t number, double mark_size, Drawing& drawing) {
  const std::size_t style = number % colours.size();
  // After the last colour, colours repeat with other dashes.
  const std::size_t dash = (number + number / colours.size()) % dashes.size();
  const auto add = [&](const std::string& part, const std::vector<ChartPoint>& data,
                       const std::string& how, const std::string& title) {
    const DataBlock block = points(fmt::format("curve{}{}", number, part), data);
    if (block.is_empty()) return;
    drawing.data += block.text();
    drawing.layers.push_back(fmt::format("$curve{}{} using 1:2 {} linecolor rgb '{}' {}", number,
                                         part, how, colours[style], title));
  };
  const std::string line_style = fmt::format("with lines linewidth 1.8 dashtype {}", dashes[dash]);
  add("_line", curve.line, line_style, "title " + quoted(curve.name));
  if (curve.line.empty() && !curve.name.empty()) {
    drawing.layers.push_back(fmt::format("keyentry {} linecolor rgb '{}' title {}", line_style,
                                         colours[style], quoted(curve.name)));
  }
  add("_marks", curve.marks,
      fmt::format("with points pointtype {} pointsize {}", marks[style], mark_size), "notitle");
  add("_ends", curve.ends, "with points pointtype 6 pointsize 1.1", "notitle");
}

/// The axis with both ends, because gnuplot has no data to take them from.
ChartAxis bounded(ChartAxis axis) {
  if (!axis.low) axis.low = axis.logarithmic ? 0.5 * axis.high.value_or(2.0) : 0.0;
  if (!axis.high) axis.high = axis.logarithmic ? 2.0 * *axis.low : *axis.low + 1.0;
  return axis;
}

/// A logarithmic axis gets the ends of its data, because its labels depend on them.
ChartAxis spanned(const LineChart& chart, char name) {
  ChartAxis axis = name == 'x' ? chart.x : chart.y;
  if (!axis.logarithmic || (axis.low && axis.high)) return axis;
  double low = std::numeric_limits<double>::infinity();
  double high = 0.0;
  for (const ChartCurve& curve : chart.curves) {
    for (const auto* points : {&curve.line, &curve.marks, &curve.ends}) {
      for (const ChartPoint& point : *points) {
        const double value = name == 'x' ? point.x : point.y;
        if (!(value > 0.0 && std::isfinite(value))) continue;
        low = std::min(low, value);
        high = std::max(high, value);
      }
    }
  }
  if (!(low < high)) return axis;
  constexpr double margin = 1.05;
  if (!axis.low) axis.low = low / margin;
  if (!axis.high) axis.high = high * margin;
  return axis;
}

/// Draws only the axes, for which gnuplot needs a curve.
void add_nothing(const std::string& meaning, Drawing& drawing) {
  drawing.layers.emplace_back("1/0 notitle");
  drawing.data = "set label 2 " + quoted(meaning) + " at graph 0.5, graph 0.5 center\n";
}

/// Legend entries for lines, marks and circles, without curves.
void add_meanings(const LineChart& chart, std::vector<std::string>& layers) {
  if (!chart.line_meaning.empty()) {
    layers.push_back("keyentry with lines linewidth 1.8 linecolor rgb '#555555' title " +
                     quoted(chart.line_meaning));
  }
  if (!chart.mark_meaning.empty()) {
    layers.push_back(
        "keyentry with points pointtype 7 pointsize 0.8 linecolor rgb '#555555' title " +
        quoted(chart.mark_meaning));
  }
  if (!chart.end_meaning.empty()) {
    layers.push_back(
        "keyentry with points pointtype 6 pointsize 1.1 linecolor rgb '#555555' title " +
        quoted(chart.end_meaning));
  }
}

}  // namespace

std::string draw_line_chart(const LineChart& chart, PictureFormat format) {
  Drawing drawing;
  for (std::size_t i = 0; i < chart.curves.size(); ++i) {
    add_curve(chart.curves[i], i, chart.mark_size, drawing);
  }
  const bool is_empty = drawing.data.empty();
  if (is_empty) add_nothing(chart.empty_meaning, drawing);
  add_meanings(chart, drawing.layers);
  return run_gnuplot(terminal(format) + heading(chart.title, chart.subtitle) +
                         "set offsets 0, 0, graph 0.02, 0\n"
                         "set grid linewidth 0.5 linecolor rgb '#c4c4c4'\n" +
                         legend(chart, format) +
                         axis_commands('x', is_empty ? bounded(chart.x) : spanned(chart, 'x')) +
                         axis_commands('y', is_empty ? bounded(chart.y) : spanned(chart, 'y')) +
                         drawing.data + plot_command(drawing.layers),
                     chart.title);
}

}  // namespace gearlash
