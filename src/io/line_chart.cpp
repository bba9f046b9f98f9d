#include "gearlash/io/line_chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "gearlash/io/columns.hpp"
#include "gnuplot.hpp"
#include "gnuplot_script.hpp"

namespace gearlash {
namespace {

// Colours that the colour-blind tell apart (Okabe and Ito), dashes and marks that say the same in
// grey.
constexpr std::array colours = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                "#000000", "#56b4e9", "#e69f00"};
constexpr std::array dashes = {"1",     "(10,4)", "(4,3)",        "(12,3,3,3)",
                               "(2,2)", "(16,4)", "(8,3,2,3,2,3)"};
constexpr std::array marks = {5, 7, 9, 11, 13, 15, 3};

/// The legend in as many columns as its longest name permits, and below the axis the room for its
/// rows. Lengths in widths of a letter M, shares of the picture's height.
std::string legend(const LineChart& chart, PictureFormat format) {
  struct Page {
    double width;
    double axis;
    double row;
  };
  const Page page = format == PictureFormat::svg   ? Page{54.0, 0.155, 0.039}
                    : format == PictureFormat::png ? Page{75.0, 0.125, 0.027}
                                                   : Page{46.0, 0.14, 0.037};
  std::vector<std::string> names;
  for (const ChartCurve& curve : chart.curves) names.push_back(curve.name);
  for (const std::string& meaning : {chart.line_meaning, chart.mark_meaning, chart.end_meaning}) {
    if (!meaning.empty()) names.push_back(meaning);
  }
  std::size_t longest = 0;
  for (const std::string& name : names) longest = std::max(longest, width_in_columns(name));
  const double entry = 6.5 + 0.55 * static_cast<double>(longest);
  const int columns = std::clamp(static_cast<int>(page.width / entry), 1, 4);
  const int rows = (static_cast<int>(names.size()) + columns - 1) / columns;
  return fmt::format(
      "set bmargin screen {:.3f}\nset key at screen 0.54, 0.02 bottom center horizontal maxcols {} "
      "Left reverse samplen 3 spacing 1.25\n",
      page.axis + page.row * rows, columns);
}

DataBlock points(const std::string& name, const std::vector<ChartPoint>& data) {
  DataBlock block(name);
  for (const ChartPoint& point : data) {
    if (std::isnan(point.y)) {
      block.gap();
    } else {
      block.row(point.x, point.y);
    }
  }
  return block;
}

/// What lines, marks and circles are, without a curve of their own.
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
  std::string script = std::string(terminal(format)) + heading(chart.title, chart.subtitle) +
                       "set offsets 0, 0, graph 0.02, 0\n"
                       "set grid linewidth 0.5 linecolor rgb '#c4c4c4'\n";
  script += legend(chart, format) + axis_commands('x', chart.x) + axis_commands('y', chart.y);
  std::vector<std::string> layers;
  for (std::size_t i = 0; i < chart.curves.size(); ++i) {
    const ChartCurve& curve = chart.curves[i];
    const std::size_t style = i % colours.size();
    const std::string name = fmt::format("curve{}", i);
    const auto add = [&](const std::string& part, const std::vector<ChartPoint>& data,
                         const std::string& how, const std::string& title) {
      const DataBlock block = points(name + part, data);
      if (block.is_empty()) return;
      script += block.text();
      layers.push_back(fmt::format("${}{} using 1:2 {} linecolor rgb '{}' {}", name, part, how,
                                   colours[style], title));
    };
    const std::string line_style =
        fmt::format("with lines linewidth 1.8 dashtype {}", dashes[style]);
    add("_line", curve.line, line_style, "title " + quoted(curve.name));
    if (curve.line.empty()) {
      layers.push_back(fmt::format("keyentry {} linecolor rgb '{}' title {}", line_style,
                                   colours[style], quoted(curve.name)));
    }
    add("_marks", curve.marks,
        fmt::format("with points pointtype {} pointsize {}", marks[style], chart.mark_size),
        "notitle");
    add("_ends", curve.ends, "with points pointtype 6 pointsize 1.1", "notitle");
  }
  add_meanings(chart, layers);
  return run_gnuplot(script + plot_command(layers));
}

}  // namespace gearlash
