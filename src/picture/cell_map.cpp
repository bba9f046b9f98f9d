#include "picture/cell_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "picture/gnuplot.hpp"
#include "picture/gnuplot_script.hpp"

namespace gearlash {
namespace {

std::string tics(char axis, const std::vector<std::string>& names) {
  std::string text = fmt::format("set {}tics (", axis);
  for (std::size_t i = 0; i < names.size(); ++i) {
    text += fmt::format("{}{} {}", i == 0 ? "" : ", ", quoted(names[i]), i);
  }
  std::size_t characters = 0;
  for (const std::string& one : names) characters += one.size();
  constexpr std::size_t most_in_a_line = 55;
  const bool is_turned = axis == 'x' && characters > most_in_a_line;
  return text + ") scale 0" + (is_turned ? " rotate by 35 right" : "") + "\n";
}

/// Blue below 0 and orange above, or by ratio from light to orange.
std::string palette(const CellMap& map) {
  if (map.least > 0.0) {
    return fmt::format("set palette defined (0 '#fdf3ea', 1 '#f0a868')\nset cbrange [{}:{}]\n",
                       std::log10(map.least), std::log10(std::max(map.largest, 1.001 * map.least)));
  }
  return fmt::format(
      "set palette defined (-1 '#5aa7d6', 0 '#ffffff', 1 '#f0a868')\nset cbrange [{}:{}]\n",
      -map.largest, map.largest);
}

struct Cells {
  DataBlock numbers;
  DataBlock dots;
  DataBlock frames;
};

Cells cells_of(const CellPanel& panel, const std::string& name) {
  Cells cells{DataBlock(name), DataBlock(name + "_dots"), DataBlock(name + "_frames")};
  for (std::size_t row = 0; row < panel.values.size(); ++row) {
    for (std::size_t column = 0; column < panel.values[row].size(); ++column) {
      const double value = panel.values[row][column];
      const auto x = static_cast<double>(column);
      const auto y = static_cast<double>(row);
      if (!panel.framed.empty() && panel.framed[row][column]) cells.frames.row(x, y);
      if (std::isnan(value)) continue;
      std::isinf(value) ? cells.dots.row(x, y) : cells.numbers.row(x, y, value);
    }
  }
  return cells;
}

}  // namespace

std::string draw_cell_map(const CellMap& map, PictureFormat format) {
  const std::size_t panels_a_line = std::min<std::size_t>(3, map.panels.size());
  const bool is_one = map.panels.size() == 1;  // has room for longer numbers
  std::string data;
  std::string plots;
  for (std::size_t i = 0; i < map.panels.size(); ++i) {
    const std::string name = fmt::format("panel{}", i);
    const Cells cells = cells_of(map.panels[i], name);
    for (const DataBlock* block : {&cells.numbers, &cells.dots, &cells.frames}) {
      data += block->text();
    }
    plots += "set title " + quoted(map.panels[i].title) + " offset 0,-0.4\n";
    plots += i % panels_a_line == 0 ? "set ylabel " + quoted(map.y_label) + "\n" : "unset ylabel\n";
    plots += i + panels_a_line >= map.panels.size() ? "set xlabel " + quoted(map.x_label) + "\n"
                                                    : "unset xlabel\n";
    std::vector<std::string> layers;
    if (!cells.numbers.is_empty()) {
      layers.push_back(fmt::format(
          "${0} using 1:2:(0.48):(0.48):{3} with boxxyerror fill solid noborder linecolor palette "
          "notitle, ${0} using 1:2:(sprintf('{{/*{2} {1}}}',$3)) with labels notitle",
          name, map.number_format, is_one ? (map.columns.size() > 8 ? "0.75" : "1.0") : "0.7",
          map.least > 0.0 ? "(log10($3))" : "3"));
    }
    if (!cells.dots.is_empty()) {
      layers.push_back(fmt::format("${0}_dots using 1:2:('{{/*{1} ·}}') with labels notitle", name,
                                   is_one ? "2.5" : "1.0"));
    }
    if (!cells.frames.is_empty()) {
      layers.push_back(fmt::format(
          "${}_frames using 1:2:(0.46):(0.46) with boxxyerror fill empty linecolor rgb '#1b7837' "
          "linewidth 3 notitle",
          name));
    }
    if (layers.empty()) layers.push_back("1/0 notitle");  // keeps the axes
    plots += plot_command(layers);
    if (i == 0) plots += "unset label 1\nunset label 2\n";
  }
  std::string script = terminal(format) + "unset bmargin\nset encoding utf8\n";
  script += palette(map) + "unset colorbox\nset border linewidth 0.8\n";
  script += tics('x', map.columns) + tics('y', map.rows);
  script += fmt::format("set xrange [-0.5:{}]\nset yrange [-0.5:{}]\n",
                        static_cast<double>(map.columns.size()) - 0.5,
                        static_cast<double>(map.rows.size()) - 0.5);
  script += data;
  script += fmt::format("set multiplot layout {},{} margins {},0.97,0.1,0.84 spacing 0.06,0.12\n",
                        (map.panels.size() + panels_a_line - 1) / panels_a_line, panels_a_line,
                        is_one ? 0.17 : 0.09);
  script += "set label 1 " + quoted(map.title, "/:Bold") + " at screen 0.5, 0.96 center\n";
  script += "set label 2 " + quoted(map.subtitle, "/*0.87") + " at screen 0.5, 0.915 center\n";
  script += plots + "unset multiplot\n";
  return run_gnuplot(script, map.title);
}

}  // namespace gearlash
