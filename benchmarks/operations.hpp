// What the batch kernel consists of, for counting and for timing.
#pragma once

#include <array>
#include <cstddef>

namespace gearlash::benchmarks {

enum class Operation {
  exponential,
  logarithm,
  logarithm_of_one_plus,
  arc_tangent,
  decay_series,      ///< exp[0, 0, −x] where x < 1
  two_decay_series,  ///< exp[0, 0, −x, −y] where both are
  circular_series,   ///< cosine, or sine by argument
  division,
  root,
  product,
  sum,
  choice  ///< comparison, selection, maximum, absolute value, change of sign
};
inline constexpr std::size_t operation_count = 12;

constexpr bool is_library_function(Operation operation) {
  return operation <= Operation::arc_tangent;
}
constexpr bool is_series(Operation operation) {
  return operation >= Operation::decay_series && operation <= Operation::circular_series;
}
constexpr bool is_division_or_root(Operation operation) {
  return operation == Operation::division || operation == Operation::root;
}
const char* name_of(Operation operation);

/// By Operation.
template <class Value>
using ByOperation = std::array<Value, operation_count>;

}  // namespace gearlash::benchmarks
