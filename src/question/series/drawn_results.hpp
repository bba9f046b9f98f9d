// What drawn drives do, by the closed form or by analyse() one by one.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "base/special_numbers.hpp"
#include "closed_form/lanes/cycle_batch.hpp"
#include "gearlash/progress.hpp"
#include "question/change/target.hpp"
#include "question/series/toleranced_drive.hpp"

namespace gearlash::detail {

/// What one drawn drive does. Studies keep one of each sample: 32 bytes.
struct DrawnResult {
  double growth_at_rest = not_a_number;
  /// Of the load or the motor, as asked: 0 where the drive comes to rest, infinite where it grows
  /// without bound or runs away, NaN where unknown.
  double amplitude = not_a_number;
  double frequency = not_a_number;  ///< Hz; NaN where there is no cycle
  Verdict verdict = Verdict::undecided;
  bool meets = false;    ///< the target
  bool refused = false;  ///< no valid drive: undecided, numbers NaN

  /// Whether it can move permanently of itself, or run away.
  bool hunts() const;
};
using DrawnResults = std::vector<DrawnResult>;

/// Answers for drawn drives. From several threads at a time.
class DrawnAnswers {
 public:
  /// `amplitude`: of the load (Quantity::amplitude) or of the motor.
  DrawnAnswers(const TolerancedDrive& drive, const Target& target, Quantity amplitude,
               VectorUnit unit);

  /// Whether each drive is analysed by itself.
  bool are_one_by_one() const { return one_by_one_; }
  /// The number of drives that a thread solves at a time.
  std::size_t at_a_time() const;
  /// Of `rows` drives. `values` holds the values of the varied parameters, drive by drive. Where
  /// `progress` stops it, results are unknown.
  DrawnResults of(std::size_t rows, std::span<const double> values, Progress& progress) const;

 private:
  DrawnResults in_closed_form(std::size_t rows, std::span<const double> values) const;
  DrawnResult searched(std::span<const double> values, Progress& progress) const;

  const TolerancedDrive& drive_;
  const Target& target_;
  Quantity amplitude_;
  VectorUnit unit_;
  bool one_by_one_;
};

}  // namespace gearlash::detail
