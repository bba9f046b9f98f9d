#include "analysis/grid/reduced_grid.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/grid/axis.hpp"
#include "analysis/grid/grid_evaluation.hpp"

namespace gearlash {
namespace {

constexpr std::uint64_t format_of_state = 1;

std::size_t index_of(Verdict verdict) { return static_cast<std::size_t>(verdict); }

/// The smaller value, or the larger one for `sign` −1; of equal ones the first point.
void keep_extreme(std::optional<Extreme>& kept, double sign, const Extreme& one) {
  if (!kept || sign * one.value < sign * kept->value) kept = one;
}

void pack(PackedNumbers& numbers, const std::optional<Extreme>& extreme) {
  numbers.add(extreme ? 1 : 0);
  if (!extreme) return;
  numbers.add_double(extreme->value);
  numbers.add(extreme->point);
}

bool unpack(UnpackedNumbers& numbers, std::optional<Extreme>& extreme) {
  extreme.reset();
  const std::optional<std::uint64_t> is_there = numbers.next();
  if (!is_there) return false;
  if (*is_there == 0) return true;
  const std::optional<double> value = numbers.next_double();
  const std::optional<std::uint64_t> point = numbers.next();
  if (!point) return false;
  extreme = {*value, *point};
  return true;
}

bool unpack(UnpackedNumbers& numbers, std::uint64_t& number) {
  const std::optional<std::uint64_t> read = numbers.next();
  if (read) number = *read;
  return read.has_value();
}

bool unpack(UnpackedNumbers& numbers, Verdict& verdict) {
  std::uint64_t number = 0;
  if (!unpack(numbers, number) || number >= verdict_count) return false;
  verdict = static_cast<Verdict>(number);
  return true;
}

}  // namespace

/// Points of one line along the last axis.
struct ReducedGrid::Segment {
  std::uint64_t first = 0;
  std::span<const Verdict> verdicts;
};

ReducedGrid::ReducedGrid(const Grid& grid, const std::vector<Quantity>& quantities,
                         const Kept& kept)
    : kept_(kept) {
  std::size_t stride = grid.size();
  for (const Axis& axis : grid.axes) {
    stride /= axis.values.size();
    axes_.push_back({.values = axis.values.size(),
                     .stride = stride,
                     .has_order = parameter_of(axis, grid.drive)->choices.empty()});
  }
  if (kept.counts) {
    for (const GridAxis& axis : axes_) by_axis_.emplace_back(axis.values);
  }
  if (kept.of_quantities()) {
    for (const Quantity quantity : quantities) quantities_.push_back({.quantity = quantity});
  }
  if (kept.border && !axes_.empty()) {
    last_verdicts_.assign(axes_.front().stride, Verdict::undecided);
  }
}

void ReducedGrid::add(const Table& table) {
  const std::span<const Verdict> verdicts = table.verdicts();
  for (ReducedQuantity& reduced : quantities_) add_values(table, reduced);
  const std::size_t line = axes_.empty() ? verdicts.size() : axes_.back().values;
  for (std::size_t row = 0; row < verdicts.size();) {
    const std::size_t left = line - points_ % line;
    const Segment segment{points_, verdicts.subspan(row, std::min(left, verdicts.size() - row))};
    add_segment(segment);
    row += segment.verdicts.size();
    points_ += segment.verdicts.size();
  }
}

void ReducedGrid::add_segment(const Segment& segment) {
  add_counts(segment);
  if (kept_.border && !is_border_too_long_) add_border(segment);
}

void ReducedGrid::add_counts(const Segment& segment) {
  VerdictCounts here{};
  for (const Verdict verdict : segment.verdicts) ++here[index_of(verdict)];
  for (std::size_t i = 0; i < verdict_count; ++i) counts_[i] += here[i];
  if (by_axis_.empty()) return;
  for (std::size_t k = 0; k + 1 < axes_.size(); ++k) {
    VerdictCounts& of_value = by_axis_[k][segment.first / axes_[k].stride % axes_[k].values];
    for (std::size_t i = 0; i < verdict_count; ++i) of_value[i] += here[i];
  }
  const std::size_t place = segment.first % axes_.back().values;
  for (std::size_t j = 0; j < segment.verdicts.size(); ++j) {
    ++by_axis_.back()[place + j][index_of(segment.verdicts[j])];
  }
}

/// The points of the segment whose verdicts differ from those of their neighbors below on the axis.
void ReducedGrid::add_differing(const Segment& segment, const GridAxis& axis,
                                const Verdict* neighbors) {
  const std::span<const Verdict> verdicts = segment.verdicts;
  if (std::equal(verdicts.begin(), verdicts.end(), neighbors)) return;
  for (std::size_t j = 0; j < verdicts.size(); ++j) {
    if (verdicts[j] == neighbors[j]) continue;
    border_.emplace_back(segment.first + j - axis.stride, neighbors[j]);
    border_.emplace_back(segment.first + j, verdicts[j]);
  }
}

void ReducedGrid::add_border(const Segment& segment) {
  const std::size_t place = segment.first % last_verdicts_.size();
  Verdict* const here = last_verdicts_.data() + place;
  const std::span<const Verdict> verdicts = segment.verdicts;
  for (std::size_t k = 0; k < axes_.size(); ++k) {
    const GridAxis& axis = axes_[k];
    if (!axis.has_order) continue;
    const bool is_last = k + 1 == axes_.size();
    if (is_last) {
      if (verdicts.size() > 1) {
        add_differing({segment.first + 1, verdicts.subspan(1)}, axis, verdicts.data());
      }
      if (segment.first % axis.values == 0) continue;
      // With one axis only the last verdict of all is kept.
      add_differing({segment.first, verdicts.first(1)}, axis, k == 0 ? here : here - 1);
    } else if (segment.first / axis.stride % axis.values > 0) {
      // Along the first axis the neighbors' verdicts are those that are about to be replaced.
      add_differing(segment, axis, k == 0 ? here : here - axis.stride);
    }
  }
  if (axes_.size() == 1) {
    *here = verdicts.back();
  } else {
    std::copy(verdicts.begin(), verdicts.end(), here);
  }
  constexpr std::size_t few = 1U << 16U;
  if (border_.size() > std::max(few, 2 * tidy_)) tidy_border();
}

void ReducedGrid::tidy_border() {
  const auto first_untidy = border_.begin() + static_cast<std::ptrdiff_t>(tidy_);
  if (first_untidy == border_.end()) return;
  std::sort(first_untidy, border_.end());
  std::inplace_merge(border_.begin(), first_untidy, border_.end());
  border_.erase(std::unique(border_.begin(), border_.end()), border_.end());
  tidy_ = border_.size();
  if (tidy_ <= most_border_points) return;
  is_border_too_long_ = true;
  border_ = {};
  tidy_ = 0;
}

const std::vector<BorderPoint>& ReducedGrid::border() {
  tidy_border();
  return border_;
}

void ReducedGrid::add_values(const Table& table, ReducedQuantity& reduced) const {
  const std::span<const double> values = table[reduced.quantity];
  const std::span<const Verdict> verdicts = table.verdicts();
  for (std::size_t row = 0; row < values.size(); ++row) {
    const double value = of_motion(reduced.quantity, verdicts[row], values[row]);
    if (std::isnan(value)) continue;
    ++reduced.known;
    if (kept_.sketches()) reduced.sketch.add(value);
    if (!kept_.extremes) continue;
    const Extreme one{value, points_ + row};
    keep_extreme(reduced.smallest, 1.0, one);
    keep_extreme(reduced.largest, -1.0, one);
  }
}

std::string ReducedGrid::packed() {
  PackedNumbers numbers;
  numbers.add(format_of_state);
  numbers.add(points_);
  for (const std::uint64_t count : counts_) numbers.add(count);
  for (const std::vector<VerdictCounts>& of_axis : by_axis_) {
    for (const VerdictCounts& of_value : of_axis) {
      for (const std::uint64_t count : of_value) numbers.add(count);
    }
  }
  for (const ReducedQuantity& reduced : quantities_) {
    numbers.add(reduced.known);
    pack(numbers, reduced.smallest);
    pack(numbers, reduced.largest);
    reduced.sketch.pack(numbers);
  }
  // Runs of one verdict.
  for (std::size_t i = 0; i < last_verdicts_.size();) {
    std::size_t end = i;
    while (end < last_verdicts_.size() && last_verdicts_[end] == last_verdicts_[i]) ++end;
    numbers.add(end - i);
    numbers.add(index_of(last_verdicts_[i]));
    i = end;
  }
  numbers.add(is_border_too_long_ ? 1 : 0);
  std::uint64_t next = 0;
  numbers.add(border().size());
  for (const BorderPoint& point : border_) {
    numbers.add(point.point() - next);
    numbers.add(index_of(point.verdict()));
    next = point.point() + 1;
  }
  return std::move(numbers).text();
}

bool ReducedGrid::unpack(std::string_view text) {
  UnpackedNumbers numbers(text);
  std::uint64_t format = 0;
  if (!gearlash::unpack(numbers, format) || format != format_of_state) return false;
  if (!gearlash::unpack(numbers, points_)) return false;
  if (!unpack_counts(numbers, {&counts_, 1})) return false;
  for (std::vector<VerdictCounts>& of_axis : by_axis_) {
    if (!unpack_counts(numbers, of_axis)) return false;
  }
  for (ReducedQuantity& reduced : quantities_) {
    if (!gearlash::unpack(numbers, reduced.known) || !gearlash::unpack(numbers, reduced.smallest) ||
        !gearlash::unpack(numbers, reduced.largest) || !reduced.sketch.unpack(numbers)) {
      return false;
    }
  }
  return unpack_border(numbers) && numbers.is_at_end();
}

/// They count all points.
bool ReducedGrid::unpack_counts(UnpackedNumbers& numbers, std::span<VerdictCounts> counts) const {
  std::uint64_t counted = 0;
  for (VerdictCounts& of_value : counts) {
    for (std::uint64_t& count : of_value) {
      if (!gearlash::unpack(numbers, count)) return false;
      counted += count;
    }
  }
  return counted == points_;
}

bool ReducedGrid::unpack_border(UnpackedNumbers& numbers) {
  for (std::size_t i = 0; i < last_verdicts_.size();) {
    std::uint64_t run = 0;
    Verdict verdict{};
    if (!gearlash::unpack(numbers, run) || !gearlash::unpack(numbers, verdict)) return false;
    if (run == 0 || run > last_verdicts_.size() - i) return false;
    std::fill_n(last_verdicts_.begin() + static_cast<std::ptrdiff_t>(i), run, verdict);
    i += run;
  }
  std::uint64_t too_long = 0;
  std::uint64_t count = 0;
  if (!gearlash::unpack(numbers, too_long) || !gearlash::unpack(numbers, count)) return false;
  if (count > most_border_points) return false;
  is_border_too_long_ = too_long == 1;
  border_.clear();
  std::uint64_t next = 0;
  for (std::uint64_t i = 0; i < count; ++i) {
    std::uint64_t skipped = 0;
    Verdict verdict{};
    if (!gearlash::unpack(numbers, skipped) || !gearlash::unpack(numbers, verdict)) return false;
    border_.emplace_back(next + skipped, verdict);
    next += skipped + 1;
  }
  tidy_ = border_.size();
  return true;
}

}  // namespace gearlash
