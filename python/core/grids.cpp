// Many drives at once: grids and lists, with their columns as arrays without copies.
#include <pybind11/stl.h>

#include "arrays.hpp"
#include "base/lists.hpp"
#include "base/overloaded.hpp"
#include "define.hpp"
#include "gearlash/fault.hpp"
#include "gearlash/grid.hpp"
#include "gearlash/input.hpp"
#include "gearlash/version.hpp"
#include "module.hpp"
#include "output/grid_description.hpp"
#include "output/records.hpp"
#include "question/axis.hpp"
#include "question/family/family.hpp"

namespace gearlash::python {
namespace {

std::vector<Quantity> quantities_named(py::handle names) {
  std::vector<Quantity> list;
  std::vector<Fault> unknown;
  for (const auto& name : from_python<std::vector<std::string>>(names, "quantities")) {
    const std::optional<Quantity> quantity = find_quantity(name);
    if (quantity) list.push_back(*quantity);
    if (!quantity)
      unknown.push_back({"quantities", name, "must be names of gearlash.quantities()"});
  }
  if (!unknown.empty()) throw InvalidInput(unknown);
  return list;
}

/// The verdicts' numbers, and the columns by name.
py::tuple columns_of_table(Table&& computed, const std::vector<Quantity>& quantities) {
  const auto table = std::make_shared<const Table>(std::move(computed));
  static_assert(sizeof(Verdict) == sizeof(std::int8_t));
  // As a signed byte, which is what NetCDF has.
  const auto verdicts = array_over(reinterpret_cast<const std::int8_t*>(table->verdicts().data()),
                                   table->rows(), table);
  py::dict columns;
  for (const Quantity quantity : quantities) {
    const std::span<const double> column = (*table)[quantity];
    columns[py::str(std::string(name_of(quantity)))] =
        array_over(column.data(), column.size(), table);
  }
  return py::make_tuple(verdicts, columns);
}

Grid grid_of(py::handle drive, py::handle axes, bool proved = false) {
  return {.drive = drive_of(drive),
          .axes = from_python<std::vector<Axis>>(axes, "axes"),
          .proved = proved};
}

py::tuple evaluated_grid(py::handle drive, py::handle axes, py::handle names, py::handle proved,
                         const py::object& progress) {
  const std::vector<Quantity> quantities = quantities_named(names);
  const Grid grid = grid_of(drive, axes, from_python<bool>(proved, "proved"));
  return columns_of_table(
      interruptible(progress,
                    [&](Progress& reports) { return evaluate(grid, quantities, reports); }),
      quantities);
}

py::tuple evaluated_list(py::handle drive, const std::vector<std::string>& paths,
                         const std::vector<Numbers>& values, py::handle names,
                         const py::object& progress) {
  const std::vector<Quantity> quantities = quantities_named(names);
  DriveList list{.drive = drive_of(drive), .paths = paths};
  for (const Numbers& column : values) {
    list.values.emplace_back(column.data(), static_cast<std::size_t>(column.size()));
  }
  return columns_of_table(
      interruptible(progress,
                    [&](Progress& reports) { return evaluate(list, quantities, reports); }),
      quantities);
}

py::dict dict_of(const std::vector<NetcdfAttribute>& attributes) {
  py::dict dict;
  for (const NetcdfAttribute& attribute : attributes) {
    dict[py::str(attribute.name)] = std::visit(
        Overloaded{[](const std::vector<signed char>& flags) -> py::object {
                     return array_of(std::vector<std::int8_t>(flags.begin(), flags.end()));
                   },
                   [](const auto& value) { return to_python(value); }},
        attribute.value);
  }
  return dict;
}

/// What the tool's NetCDF files say of the grid: its attributes, and for each variable its
/// dimensions, attributes and values, if it has them.
py::tuple description(py::handle drive, py::handle axes, py::handle names, bool proved) {
  const NetcdfDescription of = description_of({.grid = grid_of(drive, axes, proved),
                                               .quantities = quantities_named(names),
                                               .provenance = {"gearlash.sweep", version}},
                                              {});
  py::dict variables;
  for (const NetcdfVariable& variable : of.variables) {
    const auto dimensions =
        of_each(variable.dimensions, [&](std::size_t index) { return of.dimensions[index].name; });
    variables[py::str(variable.name)] = py::make_tuple(
        to_python(dimensions), dict_of(variable.attributes), array_of(variable.values));
  }
  return py::make_tuple(dict_of(of.attributes), variables);
}

}  // namespace

void add_grids(py::module_& module) {
  module.def("evaluate_grid", evaluated_grid, py::call_guard<LongCall>());
  module.def("evaluate_list", evaluated_list, py::call_guard<LongCall>());
  module.def("check_grid", [](py::handle drive, py::handle axes, py::handle names) {
    (void)quantities_named(names);
    require_none(faults(grid_of(drive, axes)));
  });
  module.def("is_closed_grid", [](py::handle drive, py::handle axes) {
    return !Family(grid_of(drive, axes)).engines().search;
  });
  module.def("description", description);
  define(module, "path_named", path_named, "name", "drive");
  define(module, "linear", linear, "path", "start", "stop", "count");
  define(module, "logarithmic", logarithmic, "path", "start", "stop", "count");
  module.def("read_axis", [](const std::string& path, const std::string& values, py::handle drive) {
    return to_python(read_axis({path, path, values}, drive_of(drive)));
  });
  module.def("drive_of_axes", [](py::handle drive,
                                 const std::vector<std::pair<std::string, std::string>>& axes) {
    const auto text_of = [](const auto& one) { return AxisText{one.first, one.first, one.second}; };
    return drive_to_python(drive_of_axes(drive_of(drive), of_each(axes, text_of)));
  });
}

}  // namespace gearlash::python
