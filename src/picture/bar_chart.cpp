#include "picture/bar_chart.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "output/columns.hpp"
#include "picture/gnuplot.hpp"
#include "picture/gnuplot_script.hpp"

namespace gearlash {
namespace {

constexpr double half_width = 0.36;  ///< of a bar; bars are 1 apart

/// Boxes from 0 to each value, the first bar on top.
template <class Value>
DataBlock boxes(const std::string& name, const std::vector<Bar>& bars, const Value& value_of) {
  DataBlock block(name);
  double place = static_cast<double>(bars.size());
  for (const Bar& bar : bars) {
    const double value = value_of(bar);
    block.row(0.5 * value, place, std::min(0.0, value), std::max(0.0, value), place - half_width,
              place + half_width);
    place -= 1.0;
  }
  return block;
}

std::string names_on_axis(const std::vector<Bar>& bars) {
  std::string tics;
  std::size_t place = bars.size();
  std::size_t longest = 0;
  for (const Bar& bar : bars) {
    tics += fmt::format("{}{} {}", tics.empty() ? "" : ", ", quoted(bar.name), place--);
    longest = std::max(longest, width_in_columns(bar.name));
  }
  return fmt::format("set ytics ({}) scale 0\nset lmargin {}\nset yrange [0.4:{}]\n", tics,
                     longest + 4, static_cast<double>(bars.size()) + 0.6);
}

}  // namespace

std::string draw_bar_chart(const BarChart& chart, PictureFormat format) {
  constexpr char style[] =
      "using 1:2:3:4:5:6 with boxxyerror fillstyle solid noborder linecolor rgb";
  const auto values = boxes("values", chart.bars, [](const Bar& bar) { return bar.value; });
  const auto parts =
      boxes("parts", chart.bars, [](const Bar& bar) { return bar.part.value_or(0.0); });
  const bool has_parts = std::any_of(chart.bars.begin(), chart.bars.end(),
                                     [](const Bar& bar) { return bar.part.has_value(); });
  std::vector<std::string> layers = {
      fmt::format("$values {} '{}' {}", style, has_parts ? "#9ecae1" : "#2e6fa8",
                  has_parts ? "title " + quoted(chart.value_meaning) : "notitle")};
  if (has_parts) {
    layers.push_back(
        fmt::format("$parts {} '#08519c' title {}", style, quoted(chart.part_meaning)));
  }
  return run_gnuplot(terminal(format) + heading(chart.title, chart.subtitle) +
                         "set grid xtics linewidth 0.5 linecolor rgb '#c4c4c4'\n"
                         "set xzeroaxis\nset arrow from 0, graph 0 to 0, graph 1 nohead front\n"
                         "set key bottom right\n" +
                         "set xlabel " + quoted(chart.label) + "\n" + names_on_axis(chart.bars) +
                         values.text() + (has_parts ? parts.text() : "") + plot_command(layers),
                     chart.title);
}

}  // namespace gearlash
