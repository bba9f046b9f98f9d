#include "output/grid_table.hpp"

#include <algorithm>

#include "base/lists.hpp"
#include "output/csv_table.hpp"
#include "question/map/hunting_boundary.hpp"

namespace gearlash {
namespace {

GridAxis document_of(const Axis& axis, const Drive& drive) {
  GridAxis shown{
      .path = axis.path, .unit = unit_of(axis, drive), .is_logarithmic = axis.logarithmic};
  for (const double value : axis.values) {
    shown.unit.empty() ? shown.values.emplace_back(text_of(axis, drive, value))
                       : shown.values.emplace_back(value);
  }
  return shown;
}

std::vector<Quantity> quantities_of(const Table& table) {
  std::vector<Quantity> found;
  for (const QuantityInfo& info : quantities()) {
    const bool is_number = info.kind == QuantityKind::number;
    if (is_number && table.has(info.quantity)) found.push_back(info.quantity);
  }
  return found;
}

}  // namespace

RowCount work_out(GridTable& table, Progress& progress) {
  const Family family(table.grid);
  const std::size_t rows = table.table.rows();
  AskedOfRows asked;
  if (table.target) {
    table.kinds.assign(rows, PlaceKind::not_known);
    asked = asked_for_kinds(table.target, table.kinds);
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
  if (wants_regions && has_regions(table.grid)) table.regions = regions_of(table, progress);
}

std::vector<MapRegion> regions_of(const GridTable& table, Progress& progress) {
  std::vector<PlaceKind> kinds = table.kinds;
  if (!table.target) {
    for (const Verdict verdict : table.table.verdicts()) kinds.push_back(kind_of(verdict));
  }
  return regions_of(table.grid, kinds, table.target, progress);
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

ByName<ParameterValue> fixed_parameters(const Grid& grid) {
  ByName<ParameterValue> values = parameter_values(grid.drive);
  for (const Axis& axis : grid.axes) {
    const Parameter* parameter = parameter_of(axis, grid.drive);
    if (parameter == nullptr || axis.path.find('[') != std::string::npos) continue;
    std::erase_if(values, [&](const auto& one) { return one.first == parameter->path; });
  }
  return values;
}

void write_grid_csv(const GridTable& table, const TextSink& sink) {
  const std::vector<Axis>& axes = table.grid.axes;
  const std::vector<Quantity> numbers = quantities_of(table.table);
  auto names = of_each(axes, [&](const Axis& axis) {
    return column_in(unit_of(axis, table.grid.drive), column_name(axis.path));
  });
  names.emplace_back("verdict");
  if (table.target) names.emplace_back("target");
  for (const Quantity quantity : numbers) {
    names.push_back(column_in(info_of(quantity).unit, std::string(name_of(quantity))));
  }
  const auto are_words =
      of_each(axes, [&](const Axis& axis) { return unit_of(axis, table.grid.drive).empty(); });
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

GridDocument document_of(const GridTable& of) {
  const Grid& grid = of.grid;
  GridDocument document{.certainty = certainty_of(grid),
                        .drive = fixed_parameters(grid),
                        .target_text = of.target_text,
                        .verdicts = of.table.verdicts(),
                        .kinds = of.kinds,
                        .hunting_boundary = of.hunting_boundary,
                        .dissipative_boundary = of.dissipative_boundary,
                        .regions = of.regions,
                        .provenance = of.provenance};
  for (const Axis& axis : grid.axes) document.axes.push_back(document_of(axis, grid.drive));
  for (const std::string& path : defaults_taken(grid.drive)) {
    const auto has_path = [&](const auto& one) { return one.first == path; };
    if (any_of(document.drive, has_path)) document.defaults.push_back(path);
  }
  for (const Quantity quantity : quantities_of(of.table)) {
    document.columns.emplace_back(name_of(quantity), of.table[quantity]);
  }
  return document;
}

}  // namespace gearlash
