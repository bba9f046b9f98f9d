// The most backlash that production may permit.
#pragma once

#include <optional>
#include <vector>

#include "gearlash/tolerance.hpp"
#include "question/family/evaluation.hpp"

namespace gearlash {

/// Every fault of the ranges.
std::vector<Fault> faults(const BacklashDemand& demand);

/// The largest max for which at least the demanded share of the samples meet the target. The
/// backlash is uniform from min to max; the other parameters vary as specified. Amplitudes are
/// proportional to backlash, so the sample with coordinate u of the backlash and amplitude S per
/// backlash keeps S (min + u (max − min)) ≤ limit for every max up to min + (limit/S − min)/u. The
/// result is an order statistic of these values, the same that bisection over the same sample
/// points would give. Empty where not even max = min gives the yield. Throws InvalidInput.
std::optional<WidestBacklash> widest_backlash(const TolerancedDrive& drive,
                                              const BacklashDemand& demand,
                                              const SamplePlan& sampling, const Workers& workers,
                                              Progress& progress = no_progress());

}  // namespace gearlash
