// Motions: samples as arrays over the vectors of C++, events as columns.
#include <pybind11/stl.h>

#include "arrays.hpp"
#include "gearlash/motion.hpp"
#include "interruptible.hpp"
#include "module.hpp"
#include "output/records.hpp"

namespace gearlash::python {
namespace {

Motion simulated(py::handle drive, double until, py::handle start, std::size_t most_events,
                 const py::object& progress) {
  const Drive of = drive_of(drive);
  const Span span{.until = until,
                  .start = from_python<std::optional<Start>>(start, "start"),
                  .most_events = most_events};
  return interruptible(progress, [&](Progress& reports) { return simulate(of, span, reports); });
}

py::dict columns_of_samples(Samples samples) {
  py::dict columns;
  const auto add = [&](const auto& member) {
    columns[member.name] = array_of(std::move(samples.*(member.place)));
  };
  std::apply([&](const auto&... member) { (add(member), ...); }, Record<Samples>::members);
  return columns;
}

py::dict sampled(const Motion& motion, double every) {
  return columns_of_samples(
      interruptible(py::none(), [&](Progress& reports) { return motion.sampled(every, reports); }));
}

py::dict at(const Motion& motion, const Numbers& times) {
  const std::span<const double> given(times.data(), static_cast<std::size_t>(times.size()));
  return columns_of_samples(
      interruptible(py::none(), [&](Progress& reports) { return motion.at(given, reports); }));
}

/// One tuple for each event, in the order of names_of_leaves().
py::list events(const Motion& motion) {
  py::list rows;
  for (const MotionEvent& event : motion.events()) {
    py::list row;
    records::for_each_leaf(
        event, [&](const auto&, const char*, const auto& value) { row.append(to_python(value)); });
    rows.append(py::tuple(row));
  }
  return rows;
}

py::list names_of_leaves() {
  py::list names;
  records::for_each_leaf(MotionEvent{}, [&](const auto& member, const char* holder, const auto&) {
    names.append(leaf_name(member, holder));
  });
  return names;
}

std::vector<std::string> modes_at(const Motion& motion, const Numbers& times) {
  std::vector<std::string> modes;
  for (py::ssize_t i = 0; i < times.size(); ++i) {
    modes.emplace_back(motion.at(times.data()[i]).mode);
  }
  return modes;
}

}  // namespace

void add_motions(py::module_& module) {
  py::class_<Motion>(module, "Motion")
      .def("sampled", sampled, py::call_guard<LongCall>())
      .def("at", at, py::call_guard<LongCall>())
      .def("modes_at", modes_at)
      .def("events", events)
      .def("touches", [](const Motion& motion) { return to_python(motion.touches()); })
      .def("energy", [](const Motion& motion) { return to_python(motion.energy()); })
      .def_property_readonly("end_time", &Motion::end_time)
      .def_property_readonly("stop", [](const Motion& motion) { return to_python(motion.stop()); })
      .def_property_readonly("stop_text", &Motion::stop_text)
      .def_property_readonly("engine",
                             [](const Motion& motion) { return to_python(motion.engine()); });
  module.attr("FIELDS_OF_EVENTS") = names_of_leaves();
  module.def("simulate", simulated, py::call_guard<LongCall>());
}

}  // namespace gearlash::python
