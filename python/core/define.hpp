// Functions of the module, whose arguments and results are values of C++.
#pragma once

#include <functional>
#include <tuple>
#include <type_traits>

#include "interruptible.hpp"
#include "record.hpp"

namespace gearlash::python {

template <class>
using Handle = py::handle;
/// What an argument is kept as.
template <class Given>
using Held = std::conditional_t<std::is_same_v<std::decay_t<Given>, std::string_view>, std::string,
                                std::decay_t<Given>>;

template <class Result, class... Given, class... Names>
void define_as(py::module_& module, const char* name, std::function<Result(Given...)> work,
               Names... names) {
  module.def(name, [=](Handle<Given>... given) {
    return to_python(work(from_python<Held<Given>>(given, names)...));
  });
}

template <class Result, class... Given, class... Names>
void define_as(py::module_& module, const char* name,
               std::function<Result(Progress&, Given...)> work, Names... names) {
  module.def(
      name,
      [=](Handle<Given>... given, const py::object& progress) {
        const std::tuple<Held<Given>...> values{from_python<Held<Given>>(given, names)...};
        return to_python(interruptible(progress, [&](Progress& reports) {
          return std::apply([&](const auto&... value) { return work(reports, value...); }, values);
        }));
      },
      py::call_guard<LongCall>());
}

/// Defines a function of the module. `names` are those of its arguments, for errors. `work` that
/// takes Progress& first is interruptible, and has `progress` as its last argument in Python.
template <class Work, class... Names>
void define(py::module_& module, const char* name, Work work, Names... names) {
  define_as(module, name, std::function(std::move(work)), names...);
}

/// The same of a method, whose first argument is its object.
template <class Result, class Object, class... Given, class... Names>
void define(py::module_& module, const char* name, Result (Object::*work)(Given...) const,
            Names... names) {
  define_as(module, name, std::function<Result(const Object&, Given...)>(work), names...);
}

}  // namespace gearlash::python
