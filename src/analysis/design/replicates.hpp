// What all replicates of a sample say together, and how far they differ.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "analysis/grid/grid_evaluation.hpp"
#include "gearlash/tolerance.hpp"

namespace gearlash::detail {

/// `value` with the standard error that the replicates' own values show; NaNs among them are left
/// out.
Estimate estimate_of(double value, std::span<const double> of_replicates);

/// Σ numerators/Σ denominators; its standard error is that of the numerators less the ratio times
/// the denominators. Nothing where the denominators are 0 in all.
std::optional<Estimate> ratio_of(std::span<const double> numerators,
                                 std::span<const double> denominators);

/// Numbers ≥ 0, infinity included, in rising order, replicate by replicate.
struct SortedReplicates {
  std::vector<std::span<const double>> replicates;

  std::size_t size() const;
  /// The k-th smallest of all, from 0 on. Precondition: k < size().
  double smallest(std::size_t k) const;
  /// That a share p of all do not exceed, 0 ≤ p ≤ 1: between the two numbers whose mid-ranks are
  /// nearest to p (Hazen). NaN where there are none.
  double quantile(double p) const;
  std::optional<Estimate> estimated_quantile(double p) const;  ///< nothing where there are none
  std::size_t count_between(double low, double high) const;    ///< low ≤ x < high
  SortedReplicates above(double floor) const;
  SortedReplicates finite() const;
};

/// Points of one replicate.
struct SampleBlock {
  std::size_t index = 0;
  std::size_t replicate = 0;
  std::size_t first = 0;
  std::size_t count = 0;
};

/// All blocks of a sampling on all cores; false where progress has stopped it. What a block's
/// work is does not depend on the number of threads.
bool for_all_blocks(const SamplePlan& sampling, std::size_t points_at_a_time,
                    const Workers& workers, Progress& progress,
                    const std::function<void(const SampleBlock&)>& work);
std::size_t block_count(const SamplePlan& sampling, std::size_t points_at_a_time);

}  // namespace gearlash::detail
