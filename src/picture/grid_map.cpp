#include "picture/grid_map.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "picture/cell_map.hpp"
#include "picture/grid_words.hpp"
#include "picture/hatching.hpp"
#include "question/family/evaluation.hpp"
#include "question/map/hunting_boundary.hpp"

namespace gearlash {
namespace {

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

void add_regions(const GridTable& table, Quantity quantity, ContourMap& map) {
  for (const MapRegion& region : *table.regions) {
    map.regions.push_back(
        {std::string(name_of(region.kind)), colour_of(region.kind), region.outlines});
  }
  map.boundary = borders_of(*table.regions, table.grid);
  map.boundary_meaning = table.target ? "limit" : "border";
  map.contour_meaning = in_words(std::string(gearlash::name_of(quantity)));
  if (table.target) {
    map.title = "Target: " + table.target_text;
    map.contour_meaning += unit_in_brackets(quantity, table.grid, table.angle);
    const bool is_limit = table.target->no_hunting || table.target->no_hunting_if_disturbed;
    if (!is_limit) map.inner_boundary = *table.hunting_boundary;
    map.inner_meaning = "hunting ends";
    return;
  }
  const std::optional<Quantity> ceiling = ceiling_over(quantity);
  if (!ceiling || !table.table.has(*ceiling)) return;
  map.other_contours = drawn_contours(table, *ceiling);
  map.other_meaning = "ceiling, proved";
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

ContourMap in_radians(const GridTable& table, Quantity quantity) {
  const Grid& grid = table.grid;
  ContourMap map{.title = title_of(quantity) + unit_in_brackets(quantity, grid, table.angle),
                 .subtitle = subtitle_of(grid),
                 .x = chart_axis(grid.axes[1], grid.drive, {}),
                 .y = chart_axis(grid.axes[0], grid.drive, {}),
                 .contours = drawn_contours(table, quantity),
                 .boundary = table.hunting_boundary.value(),
                 .mark = mark_of(table),
                 .contour_meaning = "contours",
                 .boundary_meaning = "hunting ends",
                 .hatching_meaning = "no limit cycle",
                 .mark_meaning = "now"};
  if (table.regions) {
    add_regions(table, quantity, map);
    return map;
  }
  const Paper paper(map.x, map.y);
  map.hatching = hatching(table, paper);
  if (!table.dissipative_boundary) return map;
  const Family family(grid);
  map.inner_boundary = *table.dissipative_boundary;
  map.inner_meaning = "none, any restitution";
  map.inner_hatching =
      hatching(map.inner_boundary, paper,
               {.stretch =
                    [&](const MapPoint& middle) {
                      return side_of_dissipation(servo_at(family, middle)) == Side::outside;
                    }},
               HatchLines::second);
  return map;
}

}  // namespace

ContourMap map_of(const GridTable& table, Quantity quantity) {
  ContourMap map = in_radians(table, quantity);
  const Grid& grid = table.grid;
  map.x = chart_axis(grid.axes[1], grid.drive, table.angle);
  map.y = chart_axis(grid.axes[0], grid.drive, table.angle);
  const double x_unit = drawn_unit(grid.axes[1], grid.drive, table.angle);
  const double y_unit = drawn_unit(grid.axes[0], grid.drive, table.angle);
  if (x_unit == 1.0 && y_unit == 1.0) return map;
  const auto draw_in_units = [&](std::vector<MapCurve>& curves) {
    for (MapCurve& curve : curves) {
      for (MapPoint& point : curve) point = {point.x / x_unit, point.y / y_unit};
    }
  };
  for (ColouredRegion& region : map.regions) draw_in_units(region.outlines);
  for (std::vector<Contour>* contours : {&map.contours, &map.other_contours}) {
    for (Contour& contour : *contours) draw_in_units(contour.curves);
  }
  for (std::vector<MapCurve>* curves :
       {&map.boundary, &map.hatching, &map.inner_boundary, &map.inner_hatching}) {
    draw_in_units(*curves);
  }
  if (map.mark) map.mark = {map.mark->x / x_unit, map.mark->y / y_unit};
  return map;
}

namespace {

/// One cell for each point: its number, or infinity (a dot) if the drive comes to rest.
CellMap cells_of(const GridTable& table, Quantity quantity) {
  const Grid& grid = table.grid;
  const Axis& y = grid.axes[0];
  const Axis& x = grid.axes[1];
  CellMap map{.title = title_of(quantity) + unit_in_brackets(quantity, grid, table.angle),
              .subtitle = subtitle_of(grid) + "; · comes to rest, empty: not known" +
                          (table.target ? "; framed: " + table.target_text : ""),
              .x_label = chart_axis(x, grid.drive, table.angle).label,
              .y_label = chart_axis(y, grid.drive, table.angle).label,
              .largest = 0.0,
              .number_format = "%.3g"};
  for (const double value : x.values) {
    map.columns.push_back(short_text(x, grid.drive, value, table.angle));
  }
  for (const double value : y.values) {
    map.rows.push_back(short_text(y, grid.drive, value, table.angle));
  }
  CellPanel panel;
  const double unit = drawn_unit(quantity, grid, table.angle);
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < y.values.size(); ++i) {
    std::vector<double>& row = panel.values.emplace_back();
    std::vector<bool>& framed = panel.framed.emplace_back();
    for (std::size_t j = 0; j < x.values.size(); ++j) {
      const std::size_t point = i * x.values.size() + j;
      const double value = motion_value(table.table, quantity, point) / unit;
      const bool is_rest = std::isnan(value) && !std::isnan(table.table[quantity][point]);
      row.push_back(is_rest ? std::numeric_limits<double>::infinity() : value);
      framed.push_back(table.target && table.kinds[point] == PlaceKind::met);
      if (!std::isfinite(value)) continue;
      map.largest = std::max(map.largest, std::abs(value));
      least = std::min(least, value);
    }
  }
  constexpr double far = 10.0;  // a ratio that proportional colours would not show
  if (least > 0.0 && map.largest > far * least) map.least = least;
  if (map.largest == 0.0) map.largest = 1.0;
  map.panels.push_back(std::move(panel));
  return map;
}

}  // namespace

std::optional<Quantity> ceiling_over(Quantity quantity) {
  if (quantity == Quantity::amplitude) return Quantity::ceiling;
  if (quantity == Quantity::motor_amplitude) return Quantity::motor_ceiling;
  return std::nullopt;
}

std::string draw_grid_map(const GridTable& table, Quantity quantity, PictureFormat format) {
  constexpr std::size_t most_cells = 12;  // in a line with numbers
  const Grid& grid = table.grid;
  bool any_words = false;
  bool is_small = true;
  for (const Axis& axis : grid.axes) {
    any_words = any_words || has_words(axis, grid.drive);
    is_small = is_small && axis.values.size() <= most_cells;
  }
  const bool as_cells = any_words || (is_small && !table.target && Family(grid).engines().search);
  return as_cells ? draw_cell_map(cells_of(table, quantity), format)
                  : draw_contour_map(map_of(table, quantity), format);
}

}  // namespace gearlash
