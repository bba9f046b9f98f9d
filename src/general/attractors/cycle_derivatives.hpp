// The derivatives of a limit cycle by one parameter of its drive.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "general/attractors/search_setting.hpp"

namespace gearlash::drive {

/// ∂/∂parameter, in SI.
struct CycleSlopes {
  double amplitude = 0.0;  ///< of the load
  double motor_amplitude = 0.0;
  double center = 0.0;
  double period = 0.0;
};

/// Why a cycle has no derivatives: ticks of a computer, encoder steps, a sine that drives it,
/// bounces that settle, a guard that it grazes, a multiplier of 1. Empty if it has.
std::string obstacle_to_slopes(const SearchSetting& setting, const FoundCycle& cycle);

/// By orbit_slopes() and the turns of both shafts. The amplitude of a load that stands has none.
/// `family`: the drive for a value of the parameter, with its signals settled; `step`: h of
/// SystemSlopes. Empty where the parameter changes the modes' shape. Precondition: no obstacle, and
/// `setting` is that of the family's drive at `parameter`. Throws what the family throws.
std::optional<CycleSlopes> cycle_slopes(const SearchSetting& setting, const FoundCycle& cycle,
                                        const std::function<ReducedDrive(double)>& family,
                                        double parameter, double step);

}  // namespace gearlash::drive
