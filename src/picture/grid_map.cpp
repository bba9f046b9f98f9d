#include "picture/grid_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "picture/curve_panel.hpp"
#include "picture/grid_words.hpp"
#include "picture/hatching.hpp"
#include "picture/paper.hpp"
#include "question/family/evaluation.hpp"
#include "question/map/contours.hpp"
#include "question/map/hunting_boundary.hpp"

namespace gearlash {
namespace {

constexpr double shortest_drawn = 35.0;  ///< of contours, pixels
constexpr Colour light{104, 172, 214};   ///< of contours
constexpr Colour dark{8, 44, 107};
const Layer boundary_style{.colour = "#d55e00", .width = 3.0};
const Layer inner_style{.colour = "#606060", .width = 1.5, .dashes = "6,4"};
const Layer ceiling_style{.colour = "#7b3294", .width = 1.0, .dashes = "2,3"};

/// Round in the drawn unit.
std::vector<double> levels_of(const GridTable& table, Quantity quantity) {
  const double unit = drawn_unit(quantity, table.grid, table.angle);
  std::vector<double> motions(table.table.rows());
  for (std::size_t row = 0; row < motions.size(); ++row) {
    motions[row] = motion_value(table.table, quantity, row) / unit;
  }
  std::vector<double> levels = round_levels(std::move(motions));
  // Level 1 is the boundary itself: growth at rest and the multiplier beside it are 1 there.
  if (quantity == Quantity::growth_at_rest) std::erase(levels, 1.0);
  return levels;
}

/// With their levels in the drawn unit.
std::vector<Contour> drawn_contours(const GridTable& table, Quantity quantity) {
  const double unit = drawn_unit(quantity, table.grid, table.angle);
  const std::vector<double> levels = levels_of(table, quantity);
  std::vector<double> in_table;
  for (const double level : levels) in_table.push_back(level * unit);
  std::vector<Contour> contours = contours_of(table.grid, table.table, quantity, in_table);
  for (Contour& contour : contours) contour.level /= unit;
  return contours;
}

/// Light enough for contours on them, and of different lightness.
const char* colour_of(PlaceKind kind) {
  switch (kind) {
    case PlaceKind::rests:
      return "#eef6ee";
    case PlaceKind::hunts_if_disturbed:
      return "#fdf0c8";
    case PlaceKind::hunts:
      return "#fbd9bd";
    case PlaceKind::runs_away:
      return "#e0b3c4";
    case PlaceKind::met:
      return "#cfe8cf";
    case PlaceKind::missed:
      return "#f7efe6";
    case PlaceKind::not_known:
      break;
  }
  return "#d4d4d4";
}

/// The place of the drive as it is, if it lies on the map.
std::optional<MapPoint> mark_of(const GridTable& table) {
  if (!table.present) return std::nullopt;
  const auto contains = [&](std::size_t axis, double value) {
    const std::vector<double>& values = table.grid.axes[axis].values;
    return value >= values.front() && value <= values.back();
  };
  const bool is_on_map = contains(1, table.present->x) && contains(0, table.present->y);
  return is_on_map ? table.present : std::nullopt;
}

/// The points that are needed on paper.
MapCurve seen(const MapCurve& curve, const Paper& paper) {
  return paper.on_map(thinned(paper.on_paper(curve)));
}

void add_line(const std::string& name, const std::vector<MapCurve>& curves, Layer style,
              const Paper& paper, Panel& panel) {
  for (const MapCurve& curve : curves) append(seen(curve, paper), style.points);
  style.name = name;
  if (!curves.empty()) panel.layers.push_back(std::move(style));
}

/// The regions, the largest outline first: what lies in a hole of one covers it.
void add_regions(const GridTable& table, const Paper& paper, Panel& panel) {
  std::vector<std::pair<double, Layer>> layers;
  for (const MapRegion& region : *table.regions) {
    for (const MapCurve& outline : region.outlines) {
      const double area = area_within(paper.on_paper(outline));
      if (!(area > 0.0)) continue;  // a hole
      layers.emplace_back(area, Layer{.kind = LayerKind::area,
                                      .name = std::string(name_of(region.kind)),
                                      .colour = colour_of(region.kind),
                                      .points = seen(outline, paper)});
    }
  }
  std::stable_sort(layers.begin(), layers.end(),
                   [](const auto& one, const auto& other) { return one.first > other.first; });
  for (auto& [area, layer] : layers) panel.layers.push_back(std::move(layer));
}

/// Hatches where there is no limit cycle, and doubly where there is none for any restitution.
void add_hatching(const GridTable& table, const Paper& paper, Panel& panel) {
  const auto add = [&](const std::string& name, const char* colour,
                       const std::vector<MapCurve>& lines) {
    if (lines.empty()) return;
    panel.layers.push_back(
        {.kind = LayerKind::hatching, .name = name, .colour = colour, .points = joined(lines)});
  };
  add("no limit cycle", "#a8a8a8", hatching(table, paper));
  if (!table.dissipative_boundary) return;
  const Family family(table.grid);
  const auto is_dissipative = [&](const MapPoint& middle) {
    return side_of_dissipation(servo_at(family, middle)) == Side::outside;
  };
  const std::string name = "none, any restitution";
  const std::vector<MapCurve> inner =
      hatching(*table.dissipative_boundary, paper, {.stretch = is_dissipative}, HatchLines::second);
  add(name, "#6e6e6e", inner);
  add_line(inner.empty() ? name : "", *table.dissipative_boundary, inner_style, paper, panel);
}

/// The contours from light to dark, with numbers in their longer parts.
void add_contours(const std::vector<Contour>& contours, const std::string& name, bool is_proved,
                  const Paper& paper, TextPlacer& placer, Panel& panel) {
  for (std::size_t i = 0; i < contours.size(); ++i) {
    const double share = contours.size() < 2
                             ? 1.0
                             : static_cast<double>(i) / static_cast<double>(contours.size() - 1);
    Layer layer =
        is_proved ? ceiling_style : Layer{.colour = mixed(light, dark, share), .width = 1.3};
    if (i == contours.size() / 2) layer.name = name;
    for (const MapCurve& curve : contours[i].curves) {
      const PaperLine line = thinned(paper.on_paper(curve));
      if (length_of(line) <= shortest_drawn) continue;  // would be clutter
      PlotText number{.text = fmt::format("{:.4g}", contours[i].level)};
      const auto place = placer.along(line, number.text, number.size);
      for (const PaperLine& part : place ? place->parts : std::vector<PaperLine>{line}) {
        append(paper.on_map(part), layer.points);
      }
      if (!place) continue;
      number.at = paper.on_map(place->centre);
      number.slope = place->slope;
      panel.texts.push_back(std::move(number));
    }
    panel.layers.push_back(std::move(layer));
  }
}

void add_all_contours(const GridTable& table, Quantity quantity,
                      const std::vector<MapCurve>& boundary, const Paper& paper, Panel& panel) {
  const std::vector<Contour> contours = drawn_contours(table, quantity);
  std::vector<Contour> ceilings;
  const std::optional<Quantity> ceiling = ceiling_over(quantity);
  if (table.regions && !table.target && ceiling && table.table.has(*ceiling)) {
    ceilings = drawn_contours(table, *ceiling);
  }
  std::vector<PaperLine> lines;
  const auto avoid = [&](const std::vector<MapCurve>& curves) {
    for (const MapCurve& curve : curves) {
      PaperLine line = thinned(paper.on_paper(curve));
      if (length_of(line) > shortest_drawn) lines.push_back(std::move(line));
    }
  };
  avoid(boundary);
  if (const auto mark = mark_of(table)) lines.push_back({paper.on_paper(*mark)});
  for (const Contour& contour : contours) avoid(contour.curves);
  for (const Contour& contour : ceilings) avoid(contour.curves);
  TextPlacer placer(std::move(lines), panel.height);
  const std::string name =
      table.regions ? in_words(std::string(gearlash::name_of(quantity))) : "contours";
  add_contours(contours,
               table.target ? name + unit_in_brackets(quantity, table.grid, table.angle) : name,
               false, paper, placer, panel);
  add_contours(ceilings, "ceiling, proved", true, paper, placer, panel);
}

/// In the units of the table's grid, SI.
Panel panel_of(const GridTable& table, Quantity quantity) {
  const Grid& grid = table.grid;
  Panel panel{.x = plot_axis(grid.axes[1], grid.drive, {}),
              .y = plot_axis(grid.axes[0], grid.drive, {})};
  panel.x.has_grid = panel.y.has_grid = false;
  const Paper paper(panel);
  if (table.regions) {
    add_regions(table, paper, panel);
    const bool is_limit =
        table.target && (table.target->no_hunting || table.target->no_hunting_if_disturbed);
    if (table.target && !is_limit) {
      add_line("hunting ends", *table.hunting_boundary, inner_style, paper, panel);
    }
  } else {
    add_hatching(table, paper, panel);
  }
  const std::vector<MapCurve> boundary =
      table.regions ? borders_of(*table.regions, grid) : table.hunting_boundary.value();
  add_all_contours(table, quantity, boundary, paper, panel);
  add_line(!table.regions ? "hunting ends"
           : table.target ? "limit"
                          : "border",
           boundary, boundary_style, paper, panel);
  if (const auto mark = mark_of(table)) {
    panel.layers.push_back(
        {.kind = LayerKind::marks, .name = "now", .size = 1.0, .points = {*mark}});
  }
  return panel;
}

Plot contour_plot(const GridTable& table, Quantity quantity) {
  const Grid& grid = table.grid;
  Panel panel = panel_of(table, quantity);
  const auto set_axis = [&](std::size_t axis, PlotAxis& drawn) {
    drawn = plot_axis(grid.axes[axis], grid.drive, table.angle);
    drawn.has_grid = false;
    return drawn_unit(grid.axes[axis], grid.drive, table.angle);
  };
  const double x_unit = set_axis(1, panel.x);
  const double y_unit = set_axis(0, panel.y);
  const auto draw_in_units = [&](MapPoint& point) { point = {point.x / x_unit, point.y / y_unit}; };
  for (Layer& layer : panel.layers) {
    std::for_each(layer.points.begin(), layer.points.end(), draw_in_units);
  }
  for (PlotText& text : panel.texts) draw_in_units(text.at);
  return plot_of(table.target ? "Target: " + table.target_text
                              : title_of(quantity) + unit_in_brackets(quantity, grid, table.angle),
                 subtitle_of(grid), std::move(panel));
}

/// One cell for each point: its number, or a dot if the drive comes to rest.
Plot cell_plot(const GridTable& table, Quantity quantity) {
  const Grid& grid = table.grid;
  const Axis& y = grid.axes[0];
  const Axis& x = grid.axes[1];
  Cells cells{.largest = 0.0,
              .number_format = "{:.3g}",
              .letters = x.values.size() > 8 ? 0.75 : 1.0,
              .dot_meaning = "comes to rest",
              .frame_meaning = table.target ? "framed: " + table.target_text : ""};
  for (const double value : x.values) {
    cells.columns.push_back(short_text(x, grid.drive, value, table.angle));
  }
  for (const double value : y.values) {
    cells.rows.push_back(short_text(y, grid.drive, value, table.angle));
  }
  const double unit = drawn_unit(quantity, grid, table.angle);
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < y.values.size(); ++i) {
    std::vector<double>& row = cells.values.emplace_back();
    std::vector<bool>& framed = cells.framed.emplace_back();
    for (std::size_t j = 0; j < x.values.size(); ++j) {
      const std::size_t point = i * x.values.size() + j;
      const double value = motion_value(table.table, quantity, point) / unit;
      const bool is_rest = std::isnan(value) && !std::isnan(table.table[quantity][point]);
      row.push_back(is_rest ? std::numeric_limits<double>::infinity() : value);
      framed.push_back(table.target && table.kinds[point] == PlaceKind::met);
      if (!std::isfinite(value)) continue;
      cells.largest = std::max(cells.largest, std::abs(value));
      least = std::min(least, value);
    }
  }
  constexpr double far = 10.0;  // a ratio that proportional colours would not show
  if (least > 0.0 && cells.largest > far * least) cells.least = least;
  if (cells.largest == 0.0) cells.largest = 1.0;
  const auto label = [&](const Axis& axis) {
    const PlotAxis drawn = plot_axis(axis, grid.drive, table.angle);
    return drawn.unit.empty() ? drawn.name : drawn.name + " (" + drawn.unit + ")";
  };
  return plot_of(title_of(quantity) + unit_in_brackets(quantity, grid, table.angle),
                 subtitle_of(grid) + "; empty: not known", cell_panel(cells, label(x), label(y)));
}

}  // namespace

std::optional<Quantity> ceiling_over(Quantity quantity) {
  if (quantity == Quantity::amplitude) return Quantity::ceiling;
  if (quantity == Quantity::motor_amplitude) return Quantity::motor_ceiling;
  return std::nullopt;
}

Plot map_plot(const GridTable& table, Quantity quantity) {
  constexpr std::size_t most_cells = 12;  // in a line with numbers
  const Grid& grid = table.grid;
  bool any_words = false;
  bool is_small = true;
  for (const Axis& axis : grid.axes) {
    any_words = any_words || has_words(axis, grid.drive);
    is_small = is_small && axis.values.size() <= most_cells;
  }
  const bool as_cells = any_words || (is_small && !table.target && Family(grid).engines().search);
  return as_cells ? cell_plot(table, quantity) : contour_plot(table, quantity);
}

}  // namespace gearlash
