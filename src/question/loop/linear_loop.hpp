// Stability, bandwidth and phase margin of a drive's linear loop.
#pragma once

#include <optional>

#include "gearlash/answer.hpp"
#include "model/drive.hpp"

namespace gearlash::drive {

/// Bandwidth: the first frequency at which |θ_L/r| falls below 1/√2 of its value at frequency 0.
/// Phase margin: the least |arg(L(jω)) ± π| where |L(jω)| = 1, at the crossover.
///
/// The loop is broken at the torque that the controller requests. With the plant G from there to
/// the load's position θ_L, the sensed position y and the sensed speed v, and the controller
/// τ = K_r r + K_y y + K_v v,
///   L = −(K_y G_y + K_v G_v),   θ_L/r = K_r G_L/(1 + L).
///
/// The plant has inertia, viscous friction, the linearised weight, and the winding. With rigid
/// faces both shafts turn as one. With compliant faces they are joined by stiffness and damping.
/// Left out: the gap, dry friction, limits of torque, current and speed, steps of encoders, a dead
/// band and its compensation, feedforward, load torque.
///
/// A sampled loop is exact: z = e^{jωT}, the plant from tick to tick under the held and delayed
/// torque, the speed from a tachometer or from differences, and θ_L at the ticks. Frequencies end
/// at half the sampling frequency.
///
/// Where the position controller runs at some ticks alone, the response to a sine has other
/// frequencies beside its own: there is nothing but whether the loop is stable.
///
/// Crossings are searched among 64 frequencies a decade, more at each eigenvalue of the loop, and
/// at the extremes between them; then they are refined to rounding. A pair of crossings within one
/// step may be missed.
///
/// Empty for a relay, whose loop is not linear. Throws InvalidInput.
std::optional<LinearLoop> loop_figures(const ReducedDrive& drive);

}  // namespace gearlash::drive
