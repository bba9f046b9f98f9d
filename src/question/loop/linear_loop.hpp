// Stability, bandwidth, margins and lag of a drive's linear loop.
#pragma once

#include <optional>

#include "gearlash/answer.hpp"
#include "model/drive.hpp"

namespace gearlash::drive {

/// Bandwidth: the first frequency at which |θ_L/r| falls below 1/√2 of its value at frequency 0.
/// Phase margin: the least |arg(L(jω)) ± π| where |L(jω)| = 1, at the crossover.
/// Gain margin: 1/|L(jω)| where L(jω) is real and negative, of all such frequencies that whose |L|
/// is next to 1 as a ratio, within a factor of 1e6. With the gain multiplied by it, and by nothing
/// between it and 1, the loop is at the border of stability. Frequency 0 counts if L has no pole
/// there, and so does half the sampling frequency: L is real at both.
/// Lag: the largest |r − θ_L| in the end of a reference that is a ramp, by the final value, or a
/// sine, A |1 − θ_L/r|. Droop, by which a constant reference is missed, is no part of it; a ramp
/// has none where that grows with the reference.
///
/// The loop is broken at the torque that the controller requests. With the plant G from there to
/// the load's position θ_L, the sensed position y and the sensed speed v, and the controller
/// τ = K_r r + K_y y + K_v v,
///   L = −(K_y G_y + K_v G_v),   θ_L/r = K_r G_L/(1 + L).
///
/// The plant has inertia, viscous friction, the linearised weight, and the winding. With rigid
/// faces both shafts turn as one. With compliant faces they are joined by stiffness and damping.
/// Left out: the gap, dry friction, limits of torque, current and speed, steps of encoders, a dead
/// band and its compensation, feedforward, load torque. Margins are those of a stable loop: of
/// another one they do not say how far it is from the border.
///
/// A sampled loop is exact: z = e^{jωT}, the plant from tick to tick under the held and delayed
/// torque, the speed from a tachometer or from differences, and θ_L at the ticks; so is the lag.
/// Frequencies end at half the sampling frequency.
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
