// What must change: designs, margins, production runs and tuned gains.
#include "gearlash/design.hpp"

#include <pybind11/stl.h>

#include "arrays.hpp"
#include "base/progress_part.hpp"
#include "gearlash/input.hpp"
#include "gearlash/tolerance.hpp"
#include "gearlash/tune.hpp"
#include "input/axis_text.hpp"
#include "interruptible.hpp"
#include "module.hpp"
#include "output/records.hpp"
#include "question/series/tolerance_study.hpp"

namespace gearlash::python {
namespace {

/// One FeasibleValues for each of the parameters: paths, "PATH=FROM:TO:COUNT" or gearlash.Axis.
py::object designed(py::handle drive, py::handle target, const py::object& parameters,
                    const py::object& progress) {
  const Drive of = drive_of(drive);
  const auto limits = from_python<Target>(target, "target");
  std::vector<Axis> axes;
  for (const py::handle& one : parameters) {
    axes.push_back(py::isinstance<py::str>(one)
                       ? read_axis_to_search("parameters", one.cast<std::string>(), of)
                       : from_python<Axis>(one, "parameters"));
  }
  const auto answers = interruptible(progress, [&](Progress& reports) {
    std::vector<FeasibleValues> found;
    while (found.size() < axes.size()) {
      ProgressPart part(reports, found.size(), axes.size());
      if (!part.go_on(0.0)) break;
      found.push_back(values(of, axes[found.size()], limits, part));
    }
    return found;
  });
  return to_python(answers);
}

py::object margin_of(py::handle drive, py::handle axes, const py::object& progress) {
  const Drive of = drive_of(drive);
  const auto list = from_python<std::vector<Axis>>(axes, "axes");
  return to_python(interruptible(progress, [&](Progress& reports) {
    return list.empty() ? margins(of, reports) : margins(of, list, reports);
  }));
}

py::object studied(py::handle series, py::handle sampling, py::handle questions,
                   std::optional<double> error, const py::object& progress) {
  const auto drives = from_python<TolerancedDrive>(series, "series");
  const auto plan = from_python<SamplePlan>(sampling, "sampling");
  const auto asked = from_python<StudyQuestions>(questions, "questions");
  return to_python(interruptible(progress, [&](Progress& reports) {
    return error ? study_tolerances_to(*error, drives, plan, asked, reports)
                 : study_tolerances(drives, plan, asked, reports);
  }));
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

py::object indices(py::handle series, py::handle sampling, py::handle questions,
                   const py::object& progress) {
  const auto drives = from_python<TolerancedDrive>(series, "series");
  const auto plan = from_python<SamplePlan>(sampling, "sampling");
  const auto asked = from_python<StudyQuestions>(questions, "questions");
  return to_python(interruptible(progress, [&](Progress& reports) {
    return study_sensitivities(drives, plan, asked, reports);
  }));
}

py::object widest(py::handle series, py::handle demand, py::handle sampling,
                  const py::object& progress) {
  const auto drives = from_python<TolerancedDrive>(series, "series");
  const auto wanted = from_python<BacklashDemand>(demand, "demand");
  const auto plan = from_python<SamplePlan>(sampling, "sampling");
  return to_python(interruptible(
      progress, [&](Progress& reports) { return widest_backlash(drives, wanted, plan, reports); }));
}

py::object tuned(py::handle task, py::handle effort, const py::object& progress) {
  const auto wanted = from_python<TuneTask>(task, "task");
  const auto most = from_python<TuneEffort>(effort, "effort");
  return to_python(
      interruptible(progress, [&](Progress& reports) { return tune(wanted, most, reports); }));
}

}  // namespace

void add_design(py::module_& module) {
  PYBIND11_NUMPY_DTYPE(detail::SampleResult, growth_at_rest, amplitude, frequency, verdict, meets,
                       refused);
  module.def("target", [](const std::string& text, py::handle drive) {
    return to_python(parse_target(text, drive_of(drive)));
  });
  module.def("design", designed, py::call_guard<LongCall>());
  module.def("usual_parameters",
             [](py::handle drive) { return to_python(usual_parameters(drive_of(drive))); });
  module.def("axis", [](const std::string& text, py::handle drive) {
    return to_python(read_axis_to_search("axis", text, drive_of(drive)));
  });
  module.def("margins", margin_of, py::call_guard<LongCall>());
  module.def("tolerance_study", studied, py::call_guard<LongCall>());
  module.def("answer_samples", answered_samples, py::call_guard<LongCall>());
  module.def("study_of", study_of_samples);
  module.def("sensitivity_indices", indices, py::call_guard<LongCall>());
  module.def("widest_backlash", widest, py::call_guard<LongCall>());
  module.def("sampling_of", [](std::size_t samples, std::uint64_t seed) {
    return to_python(sampling_of(samples, {.seed = seed}));
  });
  module.def("usual_sampling", [](py::handle series, py::handle questions) {
    return to_python(usual_sampling(from_python<TolerancedDrive>(series, "series"),
                                    from_python<StudyQuestions>(questions, "questions")));
  });
  module.def("tune", tuned, py::call_guard<LongCall>());
  module.def("usual_gains",
             [](py::handle drive) { return to_python(usual_gains(drive_of(drive))); });
  module.def("axis_to_tune", [](const std::string& text, py::handle drive) {
    return to_python(read_axis_to_tune("parameters", text, drive_of(drive)));
  });
  module.def("usual_target",
             [](py::handle drive) { return to_python(usual_target(drive_of(drive))); });
  module.def("permits", [](py::handle values, double value) {
    return from_python<FeasibleValues>(values, "values").contains(value);
  });
}

}  // namespace gearlash::python
