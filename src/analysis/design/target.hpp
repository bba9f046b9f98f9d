// The performance of a servo compared with a target.
#pragma once

#include <limits>

#include "analysis/design/changeable_drive.hpp"
#include "base/special_numbers.hpp"
#include "closed_form/limit_cycle.hpp"
#include "gearlash/design.hpp"

namespace gearlash {

/// The values that a target limits.
struct Performance {
  Verdict verdict = Verdict::undecided;
  double growth_at_rest = std::numeric_limits<double>::quiet_NaN();
  double amplitude = std::numeric_limits<double>::quiet_NaN();  ///< rad; 0 where it cannot hunt
  double frequency = std::numeric_limits<double>::quiet_NaN();  ///< Hz; NaN where it cannot hunt
  double flight_time =
      std::numeric_limits<double>::quiet_NaN();  ///< of half a plastic cycle, ω_n t
};

/// The performance that analyse_limit_cycles() gives. Throws InvalidInput.
Performance performance_of(const Drivetrain& drive);

/// Whether a drive with backlash and this growth at rest misses the target, whatever its cycles.
bool is_ruled_out(const Target& target, double growth_at_rest);

/// performance_of(), computed only as far as the target needs it. With bounces, the search for
/// cycles takes milliseconds and is skipped where the growth at rest rules the drive out. The
/// verdict is then `hunts` or `undecided`, and the rest NaN. Throws InvalidInput.
Performance performance_for(const Target& target, const Drivetrain& drive);

/// Whether all limits are kept. An unknown value keeps no limit.
bool is_met(const Target& target, const Performance& performance);

/// Whether it is known that the target is met or missed. It is unknown where a search for cycles
/// did not finish, or the motion does not repeat.
bool is_known(const Target& target, const Performance& performance);

/// ln(value/limit) of the limit closest to violation, or most violated. Except for rounding it is
/// ≤ 0 where all limits are kept. Growth at rest with the limit 1 represents no-hunting. −∞ where
/// no value is near a limit, ∞ where a value cannot be compared with its limit.
double excess(const Target& target, const Performance& performance);

/// How many drives of a box keep all limits; `some`: unknown.
enum class Judgement { none, some, all };

/// Proved, by bound_cycles(), which takes the guess.
Judgement judge(const Target& target, const DriveBox& box, double guessed_flight_time);

}  // namespace gearlash
