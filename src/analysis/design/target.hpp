// How a servo does by a target.
#pragma once

#include <limits>

#include "analysis/design/changeable_drive.hpp"
#include "base/special_numbers.hpp"
#include "closed_form/limit_cycle.hpp"
#include "gearlash/design.hpp"

namespace gearlash {

/// What a target is compared with.
struct Performance {
  Verdict verdict = Verdict::undecided;
  double growth_at_rest = std::numeric_limits<double>::quiet_NaN();
  double amplitude = std::numeric_limits<double>::quiet_NaN();  ///< rad; 0 where it cannot hunt
  double frequency = std::numeric_limits<double>::quiet_NaN();  ///< Hz; NaN where it cannot hunt
  double flight_time =
      std::numeric_limits<double>::quiet_NaN();  ///< of half a plastic cycle, ω_n t
};

/// By analyse_limit_cycles(). Throws InvalidInput.
Performance performance_of(const Drivetrain& drive);

/// Whether a drive with backlash, of this growth at rest, misses the target whatever its cycles
/// are.
bool is_ruled_out(const Target& target, double growth_at_rest);

/// As performance_of(), as far as the target asks for it: with bounces the search for cycles, which
/// takes milliseconds, is left out where the growth at rest rules the drive out. The verdict is
/// then `hunts` or `undecided`, and the rest NaN. Throws InvalidInput.
Performance performance_for(const Target& target, const Drivetrain& drive);

/// Whether all limits are kept. What is not known keeps none.
bool is_met(const Target& target, const Performance& performance);

/// Whether it is known that the target is met, or missed: not where a search for cycles came to no
/// end, or motion does not repeat.
bool is_known(const Target& target, const Performance& performance);

/// ln(value/limit) of the limit that is kept least, but for rounding ≤ 0 where all are kept;
/// growth at rest stands for no-hunting, whose limit is 1. −∞ where nothing comes near a limit, ∞
/// where a limit cannot be compared with.
double excess(const Target& target, const Performance& performance);

/// How many of the drives of a box keep all limits; `some`: that is not known.
enum class Judgement { none, some, all };

/// By bound_cycles(): proved. The guess is as there.
Judgement judge(const Target& target, const DriveBox& box, double guessed_flight_time);

}  // namespace gearlash
