// Whether a target is met: by an answer, or by all drives of a box.
#pragma once

#include <limits>
#include <optional>

#include "base/special_numbers.hpp"
#include "gearlash/analyse.hpp"
#include "gearlash/design.hpp"
#include "model/answer_bounds.hpp"

namespace gearlash {

/// Whether all conditions are kept. An unknown value keeps no limit.
bool is_met(const Target& target, const Answer& answer);

/// Whether the verdict or growth at rest alone shows that the target is missed.
bool is_missed(const Target& target, const Answer& answer);

/// Whether it is known that the target is met or missed. It is unknown where a search for cycles
/// did not finish, or the motion does not repeat.
bool is_known(const Target& target, const Answer& answer);

/// Whether the target limits the load's amplitude, and nothing of its error, and an error in the
/// end is larger than it permits: met, and yet farther off than its reader may believe.
bool hides_error(const Target& target, double error);

/// ln(value/limit) of the limit closest to violation, or most violated. Except for rounding it is
/// ≤ 0 where all limits are kept. Growth at rest with the limit 1 represents no-hunting where it is
/// known; else a verdict that is not permitted counts as 1. −∞ where no value is near a limit, ∞
/// where a value cannot be compared with its limit.
double excess(const Target& target, const Answer& answer);

/// How many drives of a box keep all limits; `some`: unknown.
enum class Judgement { none, some, all };

/// Proved, as far as the bounds go.
Judgement judge(const Target& target, const AnswerBounds& bounds);

/// Whether a drive with backlash and this growth at rest misses the target, whatever its cycles.
bool is_ruled_out(const Target& target, double growth_at_rest);

/// What analyse() must compute for the target to be judged. Whether a drive hunts or runs away is
/// known from its starts alone. The largest stable cycle now and then is found only where what lies
/// between two starts is searched: limits of motion ask for that too.
Wanted wanted_for(const Target& target);

/// A target in two parts, which together are the target.
struct TargetParts {
  Target chosen{};
  Target others{};
};

/// Whether it asks for anything.
bool is_empty(const Target& target);
/// Whether the drive must come to rest, if only from small disturbances.
bool asks_for_rest(const Target& target);
/// The conditions on the verdict, and the limits of the quantities that are chosen.
TargetParts parts_of(const Target& target, bool (*is_chosen)(Quantity));

/// Whether the closed form bounds the quantity over boxes and computes it in lanes: growth at rest,
/// amplitude, frequency.
bool is_of_boxes(Quantity quantity);
bool is_of_boxes(const Target& target);
/// faults(target), and one for each limit that is not of boxes.
std::vector<Fault> faults_of_boxes(const Target& target);

}  // namespace gearlash
