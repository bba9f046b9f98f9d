// What a vector unit can do: each operation of the kernel by itself, over independent numbers in
// the nearest cache.
#pragma once

#include <cstddef>

#include "closed_form/lanes/cycle_batch.hpp"
#include "operations.hpp"

namespace gearlash::benchmarks {

/// An operation over two columns of numbers, written to a third, of this length. Arguments are
/// those of the kernel: x in (0, 1), y in (−1, 1) without 0.
inline constexpr std::size_t column_length = 512;
using ColumnFunction = void (*)(const double* x, const double* y, double* result);

/// How often a ColumnFunction repeats itself on each number: what is cheap several times, so that
/// it is not loading and storing that is measured.
constexpr std::size_t repetitions_of(Operation operation) {
  return operation < Operation::product ? 1 : 16;
}
/// Of choices it does two at a time, a comparison and a selection.
constexpr std::size_t operations_per_number(Operation operation) {
  return repetitions_of(operation) * (operation == Operation::choice ? 2 : 1);
}

/// How many lanes of the kernel go in step with that unit.
std::size_t lanes_in_step(VectorUnit unit);
ByOperation<ColumnFunction> column_functions(VectorUnit unit);

ByOperation<ColumnFunction> column_functions_baseline();
ByOperation<ColumnFunction> column_functions_avx2();
ByOperation<ColumnFunction> column_functions_avx512();

}  // namespace gearlash::benchmarks
