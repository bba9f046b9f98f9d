// The limit cycles of drawn drives.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "analysis/design/target.hpp"
#include "analysis/design/toleranced_drive.hpp"
#include "closed_form/lanes/cycle_batch.hpp"

namespace gearlash::detail {

/// One row per drive.
struct DrawnCycles {
  /// Amplitude in rad per rad of backlash. 0 where the drive cannot hunt (with any backlash, where
  /// it has any), infinite where it grows without bound, NaN where unknown.
  std::vector<double> amplitude_per_backlash;
  std::vector<double> backlash;        ///< rad
  std::vector<double> growth_at_rest;  ///< NaN where the values give no valid drive
  std::vector<double> frequency;       ///< Hz; NaN where there is no cycle
  std::vector<Verdict> verdict;
  std::size_t refused = 0;  ///< no valid drive: verdict undecided, amplitudes NaN

  std::size_t rows() const { return verdict.size(); }
  double amplitude(std::size_t row) const {
    return verdict[row] == Verdict::cannot_hunt ? 0.0 : amplitude_per_backlash[row] * backlash[row];
  }
  Performance performance(std::size_t row) const;
};

/// Solves `rows` drives. `values` holds the values of the varied parameters, drive by drive.
DrawnCycles solve(const TolerancedDrive& drive, std::size_t rows, std::span<const double> values,
                  VectorUnit unit);

/// The number of drives that a thread solves at a time.
std::size_t drives_at_a_time(const TolerancedDrive& drive);

}  // namespace gearlash::detail
