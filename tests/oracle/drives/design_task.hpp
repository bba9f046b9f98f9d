// Random tasks of design for industrial drives, and their answers put back into the drives.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "gearlash/design.hpp"
#include "gearlash/drive.hpp"
#include "gearlash/grid.hpp"

namespace gearlash::oracle {

/// Gains, inertias, frictions, the gap, the stiffness of the faces, sampling, delay and resolution,
/// as far as the drive has them and they are above 0.
[[nodiscard]] std::vector<std::string_view> numbers_of(const Drive& drive);

struct DesignTask {
  Drive drive{};
  Axis axis{};
  Target target{};
  std::string text{};  ///< what is asked, for a reader
};

/// One seed, one task: of even seeds a drive with a computer (random_drive()), of odd ones a
/// continuous one (continuous_drive()); one of numbers_of() it, at nine values by ratio from a
/// fifth of the present one to five times; and a target of any kind, half of them of two limits.
[[nodiscard]] DesignTask random_design_task(std::uint64_t seed);

/// What does not hold of an answer.
struct DesignCheck {
  FeasibleValues found{};
  std::size_t judged = 0;  ///< values at which the drive was analysed afresh, by itself
  std::size_t values_in_intervals = 0;
  /// Ends of intervals that miss the target. None is permitted.
  std::vector<double> ends_that_miss{};
  /// Values a thousandth within an interval, and in its middle, that miss it: something narrower
  /// than the grid lies there.
  std::vector<double> inner_that_miss{};
  /// The first of five values in a row, a quarter of the grid's distance apart, that meet the
  /// target and are not listed: as wide as the distance. None is permitted.
  std::vector<double> missed{};
};

/// Answers the task, analyses the drive afresh at ends, just inside them and in the middle of each
/// interval, and at four values for each of the grid.
[[nodiscard]] DesignCheck checked_design(const DesignTask& task);

}  // namespace gearlash::oracle
