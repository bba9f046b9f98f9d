// Recognises drives that creep: friction stops them, and integral action breaks them away ever
// later, or hardly ever.
#pragma once

#include <optional>
#include <vector>

#include "general/attractors/motion_watch.hpp"

namespace gearlash::drive {

/// A time in which neither shaft moves.
struct Standstill {
  double from = 0.0;   ///< s
  double to = 0.0;     ///< s
  double load = 0.0;   ///< rad, from the reference
  double motor = 0.0;  ///< rad

  double duration() const { return to - from; }
};

/// All of a motion, of which every turn is among the samples. Less than `small`, rad, is no move.
std::vector<Standstill> standstills(const std::vector<Sample>& load,
                                    const std::vector<Sample>& motor, double small);

/// s, of all together.
double duration_of(const std::vector<Standstill>& all);

/// The last standstill, if the position that is measured stands ever longer, ever nearer to the
/// reference, by one ratio within the gap, and each time for longer than a swing of the linear
/// loop. If slips are in proportion to the errors before them, all that follow shrink by that ratio
/// (Armstrong-Hélouvry & Amin 1996; Ruderman, arXiv 2006.08977). They are so if
///   dry friction stops the shaft, and has no stiction, by which slips have a size of their own;
///   the controller integrates the error, so that nothing else ends a standstill;
///   the error is neither rounded by an encoder nor shaped by a dead band or relay.
/// Empty where one of these does not hold.
std::optional<ShrinkingSteps> creeping(const Watch& watch, const SearchSetting& setting,
                                       const RestTolerances& tolerances);

/// Whether a drive with dry friction and no stiction has at last stood for many times as long as it
/// ever moved.
bool stands_for_long(const std::vector<Standstill>& all, const Watch& watch,
                     const SearchSetting& setting, const RestTolerances& tolerances);

/// Where the shafts stand on a cycle of a drive with dry friction and no stiction, if they move,
/// more than a share of its extent, for no more than that share of its period. Empty otherwise.
std::vector<Standstill> places_of_rest(const FoundCycle& cycle, const SearchSetting& setting,
                                       const RestTolerances& tolerances);

}  // namespace gearlash::drive
