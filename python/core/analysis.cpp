// Answers: their numbers, their text, and derivatives.
#include <pybind11/complex.h>
#include <pybind11/stl.h>

#include <complex>

#include "arrays.hpp"
#include "base/range_check.hpp"
#include "define.hpp"
#include "gearlash/analyse.hpp"
#include "gearlash/comparison.hpp"
#include "gearlash/grid.hpp"
#include "gearlash/input.hpp"
#include "gearlash/output.hpp"
#include "gearlash/sensitivity.hpp"
#include "module.hpp"
#include "output/comparison_report.hpp"
#include "output/describe_report.hpp"
#include "output/records.hpp"
#include "question/loop/describing/describing_function.hpp"

namespace gearlash::python {
namespace {

/// JSON and text of one report.
using Written = std::vector<std::string>;

Written described(Progress& reports, const Drive& drive) {
  const DescribeReport report =
      describe_report_of(drive, analyse(drive, {.ceiling = true, .causes = true}, reports));
  return {describe_json(report), describe_text(report)};
}

/// Without values of an axis: drives with names.
py::object compared(const std::vector<std::pair<std::string, py::object>>& named,
                    const py::object& axis, const py::object& quantities,
                    std::optional<double> step, std::optional<double> until,
                    const py::object& progress) {
  ComparisonReport report;
  std::vector<NamedDrive> drives;
  for (const auto& [name, drive] : named) drives.push_back({name, drive_of(drive)});
  if (!axis.is_none()) {
    report.axis = from_python<Axis>(axis, "axis");
    const Drive base = drives.front().drive;
    require_none(faults(Grid{.drive = base, .axes = {*report.axis}}, {report.axis->path}));
    drives = named_along(*report.axis, base);
  }
  const auto asked = from_python<std::vector<Quantity>>(quantities, "quantities");
  if (!asked.empty()) report.quantities = asked;
  return to_python(interruptible(progress, [&](Progress& reports) {
    report.drives = compare(drives, {.step = step, .until = until}, reports);
    return Written{comparison_json(report), comparison_text(report)};
  }));
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
  define(
      module, "analyse",
      [](Progress& reports, const Drive& drive, const Wanted& wanted) {
        return analyse(drive, wanted, reports);
      },
      "drive", "wanted");
  define(
      module, "derivatives",
      [](Progress& reports, const Drive& drive, const std::vector<Quantity>& quantities,
         const std::vector<std::string>& paths) {
        const std::vector<std::string_view> views(paths.begin(), paths.end());
        return derivatives(drive, quantities, views, reports);
      },
      "drive", "quantities", "parameters");
  define(module, "describe", described, "drive");
  module.def("compare", compared, py::call_guard<LongCall>());
  module.def("describing_gain", gains);
  define(
      module, "hunts", [](Verdict verdict) { return hunts(verdict); }, "verdict");
  define(
      module, "largest_stable",
      [](const Answer& answer) {
        const Cycle* cycle = answer.largest_stable();
        return cycle == nullptr ? std::nullopt : std::optional(*cycle);
      },
      "answer");
  define(module, "slope", &Jacobian::slope, "jacobian", "quantity", "parameter");
  define(module, "elasticity", &Jacobian::elasticity, "jacobian", "quantity", "parameter");
  define(
      module, "fault_text", [](const Fault& fault) { return to_string(fault); }, "fault");
  define(module, "value", &Answer::value, "answer", "quantity");
  define(
      module, "headline",
      [](const Drive& drive, const Answer& answer) { return headline(drive, answer); }, "drive",
      "answer");
  define(
      module, "to_text",
      [](const Drive& drive, const Answer& answer) { return to_text(drive, answer); }, "drive",
      "answer");
  define(
      module, "to_json",
      [](const Drive& drive, const Answer& answer) { return to_json(drive, answer); }, "drive",
      "answer");
  define(module, "widest_backlash_of_ceiling", &Ceiling::widest_backlash, "ceiling", "amplitude",
         "backlash");
}

}  // namespace gearlash::python
