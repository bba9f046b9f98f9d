// Quantiles of any number of values in little memory, the same whatever their order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "base/packed_numbers.hpp"
#include "base/special_numbers.hpp"

namespace gearlash {

/// Values counted in buckets, after Masson, Rim and Lee, "DDSketch: a fast and fully-mergeable
/// quantile sketch with relative-error guarantees", VLDB 2019. Every value from 2⁻¹⁰²² on has a
/// bucket by its sign, its exponent and the first 9 bits of its fraction: their logarithm
/// interpolated linearly within an octave. That needs no logarithm, so a value has the same bucket
/// on every machine; the buckets are at most as wide as those by powers of (1 + α)/(1 − α).
/// The counts are whole numbers, so equal values give equal sketches in any order, divided and
/// merged in any way. A bucket takes 8 bytes: 12 decades of values take 160 kB.
///
///   zero        counted by itself, with both zeros and what is smaller than 2⁻¹⁰²²
///   infinity    counted by itself, with its sign
///   not known   NaN is counted, and is no value
class QuantileSketch {
 public:
  /// α, with the rounding: a value between the extremes is reported within α of its size.
  static constexpr double relative_accuracy = 1.0 / 1024.0;

  void add(double value) { add(value, 1); }
  void add(double value, std::uint64_t count);
  void merge(const QuantileSketch& other);

  std::uint64_t size() const;                           ///< of all but NaN
  std::uint64_t not_known() const { return unknown_; }  ///< NaN
  std::uint64_t infinite_below() const { return infinite_[0]; }
  std::uint64_t infinite_above() const { return infinite_[1]; }
  std::uint64_t finite() const { return size() - infinite_[0] - infinite_[1]; }
  /// Exact; NaN where there is no value, or no finite one.
  double smallest() const;
  double largest() const;
  double smallest_finite() const { return finite() == 0 ? not_a_number : least_; }
  double largest_finite() const { return finite() == 0 ? not_a_number : most_; }

  /// The value of that rank among all, counted from 0 for the smallest, within relative_accuracy of
  /// the exact one; the first and the last are exact. Precondition: rank < size().
  double value_at(std::uint64_t rank) const;
  /// The value that a share of all does not exceed, 0 ≤ share ≤ 1, interpolated between the two
  /// values whose mid-ranks are nearest (Hazen). Within relative_accuracy of the larger of their
  /// sizes. NaN where there is none.
  double quantile(double share) const;

  /// Finite values from `low` on and below `high`; of zero both are 0.
  struct Bucket {
    double low = 0.0;
    double high = 0.0;
    std::uint64_t count = 0;
    bool operator==(const Bucket&) const = default;
  };
  /// Those with values, rising. Each octave is divided into `per_octave` of one width, a power of 2
  /// up to 512. Negative ones exclude `low` and include `high`.
  std::vector<Bucket> buckets(std::uint64_t per_octave = parts_of_octave) const;

  void pack(PackedNumbers& numbers) const;
  /// The sketch that was packed; false where the numbers are no sketch.
  bool unpack(UnpackedNumbers& numbers);

  bool operator==(const QuantileSketch&) const = default;

 private:
  static constexpr std::uint64_t parts_of_octave = 512;
  /// One sign's buckets: by exponent, and by part of the octave. Octaves without values are empty.
  using Octaves = std::vector<std::vector<std::uint64_t>>;

  void count_in(Octaves& octaves, std::uint64_t bucket, std::uint64_t count);
  void keep_extremes(double low, double high);

  Octaves negative_{};
  Octaves positive_{};
  std::uint64_t zeros_ = 0;
  std::uint64_t infinite_[2] = {0, 0};  ///< −∞, ∞
  std::uint64_t unknown_ = 0;
  std::uint64_t in_buckets_ = 0;  ///< of both signs
  double least_ = 0.0;            ///< of the finite values, if there are any
  double most_ = 0.0;
};

}  // namespace gearlash
