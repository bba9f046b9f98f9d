// Included by one file for each vector unit, as the kernel's lanes are; everything here is a
// template of the unit for the same reason.
#pragma once

#include "closed_form/lanes/cycle_kernel_lanes.hpp"
#include "vector_functions.hpp"

namespace gearlash::benchmarks {

template <class Unit, Operation operation>
detail::Lanes<Unit> done_once(const detail::Lanes<Unit>& x, const detail::Lanes<Unit>& y) {
  if constexpr (operation == Operation::exponential) return exp(-x);
  if constexpr (operation == Operation::logarithm) return log(x);
  if constexpr (operation == Operation::logarithm_of_one_plus) return log1p(x);
  if constexpr (operation == Operation::arc_tangent) return atan2(x, y);
  if constexpr (operation == Operation::decay_series) {
    return detail::single_rate_series_lanes<Unit>(x);
  }
  if constexpr (operation == Operation::two_decay_series) {
    return detail::two_rate_series_lanes<Unit>(x, y);
  }
  if constexpr (operation == Operation::circular_series) {
    return detail::alternating_series_lanes<Unit, 0>(x);
  }
  if constexpr (operation == Operation::division) return x / y;
  if constexpr (operation == Operation::root) return sqrt(x);
  if constexpr (operation == Operation::product) return x * y;
  if constexpr (operation == Operation::sum) return x + y;
  if constexpr (operation == Operation::choice) return select(x < y, y, x);
}

template <class Unit, Operation operation>
void do_column(const double* x, const double* y, double* result) {
  using Real = detail::Lanes<Unit>;
  for (std::size_t i = 0; i < column_length; i += Real::size) {
    Real value = Real::load_aligned(x + i);
    const Real other = Real::load_aligned(y + i);
    for (std::size_t k = 0; k < repetitions_of(operation); ++k) {
      value = done_once<Unit, operation>(value, other);
    }
    value.store_aligned(result + i);
  }
}

template <class Unit>
ByOperation<ColumnFunction> column_functions_of() {
  return {do_column<Unit, Operation::exponential>,
          do_column<Unit, Operation::logarithm>,
          do_column<Unit, Operation::logarithm_of_one_plus>,
          do_column<Unit, Operation::arc_tangent>,
          do_column<Unit, Operation::decay_series>,
          do_column<Unit, Operation::two_decay_series>,
          do_column<Unit, Operation::circular_series>,
          do_column<Unit, Operation::division>,
          do_column<Unit, Operation::root>,
          do_column<Unit, Operation::product>,
          do_column<Unit, Operation::sum>,
          do_column<Unit, Operation::choice>};
}

}  // namespace gearlash::benchmarks
