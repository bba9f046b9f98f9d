// The samples of a production run: the values drawn for them, and what each of them does.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "base/special_numbers.hpp"
#include "gearlash/progress.hpp"
#include "question/change/target.hpp"
#include "question/family/evaluation.hpp"
#include "question/series/shifted_sobol.hpp"
#include "question/series/toleranced_drive.hpp"

namespace gearlash::detail {

/// The values of the varied parameters at the points of a plan.
class SampleValues {
 public:
  /// `sets` independent sets of values at each point.
  SampleValues(const TolerancedDrive& drive, const SamplePlan& plan, std::size_t sets);

  /// Writes the values sample by sample, from sample `first` on, numbered replicate by replicate,
  /// until `values` is full; of each first the whole first set, then the next.
  void fill(std::size_t first, std::span<double> values) const;
  std::vector<double> of(std::size_t first, std::size_t count) const;

 private:
  ShiftedSobol points_;
  std::size_t of_replicate_;
  std::size_t width_;
  std::vector<QuantileFunction> quantiles_;
};

/// What one sample does. Studies keep one of each sample: 32 bytes.
struct SampleResult {
  double growth_at_rest = not_a_number;
  /// Of the load or the motor, as asked: 0 where the drive comes to rest, infinite where it grows
  /// without bound or runs away, NaN where unknown.
  double amplitude = not_a_number;
  double frequency = not_a_number;  ///< Hz; NaN where there is no cycle
  double error = not_a_number;      ///< rad, in the end; infinite and NaN as the amplitude
  Verdict verdict = Verdict::undecided;
  bool meets = false;    ///< the target
  bool refused = false;  ///< no valid drive: undecided, numbers NaN

  /// Whether it can move permanently of itself, or run away.
  bool hunts() const;
};
using SampleResults = std::vector<SampleResult>;

/// Samples that are searched are ordered within blocks of so many, so that each differs little from
/// the one before and may be followed from it. Each block begins at a multiple of it.
inline constexpr std::size_t block_of_samples = 64;

/// What drives of a series do.
class SampleAnswers {
 public:
  /// `amplitude`: of the load (Quantity::amplitude) or of the motor. `hurries`: of a searched drive
  /// that hunts, slow starts may be left undecided. The drive and the target must outlive it.
  SampleAnswers(const TolerancedDrive& drive, const Target& target, Quantity amplitude,
                const Workers& workers, bool hurries = true);

  /// Whether each drive is analysed by itself. Those of a run are then followed from one to the
  /// next, where its ends, which are analysed afresh, are alike (search_run()).
  bool are_one_by_one() const { return one_by_one_; }
  /// Of as many rows as there are results. False: progress stopped it; rows left out are undecided.
  bool fill(const FamilyRows& rows, std::span<SampleResult> results, Progress& progress) const;
  /// The same for values drive by drive.
  SampleResults of(std::span<const double> values, Progress& progress) const;

 private:
  SampleResult result_of(const Answer* answer) const;

  const Target& target_;
  Quantity amplitude_;
  Workers workers_;
  Family family_;
  std::vector<double> widths_;  ///< of the ranges of the parameters
  bool one_by_one_;
  bool hurries_;
};

}  // namespace gearlash::detail
