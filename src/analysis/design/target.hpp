// The performance of a servo compared with a target.
#pragma once

#include <limits>
#include <optional>

#include "analysis/design/changeable_drive.hpp"
#include "base/special_numbers.hpp"
#include "closed_form/limit_cycle.hpp"
#include "gearlash/analyse.hpp"
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

  /// Growth at rest, amplitude or frequency. Empty if it is unknown, and of other quantities.
  std::optional<double> value(Quantity quantity) const;
};

/// The performance that analyse_limit_cycles() gives. Throws InvalidInput.
Performance performance_of(const Drivetrain& drive);

/// Whether a drive with backlash and this growth at rest misses the target, whatever its cycles.
bool is_ruled_out(const Target& target, double growth_at_rest);

/// performance_of(), computed only as far as the target needs it. With bounces, the search for
/// cycles takes milliseconds and is skipped where the growth at rest rules the drive out. The
/// verdict is then `hunts` or `undecided`, and the rest NaN. Throws InvalidInput.
Performance performance_for(const Target& target, const Drivetrain& drive);

/// What analyse() must compute for the target to be judged, of `base` and of drives with other
/// values: see ask_for(). Whether a drive hunts or runs away is known from its starts alone. The
/// largest stable cycle now and then is found only where what lies between two starts is searched:
/// limits of motion ask for that too.
Wanted wanted_for(const Target& target, const Drive& base);

/// Whether the closed form's performance shows if a target is met: its limits are of growth at
/// rest, amplitude and frequency alone.
bool is_of_performance(const Target& target);

/// faults(target), and one for each limit that the closed form's performance does not show.
std::vector<Fault> faults_for_performance(const Target& target);

// `Judged` is Performance or Answer.

/// Whether all conditions are kept. An unknown value keeps no limit.
template <class Judged>
bool is_met(const Target& target, const Judged& judged);

/// Whether it is known that the target is met or missed. It is unknown where a search for cycles
/// did not finish, or the motion does not repeat.
template <class Judged>
bool is_known(const Target& target, const Judged& judged);

/// ln(value/limit) of the limit closest to violation, or most violated. Except for rounding it is
/// ≤ 0 where all limits are kept. Growth at rest with the limit 1 represents no-hunting where it is
/// known; else a verdict that is not permitted counts as 1. −∞ where no value is near a limit, ∞
/// where a value cannot be compared with its limit.
template <class Judged>
double excess(const Target& target, const Judged& judged);

/// How many drives of a box keep all limits; `some`: unknown.
enum class Judgement { none, some, all };

/// Proved, by bound_cycles(), which takes the guess.
Judgement judge(const Target& target, const DriveBox& box, double guessed_flight_time);

}  // namespace gearlash
