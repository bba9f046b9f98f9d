// How much backlash production may let through.
#pragma once

#include <optional>

#include "analysis/design/sampling.hpp"
#include "analysis/design/target.hpp"
#include "analysis/design/toleranced_drive.hpp"
#include "analysis/grid/grid_evaluation.hpp"

namespace gearlash {

struct BacklashDemand {
  Target target;        ///< without a lower limit of amplitude
  double yield = 0.95;  ///< share of pieces that are to meet the target, above 0 to 1
  /// The lower limit of the backlash's tolerance, rad, ≥ 0. Without it: the lowest value of the
  /// backlash where it varies (drawn_range_of()), its nominal value where it does not.
  std::optional<double> min = {};
};

/// Every fault of the ranges above.
std::vector<Fault> validate(const BacklashDemand& demand);

struct WidestBacklash {
  double min = 0.0;  ///< rad
  double max = 0.0;  ///< rad; infinite where backlash does not matter
  Estimate yield;    ///< with a backlash that is uniform from min to max
  /// The limits with which the estimated yield would be the demanded one plus its standard error,
  /// and less it.
  Bounds uncertainty;
  bool stopped = false;  ///< by progress: nothing holds
};

/// The largest max with which at least the demanded share of the sample's pieces meet the target,
/// their backlash being uniform from min to max and all else as it varies. Amplitudes being in
/// proportion to backlash, the piece with coordinate u of the backlash and amplitude S per backlash
/// keeps S (min + u (max − min)) ≤ limit for every max up to min + (limit/S − min)/u: max is an
/// order statistic of these, which is where bisection over the same sample points would end.
/// Nothing where not even max = min gives the yield. Throws InvalidInput.
std::optional<WidestBacklash> widest_backlash(const TolerancedDrive& drive,
                                              const BacklashDemand& demand,
                                              const SamplePlan& sampling = {},
                                              const Workers& workers = {},
                                              Progress& progress = no_progress());

}  // namespace gearlash
