// Plots, for what draws them in Python.
#include "define.hpp"
#include "gearlash/picture.hpp"
#include "module.hpp"
#include "output/records.hpp"
#include "thesis/figures.hpp"

namespace gearlash::python {

void add_plots(py::module_& module) {
  define(
      module, "picture_of",
      [](Progress& reports, const PictureQuestion& question) {
        return picture_of(question, reports);
      },
      "question");
  module.def("time_plot", [](const Motion& motion, py::handle drive, const std::string& unit) {
    return to_python(time_plot(drive_of(drive), motion, unit));
  });
  module.def("phase_plot",
             [](const Motion& motion, py::handle drive, const std::string& unit, double from) {
               return to_python(phase_plot(drive_of(drive), motion, unit, from));
             });
  define(
      module, "tolerance_plot",
      [](PictureKind kind, const ToleranceStudy& study, const std::string& unit) {
        return tolerance_plot(kind, study, unit);
      },
      "kind", "study", "unit");
  define(
      module, "indices_plot",
      [](const ToleranceStudy& study, const SensitivityStudy& indices) {
        return indices_plot(study, indices);
      },
      "study", "indices");
  define(
      module, "figure_plot",
      [](Progress& reports, int number) { return thesis::figure_plot(number, reports); }, "number");
}

}  // namespace gearlash::python
