// Vectors of any kind of number: doubles, intervals, rationals.
#pragma once

#include <cstddef>
#include <vector>

namespace gearlash {

/// Precondition: as many numbers in both.
template <class Number>
std::vector<Number> added(std::vector<Number> a, const std::vector<Number>& b) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] = a[i] + b[i];
  return a;
}

template <class Number>
std::vector<Number> scaled(const Number& factor, std::vector<Number> vector) {
  for (Number& entry : vector) entry = factor * entry;
  return vector;
}

/// Precondition: as many numbers in both.
template <class Number>
Number dot(const std::vector<Number>& row, const std::vector<Number>& column) {
  Number sum(0.0);
  for (std::size_t i = 0; i < row.size(); ++i) sum = sum + row[i] * column[i];
  return sum;
}

}  // namespace gearlash
