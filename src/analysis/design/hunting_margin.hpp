// How far a drive is from the boundary of hunting: by each parameter alone, and by all together.
#pragma once

#include <string_view>

#include "analysis/design/changeable_drive.hpp"
#include "gearlash/design.hpp"

namespace gearlash {

/// By feasible_values() for a target of no hunting, whose ends they are.
ParameterMargin parameter_margin(const ChangeableDrive& drive, std::string_view parameter);

/// OverallMargin:
///   min |x|  subject to  ln μ₀(J_M e^{x₁}, J_L e^{x₂}, F_M e^{x₃}, F_L e^{x₄}, K e^{x₅}) = 0.
/// By the steps x ← g (g·x − ln μ₀)/|g|², g the exact gradient of ln μ₀, cut short where they do
/// not lower ½|x|² + k|ln μ₀|, and at last by Newton's method on x = λg, ln μ₀ = 0 (Hasofer & Lind
/// 1974; Rackwitz & Fiessler 1978; Zhang & Der Kiureghian 1995: it is their design point). μ₀ does
/// not depend on the units of torque and time, so that x lies in a space of three dimensions; the
/// search starts from no change and from the nearest eight of the first crossings of the boundary
/// along 128 directions spread over that space and 10 along the axes. Throws InvalidInput.
OverallMargin overall_margin(const Drivetrain& drive);

/// Of ChangeableDrive::usual_names(), in their order; of restitution where there is any.
HuntingMargin hunting_margin(const ChangeableDrive& drive, Progress& progress = no_progress());

}  // namespace gearlash
