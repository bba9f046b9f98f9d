// The distance of a drive from the boundary of hunting, by all numbers of its drivetrain together.
#pragma once

#include <optional>

#include "gearlash/design.hpp"
#include "model/drivetrain.hpp"

namespace gearlash {

/// Solves for the OverallMargin:
///   min |x|  subject to  ln μ₀(J_M e^{x₁}, J_L e^{x₂}, F_M e^{x₃}, F_L e^{x₄}, K e^{x₅}) = 0.
/// The steps are x ← g (g·x − ln μ₀)/|g|², where g is the gradient of ln μ₀. A step that does
/// not lower ½|x|² + k|ln μ₀| is shortened. Newton's method on x = λg, ln μ₀ = 0 finishes. This is
/// the design point of Hasofer & Lind (1974), Rackwitz & Fiessler (1978) and Zhang & Der Kiureghian
/// (1995). μ₀ does not depend on the units of torque and time, so x lies in a space of three
/// dimensions. The search starts from x = 0 and from the nearest eight of the first crossings of
/// the boundary along 128 directions spread over that space and 10 along the axes. Throws
/// InvalidInput.
OverallMargin overall_margin(const Drivetrain& drive);
/// Of a drive with a settled_servo(); empty for any other. Precondition: the drive is sound.
std::optional<OverallMargin> overall_margin(const Drive& drive);

}  // namespace gearlash
