#include "grid_reply.hpp"

#include <array>
#include <string>

#include "base/range_check.hpp"
#include "gearlash/grid.hpp"
#include "input/axis_text.hpp"
#include "output/grid_table.hpp"
#include "picture/bifurcation_picture.hpp"
#include "picture/grid_map.hpp"
#include "picture/grid_words.hpp"
#include "question/family/evaluation.hpp"
#include "question/map/bifurcations.hpp"

namespace gearlash::web {
namespace {

MapAxis shown(const Axis& axis, const WrittenDrive& written) {
  return {axis.path, drawn_unit(axis, written.drive).size};
}

Axis read(const char* field, const Json& request, const Drive& drive) {
  return read_axis_or_name(field, request.at(field).get<std::string>(), drive);
}

/// More points than a picture shows would keep the page waiting.
void require_few(const Grid& grid) {
  constexpr double most_points = 40'000;
  double points = 1.0;  // their product may be larger than a std::size_t of WebAssembly
  for (const Axis& axis : grid.axes) points *= static_cast<double>(axis.values.size());
  if (points <= most_points) return;
  refuse("points", exact_text(points),
         "must be at most " + exact_text(most_points) +
             " in the page; the command line has room for more");
}

}  // namespace

MapReply map_reply(const Json& request, const WrittenDrive& written, Progress& progress) {
  GridTable table{
      .grid = {.drive = written.drive,
               .axes = {read("y", request, written.drive), read("x", request, written.drive)}}};
  const Grid& grid = table.grid;
  require_none(faults(grid, {"y", "x"}));
  require_few(grid);
  constexpr std::array quantities = {Quantity::growth_at_rest, Quantity::amplitude};
  table.table = Table(grid.size(), quantities);
  const RowCount count = work_out(table, progress);
  add_borders(table, progress);
  return {.plot = drawn(map_plot(table, Quantity::amplitude)),
          .x = shown(grid.axes[1], written),
          .y = shown(grid.axes[0], written),
          .is_complete = !count.stopped};
}

MapReply chart_reply(const Json& request, const WrittenDrive& written, Progress& progress) {
  const Axis axis = read("x", request, written.drive);
  const Grid grid{.drive = written.drive, .axes = {axis}};
  require_none(faults(grid, {"x"}));
  const BifurcationDiagram diagram = bifurcations_of(written.drive, axis, progress);
  return {.plot = drawn(bifurcation_plot(diagram, grid, Quantity::amplitude)),
          .x = shown(axis, written),
          .is_complete = diagram.is_complete};
}

}  // namespace gearlash::web
