// What is measured of motion that does not repeat.
#pragma once

#include <string>
#include <vector>

#include "general/attractors/motion_watch.hpp"

namespace gearlash::drive {

/// The last stretch of a motion as irregular motion, without its exponent; or why it is none. A
/// motion may have been stopped by the limit of events.
struct Irregularity {
  IrregularFound found{};
  std::string reason{};  ///< empty where it is irregular
};
Irregularity irregularity_of(const Watch& watch, const hybrid::Trajectory& stretch,
                             const SearchSetting& setting, const SearchTolerances& tolerances,
                             bool is_out_of_events);

/// Among those that are known one that is much the same; their number where there is none.
std::size_t place_among(const std::vector<IrregularFound>& known, const IrregularFound& found,
                        const IrregularTolerances& tolerances);

}  // namespace gearlash::drive
