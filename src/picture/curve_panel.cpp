#include "picture/curve_panel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "base/lists.hpp"
#include "picture/plot_making.hpp"

namespace gearlash {
namespace {

constexpr std::array colours = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                "#000000", "#56b4e9", "#e69f00"};
constexpr std::array dashes = {"", "10,4", "4,3", "12,3,3,3", "2,2", "16,4", "8,3,2,3,2,3"};
constexpr std::array marks = {Mark::square,  Mark::disc,     Mark::triangle, Mark::wedge,
                              Mark::diamond, Mark::pentagon, Mark::star};
constexpr char meaning_colour[] = "#555555";
constexpr double end_size = 1.1;

}  // namespace

void add_curves(const std::vector<NamedCurve>& curves, double mark_size, Panel& panel) {
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const NamedCurve& curve = curves[i];
    const std::size_t style = i % colours.size();
    // After the last colour, colours repeat with other dashes.
    panel.layers.push_back({.name = curve.name,
                            .colour = colours[style],
                            .dashes = dashes[(i + i / colours.size()) % dashes.size()],
                            .points = curve.line});
    panel.layers.push_back({.kind = LayerKind::marks,
                            .colour = colours[style],
                            .mark = marks[style],
                            .size = mark_size,
                            .points = curve.marks});
    panel.layers.push_back({.kind = LayerKind::marks,
                            .colour = colours[style],
                            .mark = Mark::circle,
                            .size = end_size,
                            .points = curve.ends});
  }
}

void explain_curves(const std::string& line, const std::string& mark, double mark_size,
                    const std::string& end, Panel& panel) {
  panel.layers.push_back({.name = line, .colour = meaning_colour});
  panel.layers.push_back(
      {.kind = LayerKind::marks, .name = mark, .colour = meaning_colour, .size = mark_size});
  panel.layers.push_back({.kind = LayerKind::marks,
                          .name = end,
                          .colour = meaning_colour,
                          .mark = Mark::circle,
                          .size = end_size});
}

void say(const std::string& reason, Panel& panel) {
  constexpr double middle = 0.5;
  panel.texts.push_back({.at = {value_at(span_of(finished_x(panel)), middle),
                                value_at(span_of(finished_y(panel)), middle)},
                         .text = reason,
                         .size = 1.0});
}

Panel bar_panel(const std::vector<Bar>& bars, PlotAxis values, const std::string& value_meaning,
                const std::string& part_meaning) {
  const bool has_parts = any_of(bars, [](const Bar& bar) { return bar.part.has_value(); });
  Layer whole{.kind = LayerKind::area,
              .name = has_parts ? value_meaning : "",
              .colour = has_parts ? "#9ecae1" : "#2e6fa8"};
  Layer dark{.kind = LayerKind::area, .name = has_parts ? part_meaning : "", .colour = "#08519c"};
  const auto count = static_cast<double>(bars.size());
  Panel panel{.x = std::move(values),
              .y = {.low = 0.4, .high = count + 0.6, .has_grid = false},
              .height = std::clamp(40.0 * count + 20.0, 100.0, 480.0)};
  double place = count;
  for (const Bar& bar : bars) {
    constexpr double half_width = 0.36;
    const auto add = [&](double value, Layer& layer) {
      append(rectangle({std::min(0.0, value), std::max(0.0, value)},
                       {place - half_width, place + half_width}),
             layer.points);
    };
    add(bar.value, whole);
    if (bar.part) add(*bar.part, dark);
    panel.y.tics.push_back({place, bar.name});
    place -= 1.0;
  }
  panel.layers = {std::move(whole), std::move(dark)};
  const PlotAxis drawn = finished_x(panel);
  const Bounds data{drawn.low, drawn.high};
  const Bounds wide = widened(data, 0.04);
  panel.x.low = data.low < 0.0 ? wide.low : 0.0;
  panel.x.high = data.high > 0.0 ? wide.high : 0.0;
  panel.layers.push_back({.width = 1.0, .points = {{0.0, panel.y.low}, {0.0, panel.y.high}}});
  return panel;
}

namespace {

/// Blue below 0 and orange above, or by ratio from light to orange.
std::string colour_of(const Cells& cells, double value) {
  constexpr Colour blue{90, 167, 214};
  constexpr Colour white{255, 255, 255};
  constexpr Colour light{253, 243, 234};
  constexpr Colour orange{240, 168, 104};
  if (cells.least > 0.0) {
    const double whole = std::log(std::max(cells.largest / cells.least, 1.001));
    return mixed(light, orange, std::log(value / cells.least) / whole);
  }
  return mixed(white, value < 0.0 ? blue : orange, std::abs(value) / cells.largest);
}

std::vector<Tic> numbered(const std::vector<std::string>& names) {
  return of_each(indices(names.size()), [&](std::size_t i) {
    return Tic{static_cast<double>(i), names[i]};
  });
}

PlotAxis axis_of_names(std::string name, const std::vector<std::string>& names) {
  return {.name = std::move(name),
          .low = -0.5,
          .high = static_cast<double>(names.size()) - 0.5,
          .tics = numbered(names),
          .has_grid = false};
}

}  // namespace

Panel cell_panel(const Cells& cells, std::string x_name, std::string y_name) {
  Panel panel{.x = axis_of_names(std::move(x_name), cells.columns),
              .y = axis_of_names(std::move(y_name), cells.rows)};
  std::map<std::string, MapCurve> areas;
  Layer dots{.kind = LayerKind::marks, .name = cells.dot_meaning, .size = 0.3};
  Layer frames{.name = cells.frame_meaning, .colour = "#1b7837", .width = 3.0};
  for (std::size_t row = 0; row < cells.values.size(); ++row) {
    for (std::size_t column = 0; column < cells.values[row].size(); ++column) {
      const double value = cells.values[row][column];
      const MapPoint at{static_cast<double>(column), static_cast<double>(row)};
      const auto square = [&](double half) {
        return rectangle({at.x - half, at.x + half}, {at.y - half, at.y + half});
      };
      if (!cells.framed.empty() && cells.framed[row][column]) {
        MapCurve frame = square(0.46);
        frame.push_back(frame.front());
        append(frame, frames.points);
      }
      if (std::isinf(value)) dots.points.push_back(at);
      if (!std::isfinite(value)) continue;
      append(square(0.48), areas[colour_of(cells, value)]);
      panel.texts.push_back({.at = at,
                             .text = fmt::format(fmt::runtime(cells.number_format), value),
                             .size = cells.letters});
    }
  }
  for (auto& [colour, points] : areas) {
    panel.layers.push_back(
        {.kind = LayerKind::area, .colour = colour, .points = std::move(points)});
  }
  if (!dots.points.empty()) panel.layers.push_back(std::move(dots));
  if (!cells.framed.empty()) panel.layers.push_back(std::move(frames));
  return panel;
}

}  // namespace gearlash
