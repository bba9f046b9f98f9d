// Estimates from all replicates of a sample, with standard errors.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "gearlash/tolerance.hpp"

namespace gearlash::detail {

/// `value` with its standard error, from the scatter of the replicates' values. NaNs among them are
/// left out.
Estimate estimate_of(double value, std::span<const double> of_replicates);

/// Σ numerators/Σ denominators. Its standard error is that of the numerators minus the ratio times
/// the denominators. Empty where the denominators sum to 0.
std::optional<Estimate> ratio_of(std::span<const double> numerators,
                                 std::span<const double> denominators);

/// Numbers sorted within each replicate.
struct SortedReplicates {
  std::vector<std::span<const double>> replicates;

  std::size_t size() const;
  /// The k-th smallest of all, counted from 0. Precondition: k < size(), and all numbers are ≥ 0,
  /// infinity included.
  double smallest(std::size_t k) const;
  /// The value that a share p of all does not exceed, 0 ≤ p ≤ 1, interpolated between the two
  /// numbers whose mid-ranks are nearest to p (Hazen). NaN where there are no numbers.
  double quantile(double p) const;
  std::optional<Estimate> estimated_quantile(double p) const;  ///< empty where there are none
  SortedReplicates from(double low) const;                     ///< those that are ≥ low
  SortedReplicates below(double high) const;                   ///< those that are < high
};

/// Sorts the numbers of each replicate, which follow one another in `column`.
SortedReplicates sorted(std::span<double> column, std::size_t replicates, std::size_t threads);

}  // namespace gearlash::detail
