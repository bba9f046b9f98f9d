// The values of one parameter with which a drive meets its target, all others as they are.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/design/changeable_drive.hpp"
#include "analysis/design/target.hpp"

namespace gearlash {

/// How sure it is that no feasible value is missing.
enum class SearchKind {
  certified,  ///< proved by bounds over every part of the range, but for slivers at its boundaries
  scanned     ///< looked for at many values, more of them where a limit is near: with bounces
};

/// A value, and what the drive does there.
struct TriedValue {
  double value = 0.0;
  Performance performance;
};

struct FeasibleValues {
  std::string parameter;  ///< ChangeableNumber::name
  double present = 0.0;
  Bounds searched;
  SearchKind kind = SearchKind::certified;
  /// All values that meet the target, as intervals from the smallest on. Their ends are the last
  /// numbers that meet it, to some 1e-15 of themselves (with bounces
  /// 1e-6 where the cycle ends at once), or the ends of the range.
  std::vector<Bounds> intervals;
  /// Parts of the range of which it is not known. Certified: as a rule a billionth of their own
  /// value wide; within them limits are touched or crossed twice; they are feasible if both of
  /// their ends are. Scanned: beside values whose motion does not repeat, or is too long to follow;
  /// there cycles, and with them feasible values, come and go in windows as narrow as one likes.
  std::vector<Bounds> undecided;
  /// Where nothing meets the target: the value that comes closest to it, of many that were tried.
  std::optional<TriedValue> closest;
  std::size_t evaluations = 0;  ///< of servos and of boxes

  bool contains(double value) const;
  /// The value that is nearest to the present one, by ratio; NaN where there is none.
  double nearest() const;
};

/// A feasible value is never skipped by certified search: the range is cut into boxes until the
/// limit cycles of each are proved to keep the target all, or none (bound_cycles()), or it is too
/// narrow to matter (1e-10, more where limits are nearly touched); between two that differ the end
/// of the interval is closed in on with performance_of(), so that each end put back meets the
/// target.
///
/// A scan, with bounces, tries 65 values, halves (six times at most) what lies between two of them
/// for as long as the distance to a limit changes there by more than it is, or the cycle of one is
/// known and that of the other not (twice everywhere that it hunts, where one is not), and follows
/// growth at rest, which is soon worked out, at 1,025 values. It can miss what is
/// narrower than the first of these steps; and it knows those cycles that analyse_limit_cycles()
/// finds. Backlash is not scanned: sizes are in proportion to it, and nothing else depends on it.
///
/// Precondition: validate(target) is empty. Throws InvalidInput for a number that the drive has
/// not.
FeasibleValues feasible_values(const ChangeableDrive& drive, std::string_view parameter,
                               const Target& target);

}  // namespace gearlash
