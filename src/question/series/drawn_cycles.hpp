// The limit cycles of drawn drives.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "base/special_numbers.hpp"
#include "closed_form/lanes/cycle_batch.hpp"
#include "gearlash/answer.hpp"
#include "question/series/toleranced_drive.hpp"

namespace gearlash::detail {

struct DrawnCycle {
  Verdict verdict = Verdict::undecided;
  /// Amplitude in rad per rad of backlash. 0 where the drive cannot hunt (with any backlash, where
  /// it has any), infinite where it grows without bound, NaN where unknown.
  double amplitude_per_backlash = not_a_number;
  double backlash = 0.0;                 ///< rad
  double growth_at_rest = not_a_number;  ///< NaN where the values give no valid drive
  double frequency = not_a_number;       ///< Hz; NaN where there is no cycle
  bool refused = false;                  ///< no valid drive

  /// As an answer that is_of_boxes() targets can be judged by. `answer`: one that is reused.
  void fill(Answer& answer) const;
};

/// Solves `rows` drives. `values` holds the values of the varied parameters, drive by drive.
std::vector<DrawnCycle> solve(const TolerancedDrive& drive, std::size_t rows,
                              std::span<const double> values, VectorUnit unit);

/// The number of drives that a thread solves at a time.
std::size_t drives_at_a_time(const TolerancedDrive& drive);

}  // namespace gearlash::detail
