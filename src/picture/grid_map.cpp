#include "picture/grid_map.hpp"

#include <algorithm>

#include "analysis/grid/hunting_boundary.hpp"
#include "output/grid_words.hpp"
#include "picture/hatching.hpp"

namespace gearlash {
namespace {

std::vector<double> levels_of(const GridTable& table, CycleQuantity quantity) {
  std::vector<double> levels = round_levels(table.cycles[quantity]);
  // The boundary itself: its growth is 1, and so is the multiplier beside it.
  if (quantity == CycleQuantity::growth_at_rest) std::erase(levels, 1.0);
  return levels;
}

}  // namespace

ContourMap map_of(const GridTable& table, CycleQuantity quantity) {
  const ServoGrid& grid = table.grid;
  ContourMap map{.title = title_of(quantity) + unit_in_brackets(quantity, grid),
                 .subtitle = in_words(fixed_inputs(grid, " ").c_str()),
                 .x = chart_axis(grid.axes[1]),
                 .y = chart_axis(grid.axes[0]),
                 .contours = contours_of(grid, table.cycles, quantity, levels_of(table, quantity)),
                 .boundary = table.hunting_boundary.value(),
                 .contour_meaning = "contours",
                 .boundary_meaning = "hunting ends",
                 .hatching_meaning = "no limit cycle"};
  const Paper paper(map.x, map.y);
  map.hatching = hatching(table, paper);
  if (!table.dissipative_boundary) return map;
  map.inner_boundary = *table.dissipative_boundary;
  map.inner_meaning = "none, any restitution";
  map.inner_hatching =
      hatching(map.inner_boundary, paper,
               {.stretch =
                    [&](const MapPoint& middle) {
                      return side_of_dissipation(servo_at(grid, middle)) == Side::outside;
                    }},
               HatchLines::second);
  return map;
}

}  // namespace gearlash
