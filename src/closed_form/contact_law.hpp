// The law of contact: momentum, restitution, and the limit of accumulating bounces.
#pragma once

#include "closed_form/gap_flight.hpp"
#include "closed_form/servo_dynamics.hpp"

namespace gearlash {

/// +1 on the forward face, −1 on the backward face: N of this sign pushes.
using FaceSign = double;

struct ImpactOutcome {
  double load_speed;   ///< after the impact
  double gap_speed;    ///< u̇ after the impact; 0 when the faces stay together
  double energy_lost;  ///< ½ J_M J_L (u̇₋² − u̇₊²), units of K rad²
};

/// Newton's law of restitution with J_M v_M + J_L v_L kept: u̇₊ = −e u̇₋. Plastic contact (e = 0, or
/// a massless side, see ServoDynamics::plastic_contact): u̇₊ = 0.
ImpactOutcome impact(const ServoDynamics& dynamics, double load_speed, double gap_speed);

/// Faces that touch with no relative speed stay engaged if the mesh torque pushes (s N > 0), if it
/// is zero and about to push (s Ṅ > 0), or if it vanishes for good (N = Ṅ = 0). Otherwise they part
/// at once. This rule also orders two events at one instant: the impact first, then this question.
bool stays_engaged(const ServoDynamics& dynamics, FaceSign face, double load_position,
                   double load_speed);

/// The largest |N| of faces engaged for a duration (infinite: for good), from a state on. N obeys
/// the equation of the engaged flow, so it is largest at the start, at its first turn or at the
/// end.
double largest_mesh_torque(const ServoDynamics& dynamics, double load_position, double load_speed,
                           double duration);

/// The sum of the remaining bounces on one face.
struct SettlingBounces {
  bool imminent = false;     ///< the closed form holds; the rest may be taken at once
  double duration = 0.0;     ///< time until the remaining bounces are over
  double energy_lost = 0.0;  ///< loss in their impacts, units of K rad²
  /// Loss by the bouncing itself in the friction of each shaft, beside that of the common motion.
  double motor_friction_lost = 0.0;
  double load_friction_lost = 0.0;
};

/// The Zeno limit in closed form, for bounces so short that the pressing torque is linear in time
/// over them. With a = s N/(J_M J_L) the pressing acceleration, a′ its rate, κ = c J_L + D J_M the
/// drag on the gap's motion and s₀ = |u̇|/a, the remaining bounces take
///   T = T₀ (1 − T₀ (κ + 2a′/a)/6),   T₀ = 2 s₀/(1 − e),
/// to third order in T₀ (derivation: docs/explanation/motions.md). At their end the faces are
/// engaged in the state that the engaged flow would have reached over T, to the same order.
/// `imminent` is set if T₀ times the rates involved is below 1e-5. The third order, which is left
/// out, is then about 1e-15. This is an estimate, because its factor is not bounded. Precondition:
/// just after an impact on `face`, gap_speed pointing away from it, 0 < e < 1.
SettlingBounces settling_bounces(const ServoDynamics& dynamics, FaceSign face, double load_position,
                                 double load_speed, double gap_speed);

/// The remaining nearly elastic bounces (1 − e ≤ 1e-3), which shrink too slowly to be followed one
/// by one. While the faces are pressed together their action p³/a falls as e^{−κt}, and no faster
/// if e = 1 (adiabatic invariance; docs/explanation/motions.md). `imminent` is set, with
/// duration 0, if more than 1e4 bounces are to come before the faces part, and
///   the height p²/(2a) is below 1e-8 of the motion (and below 1e-4 of the backlash),
///   the common motion is displaced by less than 1e-9 of itself or of the backlash,
///   the relative speed left at the parting, (⅔ p³/a · e^{−κT})^{2/5} |ȧ|^{1/5}, is below 1e-6 of
///   the motion then, or, the more bounces n there would be to follow, below 1e-10 n ≤ 1e-3.
/// If they never part, the first two hold for backlash + motion and for the backlash. So the faces
/// count as engaged although they still rattle. The numbers above estimate the errors, to leading
/// order of an adiabatic invariant; they are not bounds. tests/closed_form/rattle_test.cpp compares
/// them with motions in which every bounce is followed. Precondition: as for settling_bounces(), e
/// ≤ 1.
SettlingBounces fading_rattle(const ServoDynamics& dynamics, FaceSign face, double load_position,
                              double load_speed, double gap_speed);

}  // namespace gearlash
