// Many drives at once: grids and lists, with their columns as arrays without copies.
#include <pybind11/stl.h>

#include "analysis/grid/grid_points.hpp"
#include "arrays.hpp"
#include "gearlash/grid.hpp"
#include "input/axis_text.hpp"
#include "interruptible.hpp"
#include "module.hpp"
#include "records.hpp"

namespace gearlash::python {
namespace {

std::vector<Quantity> quantities_named(const std::vector<std::string>& names) {
  std::vector<Quantity> list;
  std::vector<Fault> unknown;
  for (const std::string& name : names) {
    const std::optional<Quantity> quantity = find_quantity(name);
    if (quantity) list.push_back(*quantity);
    if (!quantity)
      unknown.push_back({"quantities", name, "must be names of gearlash.quantities()", ""});
  }
  if (!unknown.empty()) throw InvalidInput(unknown);
  return list;
}

/// The verdicts' numbers, and the columns by name.
py::tuple columns_of_table(Table&& computed, const std::vector<Quantity>& quantities) {
  const auto table = std::make_shared<const Table>(std::move(computed));
  static_assert(sizeof(Verdict) == sizeof(std::uint8_t));
  const auto verdicts = array_over(reinterpret_cast<const std::uint8_t*>(table->verdicts().data()),
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

py::tuple evaluated_grid(py::handle drive, py::handle axes, const std::vector<std::string>& names,
                         bool proved, const py::object& progress) {
  const std::vector<Quantity> quantities = quantities_named(names);
  const Grid grid = grid_of(drive, axes, proved);
  return columns_of_table(
      interruptible(progress,
                    [&](Progress& reports) { return evaluate(grid, quantities, reports); }),
      quantities);
}

py::tuple evaluated_list(py::handle drive, const std::vector<std::string>& paths,
                         const std::vector<Numbers>& values, const std::vector<std::string>& names,
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

}  // namespace

void add_grids(py::module_& module) {
  module.def("evaluate_grid", evaluated_grid);
  module.def("evaluate_list", evaluated_list);
  module.def("check_grid",
             [](py::handle drive, py::handle axes, const std::vector<std::string>& names) {
               (void)quantities_named(names);
               const std::vector<Fault> found = faults(grid_of(drive, axes));
               if (!found.empty()) throw InvalidInput(found);
             });
  module.def("is_closed_grid", [](py::handle drive, py::handle axes) {
    return !GridPoints(grid_of(drive, axes)).engines().search;
  });
  module.def("linear", [](const std::string& path, double from, double to, std::size_t count) {
    return to_python(linear(path, from, to, count));
  });
  module.def("logarithmic", [](const std::string& path, double from, double to, std::size_t count) {
    return to_python(logarithmic(path, from, to, count));
  });
  module.def("read_axis", [](const std::string& path, const std::string& values, py::handle drive) {
    return to_python(read_axis({path, path, values}, drive_of(drive)));
  });
}

}  // namespace gearlash::python
