// The derivatives of a searched limit cycle with respect to the parameters of its drive.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "gearlash/sensitivity.hpp"
#include "question/analyse.hpp"

namespace gearlash {

/// The quantities of a searched cycle that have derivatives.
inline constexpr std::array differentiable_by_search = {Quantity::amplitude,
                                                        Quantity::motor_amplitude, Quantity::center,
                                                        Quantity::period, Quantity::frequency};

/// Of the largest cycle that is not unstable, where the analysis of the drive is known. Stopped by
/// Progress, it lacks the slopes by the later paths. Throws InvalidInput for a path that is no
/// number of the drive. Precondition: it was searched.
Jacobian orbit_derivatives(const Drive& drive, const Analysis& analysis,
                           std::span<const Quantity> quantities,
                           const std::vector<std::string>& paths,
                           Progress& progress = no_progress());

/// What a searched drive has derivatives by: its numbers that are not 0.
std::vector<std::string> numbers_of_orbits(const Drive& drive);
/// Throws InvalidInput for a path that is no number of the drive.
std::vector<double> presents_of(const Drive& drive, const std::vector<std::string>& paths);

}  // namespace gearlash
