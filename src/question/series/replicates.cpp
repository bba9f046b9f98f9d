#include "question/series/replicates.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "base/bits_of_double.hpp"
#include "base/lists.hpp"
#include "base/on_threads.hpp"
#include "base/shared_progress.hpp"
#include "base/special_numbers.hpp"

namespace gearlash::detail {

Estimate estimate_of(double value, std::span<const double> of_replicates) {
  double sum = 0.0;
  double count = 0.0;
  for (const double one : of_replicates) {
    if (std::isnan(one)) continue;
    sum += one;
    count += 1.0;
  }
  if (count < 2.0) return {value, {}};
  double squares = 0.0;
  for (const double one : of_replicates) {
    if (!std::isnan(one)) squares += (one - sum / count) * (one - sum / count);
  }
  const double error = std::sqrt(squares / (count * (count - 1.0)));
  // An infinite value makes the error NaN.
  return {value, std::isnan(error) ? std::nullopt : std::optional(error)};
}

std::optional<Estimate> ratio_of(std::span<const double> numerators,
                                 std::span<const double> denominators) {
  double numerator = 0.0;
  double denominator = 0.0;
  for (std::size_t i = 0; i < numerators.size(); ++i) {
    numerator += numerators[i];
    denominator += denominators[i];
  }
  if (!(denominator > 0.0)) return std::nullopt;
  const double ratio = numerator / denominator;
  const double mean = denominator / static_cast<double>(denominators.size());
  return estimate_of(ratio, of_each(indices(numerators.size()), [&](std::size_t i) {
                       return (numerators[i] - ratio * denominators[i]) / mean;
                     }));
}

std::size_t SortedReplicates::size() const {
  std::size_t all = 0;
  for (const auto& replicate : replicates) all += replicate.size();
  return all;
}

double SortedReplicates::smallest(std::size_t k) const {
  std::uint64_t low = 0;
  std::uint64_t high = bits_of(std::numeric_limits<double>::infinity());
  while (low < high) {
    const std::uint64_t middle = low + (high - low) / 2;
    const double value = double_of_bits(middle);
    std::size_t not_above = 0;
    for (const auto& replicate : replicates) {
      not_above += static_cast<std::size_t>(
          std::upper_bound(replicate.begin(), replicate.end(), value) - replicate.begin());
    }
    if (not_above > k) {
      high = middle;
    } else {
      low = middle + 1;
    }
  }
  return double_of_bits(low);
}

double SortedReplicates::quantile(double p) const {
  const std::size_t count = size();
  if (count == 0) return not_a_number;
  const double last = static_cast<double>(count - 1);
  const double rank = std::clamp(p * static_cast<double>(count) - 0.5, 0.0, last);
  const double whole = std::floor(rank);
  const double low = smallest(static_cast<std::size_t>(whole));
  if (rank == whole) return low;
  const double high = smallest(static_cast<std::size_t>(whole) + 1);
  return high == low ? low : low + (rank - whole) * (high - low);
}

std::optional<Estimate> SortedReplicates::estimated_quantile(double p) const {
  if (size() == 0) return std::nullopt;
  return estimate_of(quantile(p), of_each(replicates, [&](const auto& replicate) {
                       return SortedReplicates{{replicate}}.quantile(p);
                     }));
}

namespace {

std::size_t places_below(std::span<const double> sorted, double value) {
  return static_cast<std::size_t>(std::lower_bound(sorted.begin(), sorted.end(), value) -
                                  sorted.begin());
}

}  // namespace

SortedReplicates SortedReplicates::from(double low) const {
  return {of_each(replicates, [&](std::span<const double> all) {
    return all.subspan(places_below(all, low));
  })};
}

SortedReplicates SortedReplicates::below(double high) const {
  return {of_each(replicates,
                  [&](std::span<const double> all) { return all.first(places_below(all, high)); })};
}

SortedReplicates sorted(std::span<double> column, std::size_t replicates, std::size_t threads) {
  const std::size_t points = column.size() / replicates;
  SortedReplicates all{std::vector<std::span<const double>>(replicates)};
  on_threads(threads, replicates, [&](std::size_t i) {
    const std::span<double> replicate = column.subspan(i * points, points);
    std::sort(replicate.begin(), replicate.end());
    all.replicates[i] = replicate;
  });
  return all;
}

}  // namespace gearlash::detail
