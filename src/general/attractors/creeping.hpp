// Recognises drives that creep: friction stops them, and integral action breaks them away ever
// later, or hardly ever.
#pragma once

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

/// Whether a drive without stiction stands ever longer, the position that is measured slips ever
/// less in between, and the motor by much less than the gap. A slip is then in proportion to the
/// error before it, so that all that follow shrink by one ratio (Armstrong-Hélouvry & Amin 1996;
/// Ruderman, arXiv 2006.08977). Where the load is measured, the next slip must not begin with a
/// crossing of the gap, if the last did not. With stiction slips have a size of their own.
bool is_creeping(const std::vector<Standstill>& all, const Watch& watch,
                 const SearchSetting& setting, const RestTolerances& tolerances);

/// Whether a drive without stiction has at last stood for many times as long as it ever moved.
bool stands_for_long(const std::vector<Standstill>& all, const Watch& watch,
                     const SearchSetting& setting, const RestTolerances& tolerances);

/// Where the shafts stand on a cycle of a drive without stiction, if they move, more than a share
/// of its extent, for no more than that share of its period. Empty otherwise.
std::vector<Standstill> places_of_rest(const FoundCycle& cycle, const SearchSetting& setting,
                                       const RestTolerances& tolerances);

}  // namespace gearlash::drive
