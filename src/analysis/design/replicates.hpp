// Estimates from all replicates of a sample, with standard errors.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "analysis/grid/grid_evaluation.hpp"
#include "gearlash/tolerance.hpp"
#include "numeric/quantile_sketch.hpp"

namespace gearlash::detail {

/// `value` with its standard error, from the scatter of the replicates' values. NaNs among them are
/// left out.
Estimate estimate_of(double value, std::span<const double> of_replicates);

/// Σ numerators/Σ denominators. Its standard error is that of the numerators minus the ratio times
/// the denominators. Empty where the denominators sum to 0.
std::optional<Estimate> ratio_of(std::span<const double> numerators,
                                 std::span<const double> denominators);

/// Numbers ≥ 0, including infinity, sorted within each replicate.
struct SortedReplicates {
  std::vector<std::span<const double>> replicates;

  std::size_t size() const;
  /// The k-th smallest of all, counted from 0. Precondition: k < size().
  double smallest(std::size_t k) const;
  /// The value that a share p of all does not exceed, 0 ≤ p ≤ 1, interpolated between the two
  /// numbers whose mid-ranks are nearest to p (Hazen). NaN where there are no numbers.
  double quantile(double p) const;
  std::optional<Estimate> estimated_quantile(double p) const;  ///< empty where there are none
  std::size_t count_between(double low, double high) const;    ///< low ≤ x < high
  SortedReplicates above(double floor) const;
  SortedReplicates finite() const;
};

/// The same estimates from sketches, within their relative accuracy.
class SketchedReplicates {
 public:
  explicit SketchedReplicates(std::span<const QuantileSketch> replicates);
  /// All replicates together.
  const QuantileSketch& whole() const { return whole_; }
  std::optional<Estimate> estimated_quantile(double p) const;  ///< empty where there are none

 private:
  std::span<const QuantileSketch> replicates_;
  QuantileSketch whole_;
};

/// A range of points of one replicate.
struct SampleBlock {
  std::size_t index = 0;
  std::size_t replicate = 0;
  std::size_t first = 0;
  std::size_t count = 0;
};

/// Works through all blocks of a sampling on all cores; false if progress stopped it. The division
/// into blocks does not depend on the number of threads. The work may ask its progress whether to
/// go on.
bool for_all_blocks(const SamplePlan& sampling, std::size_t points_at_a_time,
                    const Workers& workers, Progress& progress,
                    const std::function<void(const SampleBlock&, Progress&)>& work);
std::size_t block_count(const SamplePlan& sampling, std::size_t points_at_a_time);

}  // namespace gearlash::detail
