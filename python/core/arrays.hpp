// NumPy arrays over memory of C++, without copies, and numbers from any array.
#pragma once

#include <pybind11/numpy.h>

#include <memory>
#include <vector>

#include "record.hpp"

namespace gearlash::python {

/// An array over `count` numbers that `owner` keeps alive.
template <class Number, class Owner>
py::array_t<Number> array_over(const Number* first, std::size_t count,
                               const std::shared_ptr<Owner>& owner) {
  auto* kept = new std::shared_ptr<const void>(owner);
  const py::capsule base(
      kept, [](void* held) { delete static_cast<std::shared_ptr<const void>*>(held); });
  return py::array_t<Number>(static_cast<py::ssize_t>(count), first, base);
}

template <class Number>
py::array_t<Number> array_of(std::vector<Number> numbers) {
  const auto owner = std::make_shared<std::vector<Number>>(std::move(numbers));
  return array_over(owner->data(), owner->size(), owner);
}

/// Any array of real numbers, of any layout, as a flat contiguous one of doubles.
using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;

}  // namespace gearlash::python
