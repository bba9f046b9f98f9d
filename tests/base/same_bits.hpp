// Whether two tables hold the same answers, to the bit.
#pragma once

#include <algorithm>
#include <cstring>

#include "closed_form/lanes/cycle_batch.hpp"
#include "gearlash/grid.hpp"

namespace gearlash {

inline bool same_bits(const Table& a, const Table& b, std::size_t row_in_a, std::size_t row_in_b) {
  return a.verdict(row_in_a) == b.verdict(row_in_b) &&
         std::all_of(solved_quantities.begin(), solved_quantities.end(), [&](Quantity quantity) {
           return std::memcmp(&a[quantity][row_in_a], &b[quantity][row_in_b], sizeof(double)) == 0;
         });
}

inline bool same_bits(const Table& a, const Table& b) {
  for (std::size_t row = 0; row < a.rows(); ++row) {
    if (!same_bits(a, b, row, row)) return false;
  }
  return a.rows() == b.rows();
}

}  // namespace gearlash
