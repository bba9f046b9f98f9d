// What happens where a searched drive ceases to meet its target.
#pragma once

#include "gearlash/design.hpp"
#include "question/analyse.hpp"
#include "question/change/analysed_values.hpp"

namespace gearlash {

/// A value of a parameter and the analysis of the drive with it.
struct AnalysedValue {
  double value = 0.0;
  const Analysis& analysis;
};

/// Compares the motions on both sides of a border, and follows the largest stable cycle that the
/// side beyond has alone across it (continue_orbit()). If there is none, that of the side within,
/// as far as `far`, but no more than 1 % beyond the border. `met`: the last value that meets the
/// target; `unmet`: one beyond.
Border border_between(const DriveAlong& drive, const AnalysedValue& met, const AnalysedValue& unmet,
                      double far, Progress& progress);

}  // namespace gearlash
