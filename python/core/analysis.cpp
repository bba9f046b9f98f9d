// Answers: their numbers, their text, and derivatives.
#include <pybind11/complex.h>
#include <pybind11/stl.h>

#include <complex>

#include "arrays.hpp"
#include "base/range_check.hpp"
#include "gearlash/analyse.hpp"
#include "gearlash/comparison.hpp"
#include "gearlash/grid.hpp"
#include "gearlash/input.hpp"
#include "gearlash/output.hpp"
#include "gearlash/sensitivity.hpp"
#include "input/drive_file.hpp"
#include "interruptible.hpp"
#include "module.hpp"
#include "output/comparison_report.hpp"
#include "output/describe_report.hpp"
#include "output/records.hpp"
#include "question/loop/describing/describing_function.hpp"

namespace gearlash::python {
namespace {

py::object analysed(py::handle drive, py::handle wanted, const py::object& progress) {
  const Drive of = drive_of(drive);
  const auto questions = from_python<Wanted>(wanted, "wanted");
  return to_python(
      interruptible(progress, [&](Progress& reports) { return analyse(of, questions, reports); }));
}

Answer answer_from(py::handle answer) { return from_python<Answer>(answer, "answer"); }

std::vector<Quantity> quantities_of(const std::vector<std::string>& names) {
  std::vector<Quantity> quantities;
  for (const std::string& name : names) {
    quantities.push_back(from_python<Quantity>(py::str(name), "quantities"));
  }
  return quantities;
}

py::object derivatives_of(py::handle drive, const std::vector<std::string>& names,
                          const std::vector<std::string>& paths, const py::object& progress) {
  const std::vector<Quantity> quantities = quantities_of(names);
  const std::vector<std::string_view> views(paths.begin(), paths.end());
  const Drive of = drive_of(drive);
  return to_python(interruptible(
      progress, [&](Progress& reports) { return derivatives(of, quantities, views, reports); }));
}

/// JSON and text of one report.
struct Written {
  std::string json;
  std::string text;
};

py::tuple described(py::handle drive, const py::object& progress) {
  const Drive of = drive_of(drive);
  const Written written = interruptible(progress, [&](Progress& reports) {
    const DescribeReport report =
        describe_report_of(of, analyse(of, {.ceiling = true, .quantization = true}, reports));
    return Written{describe_json(report), describe_text(report)};
  });
  return py::make_tuple(written.json, written.text);
}

/// Without values of an axis: drives with names.
py::tuple compared(const std::vector<std::pair<std::string, py::object>>& named,
                   const py::object& axis, const std::vector<std::string>& quantities,
                   std::optional<double> step, std::optional<double> until,
                   const py::object& progress) {
  ComparisonReport report;
  std::vector<NamedDrive> drives;
  for (const auto& [name, drive] : named) drives.push_back({name, drive_of(drive)});
  if (!axis.is_none()) {
    report.axis = from_python<Axis>(axis, "axis");
    const Drive base = drives.front().drive;
    require_none(faults(Grid{.drive = base, .axes = {*report.axis}}, {report.axis->path}));
    drives = drives_along(*report.axis, base, {});
  }
  if (!quantities.empty()) report.quantities = quantities_of(quantities);
  report.angles.resize(drives.size());
  const Written written = interruptible(progress, [&](Progress& reports) {
    report.drives = compare(drives, {.step = step, .until = until}, reports);
    return Written{comparison_json(report), comparison_text(report)};
  });
  return py::make_tuple(written.json, written.text);
}

/// Gains of the gap that inertia drives.
py::array_t<std::complex<double>> gains(double gap, const Numbers& amplitudes) {
  RangeCheck check;
  check.not_negative("gap", gap, "rad");
  for (py::ssize_t i = 0; i < amplitudes.size(); ++i) {
    check.positive("amplitude", amplitudes.data()[i], "rad");
  }
  require_none(check.faults());
  std::vector<std::complex<double>> list;
  for (py::ssize_t i = 0; i < amplitudes.size(); ++i) {
    list.push_back(describing_gain(InertiaControlledBacklash{.gap = gap}, amplitudes.data()[i]));
  }
  return array_of(std::move(list));
}

}  // namespace

void add_analysis(py::module_& module) {
  module.def("analyse", analysed, py::call_guard<LongCall>());
  module.def("derivatives", derivatives_of, py::call_guard<LongCall>());
  module.def("describe", described, py::call_guard<LongCall>());
  module.def("compare", compared, py::call_guard<LongCall>());
  module.def("describing_gain", gains);
  module.def("hunts", [](const std::string& verdict) {
    return hunts(from_python<Verdict>(py::str(verdict), "verdict"));
  });
  module.def("largest_stable", [](py::handle answer) {
    const Answer given = answer_from(answer);
    const Cycle* cycle = given.largest_stable();
    return cycle == nullptr ? py::object(py::none()) : to_python(*cycle);
  });
  module.def("slope", [](py::handle jacobian, std::size_t quantity, std::size_t parameter) {
    return to_python(from_python<Jacobian>(jacobian, "jacobian").slope(quantity, parameter));
  });
  module.def("elasticity", [](py::handle jacobian, std::size_t quantity, std::size_t parameter) {
    return to_python(from_python<Jacobian>(jacobian, "jacobian").elasticity(quantity, parameter));
  });
  module.def("fault_text",
             [](py::handle fault) { return to_string(from_python<Fault>(fault, "fault")); });
  module.def("value", [](py::handle answer, const std::string& quantity) {
    return to_python(
        answer_from(answer).value(from_python<Quantity>(py::str(quantity), "quantity")));
  });
  module.def("headline", [](py::handle drive, py::handle answer) {
    return headline(drive_of(drive), answer_from(answer));
  });
  module.def("to_text", [](py::handle drive, py::handle answer) {
    return to_text(drive_of(drive), answer_from(answer));
  });
  module.def("to_json", [](py::handle drive, py::handle answer) {
    return to_json(drive_of(drive), answer_from(answer));
  });
  module.def("widest_backlash_of_ceiling", [](py::handle ceiling, double amplitude,
                                              double backlash) {
    return to_python(from_python<Ceiling>(ceiling, "ceiling").widest_backlash(amplitude, backlash));
  });
}

}  // namespace gearlash::python
