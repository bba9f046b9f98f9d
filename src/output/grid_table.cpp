#include "output/grid_table.hpp"

#include <algorithm>
#include <cmath>

#include "output/csv_table.hpp"
#include "output/drive_text.hpp"
#include "output/json_values.hpp"
#include "question/map/hunting_boundary.hpp"

namespace gearlash {
namespace {

/// "[[[x, y], …], …]" with one line for each curve.
void write_curves(const std::vector<MapCurve>& curves, const TextSink& sink) {
  sink("[");
  for (std::size_t i = 0; i < curves.size(); ++i) {
    sink(i == 0 ? "\n    [" : ",\n    [");
    for (std::size_t j = 0; j < curves[i].size(); ++j) {
      const MapPoint& point = curves[i][j];
      sink((j == 0 ? "" : ", ") + Json({point.x, point.y}).dump());
    }
    sink("]");
  }
  sink(curves.empty() ? "]" : "\n  ]");
}

void write_regions(const std::vector<MapRegion>& regions, const TextSink& sink) {
  sink(",\n  \"regions\": [");
  for (std::size_t i = 0; i < regions.size(); ++i) {
    const Json kind = std::string(name_of(regions[i].kind));
    sink((i == 0 ? "{\"kind\": " : ", {\"kind\": ") + kind.dump() + ", \"outlines\": ");
    write_curves(regions[i].outlines, sink);
    sink("}");
  }
  sink("]");
}

/// "[1, null, …]".
template <class Values, class Convert>
void write_list(const Values& values, const Convert& convert, const TextSink& sink) {
  sink("[");
  for (std::size_t i = 0; i < values.size(); ++i) {
    sink((i == 0 ? "" : ", ") + Json(convert(values[i])).dump());
  }
  sink("]");
}

Json json_axes(const Grid& grid) {
  return json_list(grid.axes, [&](const Axis& axis) {
    const std::string unit = unit_of(axis, grid.drive);
    const auto json_of = [&](double value) { return json_value(axis, grid.drive, value); };
    return Json{{"path", axis.path},
                {"unit", unit.empty() ? Json(nullptr) : Json(unit)},
                {"spacing", axis.logarithmic ? "logarithmic" : "linear"},
                {"values", json_list(axis.values, json_of)}};
  });
}

std::vector<Quantity> quantities_of(const Table& table) {
  std::vector<Quantity> found;
  for (const QuantityInfo& info : quantities()) {
    const bool is_number = info.kind == QuantityKind::number;
    if (is_number && table.has(info.quantity)) found.push_back(info.quantity);
  }
  return found;
}

void write_columns(const GridTable& of, const TextSink& sink) {
  const Table& table = of.table;
  sink("{\n    \"verdict\": ");
  write_list(
      table.verdicts(), [](Verdict verdict) { return name_of(verdict); }, sink);
  if (of.target) {
    sink(",\n    \"target\": ");
    write_list(
        of.kinds, [](PlaceKind kind) { return std::string(name_of(kind)); }, sink);
  }
  for (const QuantityInfo& info : quantities()) {
    if (info.kind != QuantityKind::number) continue;
    sink(",\n    \"" + std::string(info.name) + "\": ");
    table.has(info.quantity) ? write_list(table[info.quantity], json_number, sink) : sink("null");
  }
  sink("\n  }");
}

}  // namespace

RowCount work_out(GridTable& table, Progress& progress) {
  const Family family(table.grid);
  const std::size_t rows = table.table.rows();
  AskedOfRows asked;
  if (table.target) {
    table.kinds.assign(rows, PlaceKind::not_known);
    asked = asked_for_kinds(family, table.target, table.kinds);
  }
  asked.columns = columns_of(table.table);
  asked.proved = table.grid.proved;
  return evaluate(family, rows_of(table.grid, 0, rows), asked, progress);
}

void add_borders(GridTable& table, Progress& progress) {
  table.hunting_boundary =
      hunting_boundary(table.grid, table.table[Quantity::growth_at_rest], progress);
  if (progress.go_on(0.0)) table.dissipative_boundary = dissipative_boundary(table.grid, progress);
  const bool wants_regions = table.target || Family(table.grid).engines().search;
  if (!wants_regions || !has_regions(table.grid)) return;
  std::vector<PlaceKind> kinds = table.kinds;
  if (!table.target) {
    for (const Verdict verdict : table.table.verdicts()) kinds.push_back(kind_of(verdict));
  }
  table.regions = regions_of(table.grid, kinds, table.target, progress);
}

std::string certainty_of(const Grid& grid) {
  const EnginesNeeded engines = Family(grid).engines();
  const std::string plastic = name_of(grid.proved ? Certainty::enclosed : Certainty::computed);
  const std::string searched = name_of(Certainty::searched);
  if (engines.search) {
    return engines.solution ? plastic + " in closed form, " + searched + " elsewhere" : searched;
  }
  return engines.bounces ? plastic + " for plastic contact, " + searched + " for restitution > 0"
                         : plastic;
}

Json fixed_parameters(const Grid& grid) {
  Json drive = drive_json(grid.drive);
  for (const Axis& axis : grid.axes) {
    const Parameter* parameter = parameter_of(axis, grid.drive);
    if (parameter != nullptr && axis.path.find('[') == std::string::npos) {
      drive.erase(std::string(parameter->path));
    }
  }
  return drive;
}

void write_grid_csv(const GridTable& table, const TextSink& sink) {
  const std::vector<Axis>& axes = table.grid.axes;
  const std::vector<Quantity> numbers = quantities_of(table.table);
  std::vector<std::string> names;
  for (const Axis& axis : axes) names.push_back(column_name(axis.path));
  names.emplace_back("verdict");
  if (table.target) names.emplace_back("target");
  for (const Quantity quantity : numbers) names.emplace_back(name_of(quantity));
  std::vector<bool> are_words;
  for (const Axis& axis : axes) are_words.push_back(unit_of(axis, table.grid.drive).empty());
  CsvTable csv(sink, names);
  for (std::size_t row = 0; row < table.table.rows(); ++row) {
    const std::vector<double> values = values_at(table.grid, row);
    for (std::size_t i = 0; i < values.size(); ++i) {
      are_words[i] ? csv.cell(text_of(axes[i], table.grid.drive, values[i])) : csv.cell(values[i]);
    }
    csv.cell(name_of(table.table.verdict(row)));
    if (table.target) csv.cell(std::string(name_of(table.kinds[row])));
    for (const Quantity quantity : numbers) csv.cell(table.table[quantity][row]);
    csv.end_row();
  }
}

void write_grid_json(const GridTable& table, const std::string& verb, const TextSink& sink) {
  const Grid& grid = table.grid;
  Json fixed = fixed_parameters(grid);
  Json header = json_head(verb.c_str(), grid.drive, table.provenance);
  Json defaults = Json::array();
  for (const Json& path : header["defaults"]) {
    if (fixed.contains(path.get<std::string>())) defaults.push_back(path);
  }
  header["certainty"] = certainty_of(grid);
  header["drive"] = std::move(fixed);
  header["defaults"] = std::move(defaults);
  header["axes"] = json_axes(grid);
  if (table.target) header["target"] = table.target_text;
  std::string text = header.dump(2);
  text.resize(text.rfind("\n}"));  // reopens the object: the columns follow, number by number
  sink(text + ",\n  \"columns\": ");
  write_columns(table, sink);
  if (table.hunting_boundary) {
    sink(",\n  \"hunting_boundary\": ");
    write_curves(*table.hunting_boundary, sink);
  }
  if (table.dissipative_boundary) {
    sink(",\n  \"dissipative_boundary\": ");
    write_curves(*table.dissipative_boundary, sink);
  }
  if (table.regions) write_regions(*table.regions, sink);
  sink("\n}\n");
}

}  // namespace gearlash
