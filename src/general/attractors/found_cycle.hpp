// Measures a closed orbit, and decides whether two are one cycle.
#pragma once

#include "general/attractors/search_setting.hpp"

namespace gearlash::drive {

/// The motion on an orbit over a number of periods.
hybrid::Trajectory motion_on(const hybrid::PreparedSystem& system,
                             const hybrid::PeriodicOrbit& orbit, double periods);

/// Difference between the state after a share of the period and `sign` times the state at the
/// start, as a share of the latter.
double mismatch_after(const SearchSetting& setting, const hybrid::PeriodicOrbit& orbit,
                      double share, double sign);

/// Whether numbers agree to a share of a scale.
bool agree(double a, double b, double scale, double share);

/// Amplitudes, stability, symmetry and impacts of an orbit of setting.system.
FoundCycle measured(const SearchSetting& setting, const hybrid::PeriodicOrbit& orbit,
                    const SearchTolerances& tolerances);

/// N m at the load's shaft, between the faces while they are together. Where rigid faces stand with
/// dry friction it is not determined and left out.
double largest_mesh_torque(const SearchSetting& setting, const hybrid::Trajectory& motion);

/// The larger of both amplitudes: the load may stand while the motor hunts within the gap.
double extent_of(const FoundCycle& cycle);

/// Whether the shafts return. The residual of the orbit, a share of the largest of all numbers,
/// does not tell where one of them is of another magnitude than the shafts' positions.
bool returns(const FoundCycle& cycle, const CycleTolerances& tolerances);

/// Whether two are one cycle, mirror images (which is noted), or members of a family of neutral
/// ones.
bool is_one_with(FoundCycle& known, const FoundCycle& cycle, const CycleTolerances& tolerances);

/// Index of the known cycle that is the same and now includes this one, or of a new entry.
std::size_t place_of(const FoundCycle& cycle, const CycleTolerances& tolerances,
                     std::vector<FoundCycle>& all);

}  // namespace gearlash::drive
