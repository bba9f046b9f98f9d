#include "picture/grid_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/lists.hpp"
#include "picture/curve_panel.hpp"
#include "picture/grid_words.hpp"
#include "picture/paper.hpp"
#include "picture/plot_making.hpp"
#include "question/family/evaluation.hpp"
#include "question/map/contours.hpp"

namespace gearlash {
namespace {

constexpr double shortest_drawn = 35.0;  ///< of contours, pixels
constexpr Colour light{104, 172, 214};   ///< of contours
constexpr Colour dark{8, 44, 107};
const Layer boundary_style{.colour = "#d55e00", .width = 3.0};
const Layer inner_style{.colour = "#606060", .width = 1.5, .dashes = "6,4"};
const Layer ceiling_style{.colour = "#7b3294", .width = 1.0, .dashes = "2,3"};

/// The proved bound of every motion whose size the quantity is.
std::optional<Quantity> ceiling_over(Quantity quantity) {
  if (quantity == Quantity::amplitude) return Quantity::ceiling;
  if (quantity == Quantity::motor_amplitude) return Quantity::motor_ceiling;
  return std::nullopt;
}

/// Round in the drawn unit.
std::vector<double> levels_of(const GridTable& table, Quantity quantity) {
  const double unit = drawn_unit(quantity, table.grid).size;
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
  const double unit = drawn_unit(quantity, table.grid).size;
  const std::vector<double> levels = levels_of(table, quantity);
  const auto in_table = of_each(levels, [&](double level) { return level * unit; });
  std::vector<Contour> contours = contours_of(table.grid, table.table, quantity, in_table);
  for (Contour& contour : contours) contour.level /= unit;
  return contours;
}

/// In the order of PlaceKind: light enough for contours on them, and of different lightness.
constexpr const char* kind_colours[] = {"#d4d4d4", "#eef6ee", "#fdf0c8", "#fbd9bd",
                                        "#e0b3c4", "#cfe8cf", "#f7efe6"};

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

/// A map on paper, from the units of its table, SI, to those that are drawn.
struct MapPaper {
  Paper table;
  Paper drawn;

  PaperLine on_paper(const MapCurve& curve) const { return thinned(table.on_paper(curve)); }
  /// The points that are needed.
  MapCurve seen(const MapCurve& curve) const { return drawn.on_map(on_paper(curve)); }
};

void add_line(const std::string& name, const std::vector<MapCurve>& curves, Layer style,
              const MapPaper& paper, Panel& panel) {
  for (const MapCurve& curve : curves) append(paper.seen(curve), style.points);
  style.name = name;
  if (!curves.empty()) panel.layers.push_back(std::move(style));
}

/// The regions, the largest outline first: what lies in a hole of one covers it.
void add_regions(const std::vector<MapRegion>& regions, const MapPaper& paper, Panel& panel) {
  std::vector<std::pair<double, Layer>> layers;
  for (const MapRegion& region : regions) {
    for (const MapCurve& outline : region.outlines) {
      const double area = area_within(paper.table.on_paper(outline));
      if (!(area > 0.0)) continue;  // a hole
      layers.emplace_back(area, Layer{.kind = LayerKind::area,
                                      .name = std::string(name_of(region.kind)),
                                      .colour = kind_colours[static_cast<std::size_t>(region.kind)],
                                      .points = paper.seen(outline)});
    }
  }
  sort_by(layers, [](const auto& one) { return -one.first; });
  for (auto& [area, layer] : layers) panel.layers.push_back(std::move(layer));
}

/// The contours from light to dark, with numbers in their longer parts.
void add_contours(const std::vector<Contour>& contours, const std::string& name, bool is_proved,
                  const MapPaper& paper, TextPlacer& placer, Panel& panel) {
  for (std::size_t i = 0; i < contours.size(); ++i) {
    const double share = contours.size() < 2
                             ? 1.0
                             : static_cast<double>(i) / static_cast<double>(contours.size() - 1);
    Layer layer =
        is_proved ? ceiling_style : Layer{.colour = mixed(light, dark, share), .width = 1.3};
    if (i == contours.size() / 2) layer.name = name;
    for (const MapCurve& curve : contours[i].curves) {
      const PaperLine line = paper.on_paper(curve);
      if (length_of(line) <= shortest_drawn) continue;  // would be clutter
      PlotText number{.text = fmt::format("{:.4g}", contours[i].level)};
      const auto place = placer.along(line, number.text, number.size);
      for (const PaperLine& part : place ? place->parts : std::vector<PaperLine>{line}) {
        append(paper.drawn.on_map(part), layer.points);
      }
      if (!place) continue;
      number.at = paper.drawn.on_map(place->centre);
      number.slope = place->slope;
      panel.texts.push_back(std::move(number));
    }
    panel.layers.push_back(std::move(layer));
  }
}

void add_all_contours(const GridTable& table, Quantity quantity,
                      const std::vector<MapCurve>& borders, const MapPaper& paper, Panel& panel) {
  const std::vector<Contour> contours = drawn_contours(table, quantity);
  std::vector<Contour> ceilings;
  const std::optional<Quantity> ceiling = ceiling_over(quantity);
  if (table.regions && !table.target && ceiling && table.table.has(*ceiling)) {
    ceilings = drawn_contours(table, *ceiling);
  }
  std::vector<PaperLine> lines;
  const auto avoid = [&](const std::vector<MapCurve>& curves) {
    for (const MapCurve& curve : curves) {
      PaperLine line = paper.on_paper(curve);
      if (length_of(line) > shortest_drawn) lines.push_back(std::move(line));
    }
  };
  avoid(borders);
  if (const auto mark = mark_of(table)) lines.push_back({paper.table.on_paper(*mark)});
  for (const Contour& contour : contours) avoid(contour.curves);
  for (const Contour& contour : ceilings) avoid(contour.curves);
  TextPlacer placer(std::move(lines), panel.height);
  const PlotAxis axis = plot_axis(quantity, table.grid);
  add_contours(contours, table.target ? label_of(axis) : axis.name, false, paper, placer, panel);
  add_contours(ceilings, "ceiling, proved", true, paper, placer, panel);
}

Panel panel_of(const Grid& grid) {
  Panel panel{.x = plot_axis(grid.axes[1], grid.drive), .y = plot_axis(grid.axes[0], grid.drive)};
  panel.x.has_grid = panel.y.has_grid = false;
  return panel;
}

/// Where hunting ends beside a target, and where energy alone forbids it.
void add_inner_borders(const GridTable& table, const MapPaper& paper, Panel& panel) {
  if (!table.target) {
    add_line("border of rest for any restitution",
             table.dissipative_boundary.value_or(std::vector<MapCurve>{}), inner_style, paper,
             panel);
  } else if (!table.target->no_hunting && !table.target->no_hunting_if_disturbed) {
    add_line("hunting ends", table.hunting_boundary.value(), inner_style, paper, panel);
  }
}

Plot contour_plot(const GridTable& table, Quantity quantity) {
  const Grid& grid = table.grid;
  Panel panel = panel_of(grid);
  Grid in_radians = grid;
  in_radians.drive.angle_unit = {};
  const MapPaper paper{Paper(panel_of(in_radians)), Paper(panel)};
  const std::vector<MapRegion> regions = table.regions       ? *table.regions
                                         : has_regions(grid) ? regions_of(table)
                                                             : std::vector<MapRegion>{};
  const std::vector<MapCurve> borders = borders_of(regions, grid);
  add_regions(regions, paper, panel);
  add_inner_borders(table, paper, panel);
  add_all_contours(table, quantity, borders, paper, panel);
  add_line(table.target    ? "limit"
           : table.regions ? "border"
                           : "hunting ends",
           borders, boundary_style, paper, panel);
  if (const auto mark = mark_of(table)) {
    const double x_unit = drawn_unit(grid.axes[1], grid.drive).size;
    const double y_unit = drawn_unit(grid.axes[0], grid.drive).size;
    panel.layers.push_back({.kind = LayerKind::marks,
                            .name = "now",
                            .size = 1.0,
                            .points = {{mark->x / x_unit, mark->y / y_unit}}});
  }
  return plot_of(table.target ? "Target: " + table.target_text
                              : name_with_unit(title_of(quantity), drawn_unit(quantity, grid).name),
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
  const auto texts_of = [&](const Axis& axis) {
    return of_each(axis.values, [&](double value) { return short_text(axis, grid.drive, value); });
  };
  cells.columns = texts_of(x);
  cells.rows = texts_of(y);
  const double unit = drawn_unit(quantity, grid).size;
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
  const auto label = [&](const Axis& axis) { return label_of(plot_axis(axis, grid.drive)); };
  return plot_of(name_with_unit(title_of(quantity), drawn_unit(quantity, grid).name),
                 subtitle_of(grid) + "; empty: not known", cell_panel(cells, label(x), label(y)));
}

}  // namespace

std::vector<Quantity> quantities_drawn(const Grid& grid, Quantity quantity, bool has_ceiling) {
  std::vector<Quantity> drawn = {Quantity::growth_at_rest, quantity};
  const auto ceiling = ceiling_over(quantity);
  if (has_ceiling && ceiling && Family(grid).engines().search) drawn.push_back(*ceiling);
  return drawn;
}

std::optional<MapPoint> place_on_map(const Grid& grid) {
  const std::optional<double> x = present_value(grid.axes[1], grid.drive);
  const std::optional<double> y = present_value(grid.axes[0], grid.drive);
  return x && y ? std::optional(MapPoint{*x, *y}) : std::nullopt;
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
