// gearlash._core: the C++ library for the Python package beside it, which has the documentation.
#include "module.hpp"

#include <functional>

#include "gearlash/fault.hpp"
#include "gearlash/version.hpp"
#include "interruptible.hpp"
#include "output/records.hpp"
#include "record.hpp"

namespace gearlash::python {
namespace {

/// {"Verdict": ("cannot hunt", …), …}
py::dict words() {
  py::dict all;
  records::for_each_enumeration([&]<class Enumeration>(const Enumeration*) {
    py::list list;
    for (const auto& word : Words<Enumeration>::all) {
      list.append(Words<Enumeration>::named(word.value));
    }
    all[Words<Enumeration>::name] = py::tuple(list);
  });
  return all;
}

/// {"Start": Start(), …} with the defaults of C++.
py::dict default_records() {
  py::dict all;
  records::for_each_record(
      [&]<class Struct>(const Struct*) { all[Record<Struct>::name] = to_python(Struct{}); });
  return all;
}

/// The record as it comes back from C++.
py::object there_and_back(py::handle record) {
  py::object back;
  records::for_each_record([&]<class Struct>(const Struct*) {
    if (!back && py::isinstance(record, class_named(Record<Struct>::name))) {
      back = to_python(from_python<Struct>(record, "record"));
    }
  });
  return back;
}

/// What a record of C++ computes under that name.
py::object computed(py::handle record, const std::string& name) {
  py::object found;
  records::for_each_record([&]<class Struct>(const Struct*) {
    if (found || !py::isinstance(record, class_named(Record<Struct>::name))) return;
    const auto value = from_python<Struct>(record, "record");
    const auto compute = [&](const auto& member) {
      if (member.name == name) found = to_python(std::invoke(member.place, value));
    };
    std::apply([&](const auto&... member) { (compute(member), ...); }, Record<Struct>::computed);
  });
  return found;
}

// The parameter has the type that pybind11 demands.
// NOLINTNEXTLINE(performance-unnecessary-value-param)
void translate(std::exception_ptr raised) {
  try {
    if (raised) std::rethrow_exception(raised);
  } catch (const InvalidInput& error) {
    const py::object type = py::module_::import("gearlash._errors").attr("InvalidInput");
    PyErr_SetObject(type.ptr(), type(to_python(error.faults())).ptr());
  }
}

}  // namespace
}  // namespace gearlash::python

PYBIND11_MODULE(_core, module) {
  namespace python = gearlash::python;
  pybind11::register_exception_translator(python::translate);
  module.attr("__version__") = gearlash::version;
  module.def("words", python::words);
  module.def("default_records", python::default_records);
  module.def("there_and_back", python::there_and_back, pybind11::arg("record"));
  module.def("computed", python::computed);
  pybind11::module_::import("atexit").attr("register")(
      pybind11::cpp_function(python::stop_calls_at_exit));
  python::add_drives(module);
  python::add_analysis(module);
  python::add_motions(module);
  python::add_grids(module);
  python::add_design(module);
  python::add_plots(module);
  python::add_thesis(module);
}
