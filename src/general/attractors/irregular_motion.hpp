// Measures motion that does not repeat.
#pragma once

#include <string>
#include <vector>

#include "general/attractors/motion_watch.hpp"

namespace gearlash::drive {

/// The last stretch of a motion as irregular motion, without its exponent; or the reason why it is
/// none. The limit of events may have stopped the motion.
struct Irregularity {
  IrregularFound found{};
  std::string reason{};  ///< empty if it is irregular
};
Irregularity irregularity_of(const Watch& watch, const Stretch& stretch,
                             const SearchSetting& setting, const SearchTolerances& tolerances,
                             bool is_out_of_events);

/// Whether two stretches of a motion have the same statistics.
bool is_alike(const IrregularFound& one, const IrregularFound& other, const SearchSetting& setting,
              const IrregularTolerances& tolerances);

/// Whether the first `count` numbers cover the same ranges, to a share of their widths: nothing
/// drifts.
bool are_alike(const std::vector<Extent>& ranges, const std::vector<Extent>& others,
               Eigen::Index count, double share);

/// Index of a known one that is nearly the same; their count if there is none.
std::size_t place_among(const std::vector<IrregularFound>& known, const IrregularFound& found,
                        const IrregularTolerances& tolerances);

}  // namespace gearlash::drive
