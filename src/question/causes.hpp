// What a drive's motion in the end is due to: the same drive without its gap, friction, encoder …
#pragma once

#include <optional>
#include <vector>

#include "gearlash/answer.hpp"
#include "gearlash/drive.hpp"
#include "gearlash/progress.hpp"

namespace gearlash {

struct Analysis;
struct Wanted;

/// The drive without the cause. The gap is taken down to a thousandth, because both shafts stay
/// two; registers of a firmware are converted first. A sampled controller loses its delay, and is
/// continuous where it can be: without an encoder, and in s. Empty where the drive has no such
/// thing, or would be faulty without it.
std::optional<Drive> without(const Drive& drive, Cause cause);

/// The drive without each of its causes, followed from the smallest displacements of the search and
/// from two starts that swing. Without the gap, motion that shrinks with it counts as rest. Stopped
/// by Progress, those that are known by then.
std::vector<Without> without_causes(const Drive& drive, const Analysis& analysis,
                                    const Wanted& wanted, Progress& progress);

/// Where a start of the search runs away, and does not without integral action: by its name and
/// with its cure. By Answer::without.
std::optional<Note> note_on_wind_up(const Drive& drive, const Analysis& analysis,
                                    Progress& progress);

/// Answer::is_quantization, by Answer::without.
std::optional<bool> is_quantization(const Answer& answer);

/// Answer::specification, by the other members.
std::optional<SpecificationAnswer> judged_specification(const Drive& drive, const Answer& answer);

}  // namespace gearlash
