// Columns for limit cycles with memory of their own.
#pragma once

#include <algorithm>
#include <array>
#include <cstring>
#include <vector>

#include "gearlash/chart/cycle_batch.hpp"

namespace gearlash {

struct CycleTable {
  enum Column {
    growth_at_rest,
    size,
    motor_size,
    period,
    multiplier,
    impact_speed,
    engaged_time,
    separated_time,
    motor_friction_loss,
    load_friction_loss,
    impact_loss,
    residual,
    column_count
  };

  explicit CycleTable(std::size_t rows) : verdict(rows, Verdict::undecided) {
    values.fill(std::vector<double>(rows, -1.0));
  }

  CycleColumns columns() {
    return {verdict,
            values[growth_at_rest],
            values[size],
            values[motor_size],
            values[period],
            values[multiplier],
            values[impact_speed],
            values[engaged_time],
            values[separated_time],
            values[motor_friction_loss],
            values[load_friction_loss],
            values[impact_loss],
            values[residual]};
  }

  std::vector<Verdict> verdict;
  std::array<std::vector<double>, column_count> values;
};

inline bool same_bits(const CycleTable& a, const CycleTable& b, std::size_t row_in_a,
                      std::size_t row_in_b) {
  return a.verdict[row_in_a] == b.verdict[row_in_b] &&
         std::equal(a.values.begin(), a.values.end(), b.values.begin(),
                    [&](const std::vector<double>& left, const std::vector<double>& right) {
                      return std::memcmp(&left[row_in_a], &right[row_in_b], sizeof(double)) == 0;
                    });
}

inline bool same_bits(const CycleTable& a, const CycleTable& b) {
  for (std::size_t row = 0; row < a.verdict.size(); ++row) {
    if (!same_bits(a, b, row, row)) return false;
  }
  return a.verdict.size() == b.verdict.size();
}

}  // namespace gearlash
