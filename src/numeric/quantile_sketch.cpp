#include "numeric/quantile_sketch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/bits_of_double.hpp"
#include "base/special_numbers.hpp"

namespace gearlash {
namespace {

constexpr unsigned fraction_bits = 52;
constexpr unsigned part_bits = 9;  // of the fraction
constexpr unsigned dropped_bits = fraction_bits - part_bits;
constexpr std::uint64_t parts = std::uint64_t{1} << part_bits;
constexpr std::uint64_t octaves_of_doubles = 2047;  // by biased exponent, infinity's left out
constexpr std::uint64_t all_buckets = octaves_of_doubles * parts;

/// Of a positive normal number.
std::uint64_t bucket_of(double size) { return bits_of(size) >> dropped_bits; }

double low_end(std::uint64_t bucket) { return double_of_bits(bucket << dropped_bits); }

/// 2ab/(a + b) for a bucket from a to b, which is off by (b − a)/(a + b) at either end. With
/// a = m 2ᵉ and b − a = 2ᵉ/512 it is a (1 + 1/(1024 m + 1)).
double middle_of(std::uint64_t bucket) {
  const auto of_octave = static_cast<double>(parts + bucket % parts);  // 512 m
  return low_end(bucket) * (1.0 + 1.0 / (2.0 * of_octave + 1.0));
}

/// Calls visit(bucket, count) for those with values, the smallest first. True from it ends the
/// walk.
template <class Octaves, class Visit>
bool walk_up(const Octaves& octaves, const Visit& visit) {
  for (std::size_t octave = 0; octave < octaves.size(); ++octave) {
    for (std::size_t part = 0; part < octaves[octave].size(); ++part) {
      const std::uint64_t count = octaves[octave][part];
      if (count > 0 && visit(octave * parts + part, count)) return true;
    }
  }
  return false;
}
template <class Octaves, class Visit>
bool walk_down(const Octaves& octaves, const Visit& visit) {
  for (std::size_t octave = octaves.size(); octave-- > 0;) {
    for (std::size_t part = octaves[octave].size(); part-- > 0;) {
      const std::uint64_t count = octaves[octave][part];
      if (count > 0 && visit(octave * parts + part, count)) return true;
    }
  }
  return false;
}

}  // namespace

static_assert(QuantileSketch::relative_accuracy > 1.0 / (2.0 * parts + 1.0));

void QuantileSketch::count_in(Octaves& octaves, std::uint64_t bucket, std::uint64_t count) {
  if (octaves.empty()) octaves.resize(octaves_of_doubles);
  std::vector<std::uint64_t>& octave = octaves[static_cast<std::size_t>(bucket / parts)];
  if (octave.empty()) octave.resize(parts);
  octave[static_cast<std::size_t>(bucket % parts)] += count;
  in_buckets_ += count;
}

void QuantileSketch::keep_extremes(double low, double high) {
  const bool is_first = finite() == 0;
  least_ = is_first ? low : std::min(least_, low);
  most_ = is_first ? high : std::max(most_, high);
}

void QuantileSketch::add(double value, std::uint64_t count) {
  if (count == 0) return;
  if (std::isnan(value)) {
    unknown_ += count;
    return;
  }
  if (std::isinf(value)) {
    infinite_[value > 0.0 ? 1 : 0] += count;
    return;
  }
  if (std::abs(value) < std::numeric_limits<double>::min()) {
    keep_extremes(0.0, 0.0);
    zeros_ += count;
    return;
  }
  keep_extremes(value, value);
  count_in(value > 0.0 ? positive_ : negative_, bucket_of(std::abs(value)), count);
}

void QuantileSketch::merge(const QuantileSketch& other) {
  if (other.finite() > 0) keep_extremes(other.least_, other.most_);
  const auto add_to = [&](Octaves& octaves) {
    return [&](std::uint64_t bucket, std::uint64_t count) {
      count_in(octaves, bucket, count);
      return false;
    };
  };
  walk_up(other.negative_, add_to(negative_));
  walk_up(other.positive_, add_to(positive_));
  zeros_ += other.zeros_;
  infinite_[0] += other.infinite_[0];
  infinite_[1] += other.infinite_[1];
  unknown_ += other.unknown_;
}

std::uint64_t QuantileSketch::size() const {
  return in_buckets_ + zeros_ + infinite_[0] + infinite_[1];
}

double QuantileSketch::smallest() const { return value_at(0); }
double QuantileSketch::largest() const { return size() == 0 ? not_a_number : value_at(size() - 1); }

double QuantileSketch::value_at(std::uint64_t rank) const {
  if (size() == 0) return not_a_number;
  if (rank < infinite_[0]) return -infinity;
  rank -= infinite_[0];
  if (rank >= finite()) return infinity;
  if (rank == 0) return least_;
  if (rank + 1 == finite()) return most_;
  double value = 0.0;
  const auto find = [&](double sign) {
    return [&, sign](std::uint64_t bucket, std::uint64_t count) {
      value = sign * middle_of(bucket);
      if (rank < count) return true;
      rank -= count;
      return false;
    };
  };
  if (!walk_down(negative_, find(-1.0))) {
    if (rank < zeros_) return 0.0;
    rank -= zeros_;
    walk_up(positive_, find(1.0));
  }
  return std::clamp(value, least_, most_);
}

double QuantileSketch::quantile(double share) const {
  if (size() == 0) return not_a_number;
  const auto last = static_cast<double>(size() - 1);
  const double rank = std::clamp(share * static_cast<double>(size()) - 0.5, 0.0, last);
  const double whole = std::floor(rank);
  const double low = value_at(static_cast<std::uint64_t>(whole));
  if (rank == whole) return low;
  const double high = value_at(static_cast<std::uint64_t>(whole) + 1);
  return high == low ? low : low + (rank - whole) * (high - low);
}

std::vector<QuantileSketch::Bucket> QuantileSketch::buckets(std::uint64_t per_octave) const {
  const std::uint64_t joined = parts / per_octave;
  std::vector<Bucket> all;
  const auto put = [&](double low, double high, std::uint64_t count) {
    if (!all.empty() && all.back().low == low) {
      all.back().count += count;
    } else {
      all.push_back({low, high, count});
    }
  };
  walk_down(negative_, [&](std::uint64_t bucket, std::uint64_t count) {
    const std::uint64_t first = bucket / joined * joined;
    put(-low_end(first + joined), -low_end(first), count);
    return false;
  });
  if (zeros_ > 0) put(0.0, 0.0, zeros_);
  walk_up(positive_, [&](std::uint64_t bucket, std::uint64_t count) {
    const std::uint64_t first = bucket / joined * joined;
    put(low_end(first), low_end(first + joined), count);
    return false;
  });
  return all;
}

void QuantileSketch::pack(PackedNumbers& numbers) const {
  for (const std::uint64_t count : {zeros_, infinite_[0], infinite_[1], unknown_}) {
    numbers.add(count);
  }
  numbers.add_double(least_);
  numbers.add_double(most_);
  for (const Octaves* octaves : {&negative_, &positive_}) {
    std::uint64_t next = 0;
    walk_up(*octaves, [&](std::uint64_t bucket, std::uint64_t count) {
      numbers.add(count);
      numbers.add(bucket - next);
      next = bucket + 1;
      return false;
    });
    numbers.add(0);  // no more
  }
}

bool QuantileSketch::unpack(UnpackedNumbers& numbers) {
  *this = {};
  for (std::uint64_t* count : {&zeros_, &infinite_[0], &infinite_[1], &unknown_}) {
    const std::optional<std::uint64_t> read = numbers.next();
    if (!read) return false;
    *count = *read;
  }
  const std::optional<double> least = numbers.next_double();
  const std::optional<double> most = numbers.next_double();
  for (Octaves* octaves : {&negative_, &positive_}) {
    std::uint64_t next = 0;
    while (true) {
      const std::optional<std::uint64_t> count = numbers.next();
      if (!count) return false;
      if (*count == 0) break;
      const std::optional<std::uint64_t> skipped = numbers.next();
      if (!skipped || *skipped >= all_buckets || next + *skipped >= all_buckets) return false;
      count_in(*octaves, next + *skipped, *count);
      next += *skipped + 1;
    }
  }
  least_ = *least;
  most_ = *most;
  return true;
}

}  // namespace gearlash
