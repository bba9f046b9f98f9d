// The thesis of 1960: its program, its table and its figures.
#include <pybind11/stl.h>

#include <cmath>

#include "arrays.hpp"
#include "interruptible.hpp"
#include "module.hpp"
#include "python/inner_records.hpp"
#include "thesis/exact_curve.hpp"
#include "thesis/figures.hpp"
#include "thesis/float_1604.hpp"
#include "thesis/printout.hpp"
#include "thesis/settled_cycle.hpp"
#include "thesis/thesis_machine.hpp"

namespace gearlash::python {
namespace {

using thesis::PrintedLine;
using thesis::ProgramParameters;

NormalizedServo servo_of(double damping, double inertia_ratio, double friction_ratio,
                         double backlash) {
  return {.damping = damping,
          .inertia_ratio = inertia_ratio,
          .friction_ratio = friction_ratio,
          .backlash = backlash};
}

/// Rows of time, motor speed, motor position, load speed, load position.
py::array_t<double> rows_of(const std::vector<PrintedLine>& lines) {
  std::vector<double> numbers;
  for (const PrintedLine& line : lines) {
    numbers.insert(numbers.end(), {line.time, line.motor_speed, line.motor_position,
                                   line.load_speed, line.load_position});
  }
  return array_of(std::move(numbers)).reshape({py::ssize_t(lines.size()), py::ssize_t{5}});
}

std::vector<PrintedLine> lines_of_machine(const ProgramParameters& parameters, std::size_t count,
                                          Progress& reports) {
  thesis::ThesisMachine machine;
  machine.set(parameters);
  std::vector<PrintedLine> lines;
  while (lines.size() < count && reports.go_on(0.0)) lines.push_back(machine.next_line());
  return lines;
}

/// Rows of x and y.
py::array_t<double> rows_of(const std::vector<MapPoint>& points) {
  std::vector<double> numbers;
  for (const MapPoint& point : points) numbers.insert(numbers.end(), {point.x, point.y});
  return array_of(std::move(numbers)).reshape({py::ssize_t(points.size()), py::ssize_t{2}});
}

py::array_t<double> printed(std::size_t lines, const py::object& servo, py::handle machine) {
  const auto emulated = from_python<bool>(machine, "machine");
  ProgramParameters parameters = thesis::listed_parameters;
  if (!servo.is_none()) {
    const auto [damping, inertia_ratio, friction_ratio, backlash] =
        servo.cast<std::tuple<double, double, double, double>>();
    parameters =
        thesis::program_parameters(servo_of(damping, inertia_ratio, friction_ratio, backlash));
  }
  return rows_of(interruptible(py::none(), [&](Progress& reports) {
    return emulated ? lines_of_machine(parameters, lines, reports)
                    : thesis::printout<double>(parameters, lines);
  }));
}

py::array_t<double> table_2() {
  std::vector<double> numbers;
  for (const thesis::PrintedRow& row : thesis::thesis_table_2()) {
    for (const thesis::PrintedNumber& number : row) {
      numbers.push_back(number.digits * std::pow(10.0, number.exponent - 8));
    }
  }
  return array_of(std::move(numbers)).reshape({py::ssize_t{-1}, py::ssize_t{5}});
}

py::object run(double damping, double inertia_ratio, double friction_ratio, double backlash,
               py::handle machine) {
  const auto emulated = from_python<bool>(machine, "machine");
  const ProgramParameters parameters =
      thesis::program_parameters(servo_of(damping, inertia_ratio, friction_ratio, backlash));
  return to_python(interruptible(py::none(), [&](Progress& reports) {
    return emulated ? thesis::run_machine_until_settled(parameters, reports).cycle
                    : thesis::run_until_settled(parameters, {}, reports);
  }));
}

py::list figures() {
  using namespace py::literals;
  py::list list;
  for (const thesis::Figure& figure : thesis::thesis_figures()) {
    py::list curves;
    for (const thesis::FigureCurve& curve : figure.curves) {
      const NamedCurve done = interruptible(
          py::none(), [&](Progress& reports) { return work_out(figure, curve, reports); });
      curves.append(py::dict("name"_a = curve.name, "exact"_a = rows_of(done.line),
                             "program"_a = rows_of(done.marks)));
    }
    list.append(
        py::dict("number"_a = figure.number, "caption"_a = figure.caption, "curves"_a = curves));
  }
  return list;
}

}  // namespace

void add_thesis(py::module_& module) {
  module.def("thesis_printout", printed, py::call_guard<LongCall>());
  module.def("thesis_table_2", table_2);
  module.def("thesis_run", run, py::call_guard<LongCall>());
  module.def("thesis_figures", figures, py::call_guard<LongCall>());
}

}  // namespace gearlash::python
