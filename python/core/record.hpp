// Values of C++ as values of Python, and back: structs as the dataclasses of gearlash._records, by
// the lists of their members in the generated output/records.hpp.
#pragma once

#include <pybind11/pybind11.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "gearlash/drive.hpp"
#include "output/record.hpp"

namespace gearlash::python {

namespace py = pybind11;

using records::is_a;
using records::IsCurve;
using records::IsRecord;
using records::IsWord;
using records::Record;
using records::Word;
using records::Words;

/// The class of gearlash._records. It lives as long as the interpreter.
py::handle class_named(const char* name);

/// gearlash.Drive of a drive, and back.
py::object drive_to_python(Drive drive);
/// A copy, so that nothing that Python does meanwhile can change or free it.
Drive drive_of(py::handle object);

/// Throws TypeError: "NAME must be PERMITTED, not TYPE".
[[noreturn]] void refuse_type(const char* name, const std::string& permitted, py::handle found);

// ---- to Python ----------------------------------------------------------------------------------

template <class Type>
py::object to_python(const Type& value);

template <class Struct>
py::object record_to_python(const Struct& value) {
  return std::apply(
      [&](const auto&... member) {
        const py::handle type = class_named(Record<Struct>::name);
        return py::object(type(to_python(value.*(member.place))...));
      },
      Record<Struct>::members);
}

/// Records, words, lists as tuples, and numbers, with None for NaN.
template <class Type>
py::object to_python(const Type& value) {
  if constexpr (std::is_same_v<Type, double>) {
    return std::isnan(value) ? py::object(py::none()) : py::object(py::float_(value));
  } else if constexpr (std::is_same_v<Type, bool>) {
    return py::bool_(value);
  } else if constexpr (std::is_integral_v<Type>) {
    return py::int_(value);
  } else if constexpr (std::is_convertible_v<Type, std::string_view>) {
    return py::str(std::string(std::string_view(value)));
  } else if constexpr (std::is_same_v<Type, Drive>) {
    return drive_to_python(value);
  } else if constexpr (IsWord<Type>) {
    return py::str(Words<Type>::named(value));
  } else if constexpr (IsRecord<Type>) {
    return record_to_python(value);
  } else if constexpr (is_a<Type, std::optional>) {
    return value ? to_python(*value) : py::object(py::none());
  } else if constexpr (is_a<Type, std::variant>) {
    return std::visit([](const auto& held) { return to_python(held); }, value);
  } else if constexpr (IsCurve<Type>) {
    py::tuple points(value.size());
    for (std::size_t i = 0; i < value.size(); ++i) {
      points[i] = py::make_tuple(value[i].x, value[i].y);
    }
    return points;
  } else if constexpr (requires { value.front().second; }) {
    py::dict names;
    for (const auto& [name, of] : value) names[py::str(std::string(name))] = to_python(of);
    return names;
  } else {
    py::tuple list(value.size());
    for (std::size_t i = 0; i < value.size(); ++i) list[i] = to_python(value[i]);
    return list;
  }
}

// ---- from Python --------------------------------------------------------------------------------

/// `name` is that of the argument or the member, for errors.
template <class Type>
Type from_python(py::handle object, const char* name);

template <class Struct>
Struct record_from_python(py::handle object, const char* name) {
  if (!py::isinstance(object, class_named(Record<Struct>::name))) {
    refuse_type(name, std::string("a gearlash.") + Record<Struct>::name, object);
  }
  Struct value;
  std::apply(
      [&](const auto&... member) {
        ((value.*(member.place) = from_python<std::decay_t<decltype(value.*(member.place))>>(
              object.attr(member.attribute), member.attribute)),
         ...);
      },
      Record<Struct>::members);
  return value;
}

template <class Enumeration>
Enumeration word_from_python(py::handle object, const char* name) {
  std::string permitted;
  const std::string text =
      py::isinstance<py::str>(object) ? object.cast<std::string>() : std::string();
  for (const Word<Enumeration>& word : Words<Enumeration>::all) {
    const std::string own = Words<Enumeration>::named(word.value);
    if (own == text) return word.value;
    permitted += (permitted.empty() ? "" : ", ") + own;
  }
  throw InvalidInput({{name, std::string(py::str(object)), "must be one of " + permitted}});
}

template <class Variant, std::size_t index = 0>
Variant variant_from_python(py::handle object, const char* name, std::string permitted = {}) {
  if constexpr (index == std::variant_size_v<Variant>) {
    refuse_type(name, "one of " + permitted, object);
  } else {
    using Held = std::variant_alternative_t<index, Variant>;
    if (py::isinstance(object, class_named(Record<Held>::name))) {
      return record_from_python<Held>(object, name);
    }
    permitted += std::string(index == 0 ? "gearlash." : ", gearlash.") + Record<Held>::name;
    return variant_from_python<Variant, index + 1>(object, name, std::move(permitted));
  }
}

/// Refuses what Python would convert to a number too: text, bytes, True, arrays.
inline double number_from_python(py::handle object, const char* name) {
  const bool is_number = PyNumber_Check(object.ptr()) != 0 && !py::hasattr(object, "__len__");
  const bool is_array = py::hasattr(object, "ndim") && object.attr("ndim").cast<int>() > 0;
  if ((!is_number && !py::hasattr(object, "ndim")) || is_array || PyBool_Check(object.ptr()) != 0) {
    refuse_type(name, "a number", object);
  }
  const double value = PyFloat_AsDouble(object.ptr());
  if (PyErr_Occurred() != nullptr) throw py::error_already_set();
  return value;
}

template <class Type>
Type from_python(py::handle object, const char* name) {
  if constexpr (std::is_same_v<Type, double>) {
    return object.is_none() ? std::numeric_limits<double>::quiet_NaN()
                            : number_from_python(object, name);
  } else if constexpr (std::is_same_v<Type, bool>) {
    const std::string type = py::str(py::type::handle_of(object).attr("__name__"));
    if (type != "bool" && type != "bool_")
      refuse_type(name, "True or False", object);  // NumPy's too
    return py::bool_(py::reinterpret_borrow<py::object>(object));
  } else if constexpr (std::is_integral_v<Type>) {
    try {
      return object.cast<Type>();
    } catch (const py::cast_error&) {
      const std::string permitted = "an integer from " +
                                    std::to_string(std::numeric_limits<Type>::min()) + " to " +
                                    std::to_string(std::numeric_limits<Type>::max());
      if (PyLong_Check(object.ptr()) == 0) refuse_type(name, permitted, object);
      throw InvalidInput({{name, std::string(py::str(object)), "must be " + permitted}});
    }
  } else if constexpr (std::is_same_v<Type, std::string>) {
    if (!py::isinstance<py::str>(object)) refuse_type(name, "text", object);
    return object.cast<std::string>();
  } else if constexpr (std::is_same_v<Type, std::string_view>) {
    return {};  // of static storage: facts that only the library gives
  } else if constexpr (std::is_same_v<Type, Drive>) {
    return drive_of(object);
  } else if constexpr (IsWord<Type>) {
    return word_from_python<Type>(object, name);
  } else if constexpr (IsRecord<Type>) {
    return record_from_python<Type>(object, name);
  } else if constexpr (is_a<Type, std::optional>) {
    if (object.is_none()) return std::nullopt;
    return from_python<typename Type::value_type>(object, name);
  } else if constexpr (is_a<Type, std::variant>) {
    return variant_from_python<Type>(object, name);
  } else {
    static_assert(is_a<Type, std::vector>);
    if (py::isinstance<py::str>(object) || !py::isinstance<py::iterable>(object)) {
      refuse_type(name, "a sequence", object);
    }
    Type list;
    for (const py::handle& one : object) {
      list.push_back(from_python<typename Type::value_type>(one, name));
    }
    return list;
  }
}

}  // namespace gearlash::python
