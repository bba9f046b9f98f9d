// The limit cycles of drawn drives.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "analysis/design/target.hpp"
#include "analysis/design/toleranced_drive.hpp"
#include "closed_form/lanes/cycle_batch.hpp"

namespace gearlash::detail {

/// One row a drive.
struct DrawnCycles {
  /// rad of amplitude for each rad of backlash; 0 where the drive cannot hunt (with any backlash at
  /// all, where it has any), infinite where it grows without bound, NaN where that is not known.
  std::vector<double> amplitude_per_backlash;
  std::vector<double> backlash;        ///< rad
  std::vector<double> growth_at_rest;  ///< NaN where the values make no drive
  std::vector<double> frequency;       ///< Hz; NaN where there is no cycle
  std::vector<Verdict> verdict;
  std::size_t refused = 0;  ///< values that make no drive: verdict undecided, amplitudes NaN

  std::size_t rows() const { return verdict.size(); }
  double amplitude(std::size_t row) const {
    return verdict[row] == Verdict::cannot_hunt ? 0.0 : amplitude_per_backlash[row] * backlash[row];
  }
  bool hunts(std::size_t row) const {
    return verdict[row] != Verdict::cannot_hunt && verdict[row] != Verdict::undecided;
  }
  Performance performance(std::size_t row) const;
};

/// Of `rows` drives; `values` holds those of the varied numbers, drive by drive.
DrawnCycles solve(const TolerancedDrive& drive, std::size_t rows, std::span<const double> values,
                  VectorUnit unit);

/// Drives that a thread works out at a time.
std::size_t drives_at_a_time(const TolerancedDrive& drive);

}  // namespace gearlash::detail
