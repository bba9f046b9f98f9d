// What is measured of a closed orbit, and when two are one cycle.
#pragma once

#include "general/attractors/search_setting.hpp"

namespace gearlash::drive {

/// Over so many periods.
hybrid::Trajectory motion_on(const hybrid::PreparedSystem& system,
                             const hybrid::PeriodicOrbit& orbit, double periods);

/// By how much the state after a share of the period differs from that at the start, times a sign;
/// as a share.
double mismatch_after(const SearchSetting& setting, const hybrid::PeriodicOrbit& orbit,
                      double share, double sign);

/// Whether numbers agree to a share of a scale.
bool agree(double a, double b, double scale, double share);

/// Sizes, stability, symmetry and impacts of an orbit of setting.system.
FoundCycle measured(const SearchSetting& setting, const hybrid::PeriodicOrbit& orbit,
                    const CycleTolerances& tolerances);

/// The load may stand while the motor hunts within the gap: the larger of both sizes.
double extent_of(const FoundCycle& cycle);

/// Whether two are one cycle, mirror images (which is noted), or of one family of neutral ones.
bool is_one_with(FoundCycle& known, const FoundCycle& cycle, const CycleTolerances& tolerances);

/// Among those that are known, or as a new one.
std::size_t place_of(const FoundCycle& cycle, const CycleTolerances& tolerances,
                     std::vector<FoundCycle>& all);

}  // namespace gearlash::drive
