// How much backlash production may let through.
#pragma once

#include <optional>
#include <vector>

#include "analysis/grid/grid_evaluation.hpp"
#include "gearlash/tolerance.hpp"

namespace gearlash {

/// Every fault of the ranges.
std::vector<Fault> validate(const BacklashDemand& demand);

/// The largest max with which at least the demanded share of the samples meet the target,
/// their backlash being uniform from min to max and all else as it varies. Amplitudes being in
/// proportion to backlash, the piece with coordinate u of the backlash and amplitude S per backlash
/// keeps S (min + u (max − min)) ≤ limit for every max up to min + (limit/S − min)/u: max is an
/// order statistic of these, which is where bisection over the same sample points would end.
/// Nothing where not even max = min gives the yield. Throws InvalidInput.
std::optional<WidestBacklash> widest_backlash(const TolerancedDrive& drive,
                                              const BacklashDemand& demand,
                                              const SamplePlan& sampling, const Workers& workers,
                                              Progress& progress = no_progress());

}  // namespace gearlash
