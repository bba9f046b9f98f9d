// What drawn drives do, by the closed form or by analyse() one by one.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "analysis/design/target.hpp"
#include "analysis/design/toleranced_drive.hpp"
#include "closed_form/lanes/cycle_batch.hpp"
#include "gearlash/progress.hpp"

namespace gearlash::detail {

/// One row per drive.
struct DrawnResults {
  /// Amplitude of the load or the motor, as asked: 0 where the drive comes to rest, infinite where
  /// it grows without bound or runs away, NaN where unknown.
  std::vector<Performance> performance{};
  std::vector<bool> meets{};  ///< the target
  std::size_t refused = 0;    ///< no valid drive: undecided, numbers NaN

  std::size_t rows() const { return performance.size(); }
  double amplitude(std::size_t row) const { return performance[row].amplitude; }
  Verdict verdict(std::size_t row) const { return performance[row].verdict; }
  /// Whether it can move permanently of itself, or run away.
  bool hunts(std::size_t row) const;
};

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
  /// `values` holds the values of the varied parameters, drive by drive. Where `progress` stops it,
  /// rows are unknown.
  DrawnResults of(std::size_t rows, std::span<const double> values, Progress& progress) const;

 private:
  DrawnResults in_closed_form(std::size_t rows, std::span<const double> values) const;
  DrawnResults one_by_one(std::size_t rows, std::span<const double> values,
                          Progress& progress) const;

  const TolerancedDrive& drive_;
  const Target& target_;
  Quantity amplitude_;
  VectorUnit unit_;
  bool one_by_one_;
};

}  // namespace gearlash::detail
