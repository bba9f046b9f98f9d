// What must change: designs, margins, production runs and tuned gains.
#include "gearlash/design.hpp"

#include <pybind11/stl.h>

#include "arrays.hpp"
#include "base/progress_part.hpp"
#include "define.hpp"
#include "gearlash/input.hpp"
#include "gearlash/tolerance.hpp"
#include "gearlash/tune.hpp"
#include "module.hpp"
#include "output/records.hpp"
#include "question/series/tolerance_study.hpp"

namespace gearlash::python {
namespace {

std::vector<FeasibleValues> designed(Progress& reports, const Drive& drive, const Target& target,
                                     const std::vector<Axis>& axes) {
  std::vector<FeasibleValues> found;
  while (found.size() < axes.size()) {
    ProgressPart part(reports, found.size(), axes.size());
    if (!part.go_on(0.0)) break;
    found.push_back(values(drive, axes[found.size()], target, part));
  }
  return found;
}

HuntingMargin margin_of(Progress& reports, const Drive& drive, const std::vector<Axis>& axes) {
  return margins(drive, axes, reports);
}

ToleranceStudy studied(Progress& reports, const TolerancedDrive& series, const SamplePlan& sampling,
                       const StudyQuestions& questions, std::optional<double> error) {
  return error ? study_tolerances_to(*error, series, sampling, questions, reports)
               : study_tolerances(series, sampling, questions, reports);
}

/// What samples do, as an array of records, for pieces of a study.
py::object answered_samples(py::handle series, py::handle sampling, py::handle questions,
                            std::size_t first, std::size_t count, const py::object& progress) {
  const auto drives = from_python<TolerancedDrive>(series, "series");
  const auto plan = from_python<SamplePlan>(sampling, "sampling");
  const auto asked = from_python<StudyQuestions>(questions, "questions");
  auto results = interruptible(progress, [&](Progress& reports) {
    return answer_samples(drives, plan, asked, first, count, {}, reports);
  });
  return results ? py::object(array_of(std::move(*results))) : py::none();
}

using SampleRecords = py::array_t<detail::SampleResult, py::array::c_style | py::array::forcecast>;

py::object study_of_samples(py::handle sampling, py::handle questions,
                            const SampleRecords& records) {
  const std::span results(records.data(), static_cast<std::size_t>(records.size()));
  for (const detail::SampleResult& one : results) {
    if (static_cast<std::size_t>(one.verdict) >= std::size(Words<Verdict>::all)) {
      throw py::value_error("unknown verdict");
    }
  }
  return to_python(study_of(from_python<SamplePlan>(sampling, "sampling"),
                            from_python<StudyQuestions>(questions, "questions"), results));
}

}  // namespace

void add_design(py::module_& module) {
  PYBIND11_NUMPY_DTYPE(detail::SampleResult, growth_at_rest, amplitude, frequency, error, verdict,
                       meets, refused);
  define(
      module, "target",
      [](const std::string& text, const Drive& drive) { return parse_target(text, drive); },
      "target", "drive");
  define(module, "design", designed, "drive", "target", "parameters");
  define(module, "usual_parameters", usual_parameters, "drive");
  define(
      module, "axis",
      [](const std::string& name, const std::string& text, const Drive& drive) {
        return read_axis_to_search(name, text, drive);
      },
      "name", "axis", "drive");
  define(module, "margins", margin_of, "drive", "axes");
  define(module, "tolerance_study", studied, "series", "sampling", "questions", "error");
  module.def("answer_samples", answered_samples, py::call_guard<LongCall>());
  module.def("study_of", study_of_samples);
  define(
      module, "sensitivity_indices",
      [](Progress& reports, const TolerancedDrive& series, const SamplePlan& sampling,
         const StudyQuestions& questions) {
        return study_sensitivities(series, sampling, questions, reports);
      },
      "series", "sampling", "questions");
  define(
      module, "widest_backlash",
      [](Progress& reports, const TolerancedDrive& series, const BacklashDemand& demand,
         const SamplePlan& sampling) { return widest_backlash(series, demand, sampling, reports); },
      "series", "demand", "sampling");
  define(
      module, "sampling_of",
      [](std::size_t samples, std::uint64_t seed) { return sampling_of(samples, {.seed = seed}); },
      "samples", "seed");
  define(module, "usual_sampling", usual_sampling, "series", "questions");
  define(
      module, "tune",
      [](Progress& reports, const TuneTask& task, const TuneEffort& effort) {
        return tune(task, effort, reports);
      },
      "task", "effort");
  define(module, "usual_gains", usual_gains, "drive");
  define(
      module, "axis_to_tune",
      [](const std::string& text, const Drive& drive) {
        return read_axis_to_tune("parameters", text, drive);
      },
      "parameters", "drive");
  define(module, "usual_target", usual_target, "drive");
  define(module, "permits", &FeasibleValues::contains, "values", "value");
}

}  // namespace gearlash::python
