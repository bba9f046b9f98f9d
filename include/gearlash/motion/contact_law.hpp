// What happens when faces meet: momentum, restitution, and the limit of accumulating bounces.
#pragma once

#include "gearlash/motion/gap_flight.hpp"
#include "gearlash/motion/servo_dynamics.hpp"

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

/// Faces that touch with no relative speed stay engaged when the mesh torque pushes (s N > 0), or
/// is zero and about to push (s Ṅ > 0), or vanishes for good (N = Ṅ = 0); else they part at once.
/// This rule also settles two events at one instant: the impact first, then this question.
bool stays_engaged(const ServoDynamics& dynamics, FaceSign face, double load_position,
                   double load_speed);

/// The rest of a run of bounces that has become so short that the pressing torque is linear in
/// time over it.
struct SettlingBounces {
  bool imminent;       ///< the closed form below holds to a double's accuracy
  double duration;     ///< time until the infinitely many remaining bounces are over
  double energy_lost;  ///< ½ J_M J_L u̇², what they lose together
};

/// Zeno limit in closed form. With a = s N/(J_M J_L) the pressing acceleration, a′ its rate, κ =
/// c J_L + D J_M the drag on the gap's motion and s₀ = |u̇|/a, the bounces still to come take
///   T = T₀ (1 − T₀ (κ + 2a′/a)/6),   T₀ = 2 s₀/(1 − e),
/// to third order in T₀ (docs/mathematics.md derives it); at their end the faces are engaged in the
/// state that the engaged flow would have reached over T, to the same order. `imminent` is set when
/// T₀ times the rates involved is below 1e-5, so that what is left out is below 1e-15.
/// Precondition: just after an impact on `face`, gap_speed pointing away from it, 0 < e < 1.
SettlingBounces settling_bounces(const ServoDynamics& dynamics, FaceSign face, double load_position,
                                 double load_speed, double gap_speed);

}  // namespace gearlash
