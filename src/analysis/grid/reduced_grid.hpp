// What is kept of a grid whose points are too many to keep: counts, extremes, quantiles, the
// border.
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "gearlash/grid.hpp"
#include "numeric/quantile_sketch.hpp"

namespace gearlash {

/// What to keep. Nothing: every point is kept.
struct Kept {
  bool counts = false;      ///< points by verdict, in all and for each value of each axis
  bool extremes = false;    ///< the smallest and the largest value of each quantity, and where
  bool histograms = false;  ///< of each quantity, over bins of one eighth of an octave
  bool quantiles = false;   ///< of each quantity
  bool border = false;      ///< the points whose verdict differs from a neighbor's along an axis

  bool anything() const { return counts || of_quantities() || border; }
  bool of_quantities() const { return extremes || histograms || quantiles; }
  bool sketches() const { return histograms || quantiles; }
  bool operator==(const Kept&) const = default;
};

inline constexpr std::size_t verdict_count = static_cast<std::size_t>(Verdict::undecided) + 1;
using VerdictCounts = std::array<std::uint64_t, verdict_count>;

/// A value and the first point of the grid that has it.
struct Extreme {
  double value = 0.0;
  std::uint64_t point = 0;
  bool operator==(const Extreme&) const = default;
};

/// Of the points at which a quantity is known. Quantities of a motion are known where there is one:
/// a drive that comes to rest has none, and is not counted with amplitude 0.
struct ReducedQuantity {
  Quantity quantity{};
  std::uint64_t known = 0;
  std::optional<Extreme> smallest{};
  std::optional<Extreme> largest{};
  QuantileSketch sketch{};  ///< empty unless histograms or quantiles are kept

  bool operator==(const ReducedQuantity&) const = default;
};

/// A point of the grid and its verdict, in eight bytes.
class BorderPoint {
 public:
  BorderPoint(std::uint64_t point, Verdict verdict)
      : bits_(point << verdict_bits | static_cast<std::uint64_t>(verdict)) {}
  std::uint64_t point() const { return bits_ >> verdict_bits; }
  Verdict verdict() const { return static_cast<Verdict>(bits_ & ((1U << verdict_bits) - 1U)); }
  auto operator<=>(const BorderPoint&) const = default;

 private:
  static constexpr unsigned verdict_bits = 4;
  static_assert(verdict_count <= 1U << verdict_bits);
  std::uint64_t bits_;
};

/// Takes the points of a grid in order, in pieces of any length. All that is kept is whole numbers
/// or values of points: the same for any division into pieces, and any number of threads.
///
/// Memory, bytes: 88 for each value on an axis with counts, 160,000 for each quantity over 12
/// decades with histograms or quantiles, and for the border one for each point that shares a value
/// of the first axis, and up to 30 for each point kept.
class ReducedGrid {
 public:
  /// Precondition: faults(grid) is empty, kept.anything().
  ReducedGrid(const Grid& grid, const std::vector<Quantity>& quantities, const Kept& kept);

  /// The next points: as many as the table has rows.
  void add(const Table& table);

  const Kept& kept() const { return kept_; }
  std::uint64_t points() const { return points_; }
  const VerdictCounts& counts() const { return counts_; }
  /// By axis and value; empty unless counts are kept.
  const std::vector<std::vector<VerdictCounts>>& counts_by_axis() const { return by_axis_; }
  const std::vector<ReducedQuantity>& quantities() const { return quantities_; }
  /// Rising. Neighbors along an axis of words do not count, for words have no order.
  const std::vector<BorderPoint>& border();
  /// Of more points the border is not kept.
  static constexpr std::size_t most_border_points = 20'000'000;
  bool is_border_too_long() const { return is_border_too_long_; }

  /// The state, to go on from later.
  std::string packed();
  /// False where the text is no state of such a reduction; nothing holds then.
  bool unpack(std::string_view text);

 private:
  struct GridAxis {
    std::size_t values = 0;
    std::size_t stride = 0;  ///< points from one value to the next
    bool has_order = true;   ///< false for words
    bool operator==(const GridAxis&) const = default;
  };
  struct Segment;

  void add_segment(const Segment& segment);
  void add_counts(const Segment& segment);
  void add_border(const Segment& segment);
  void add_differing(const Segment& segment, const GridAxis& axis, const Verdict* neighbors);
  void add_values(const Table& table, ReducedQuantity& reduced) const;
  void tidy_border();
  bool unpack_counts(UnpackedNumbers& numbers, std::span<VerdictCounts> counts) const;
  bool unpack_border(UnpackedNumbers& numbers);

  Kept kept_;
  std::vector<GridAxis> axes_;
  std::uint64_t points_ = 0;
  VerdictCounts counts_{};
  std::vector<std::vector<VerdictCounts>> by_axis_;
  std::vector<ReducedQuantity> quantities_;
  /// For the border: the last verdict at each place of the axes but the first.
  std::vector<Verdict> last_verdicts_;
  std::vector<BorderPoint> border_;  ///< the first `tidy_` rise, each once
  std::size_t tidy_ = 0;
  bool is_border_too_long_ = false;
};

}  // namespace gearlash
