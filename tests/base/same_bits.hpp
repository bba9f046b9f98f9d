// Whether two tables hold the same answers, to the bit.
#pragma once

#include <algorithm>
#include <cstring>
#include <vector>

#include "closed_form/lanes/cycle_table.hpp"

namespace gearlash {

inline bool same_bits(const CycleTable& a, const CycleTable& b, std::size_t row_in_a,
                      std::size_t row_in_b) {
  return a.verdict[row_in_a] == b.verdict[row_in_b] &&
         std::equal(a.values.begin(), a.values.end(), b.values.begin(),
                    [&](const std::vector<double>& left, const std::vector<double>& right) {
                      return std::memcmp(&left[row_in_a], &right[row_in_b], sizeof(double)) == 0;
                    });
}

inline bool same_bits(const CycleTable& a, const CycleTable& b) {
  for (std::size_t row = 0; row < a.rows(); ++row) {
    if (!same_bits(a, b, row, row)) return false;
  }
  return a.rows() == b.rows();
}

}  // namespace gearlash
