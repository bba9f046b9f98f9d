// The coefficients of the equations of motion, derived once from the normalised servo.
#pragma once

#include <cmath>

#include "model/normalized_servo.hpp"

namespace gearlash {

/// Unit vector (y, ẏ) along the line of zero mesh torque, with speed ≥ 0: the states at which faces
/// can part. A massless load parts at rest (speed 0, position 1).
template <class Real>
struct BasicTorqueFreeLine {
  Real position = 0.0;
  Real speed = 1.0;
};
using TorqueFreeLine = BasicTorqueFreeLine<double>;

/// Normalised so that J_M + J_L = 1, K = 1 and F_M + F_L = 2ζ. Real is double, or a vector of
/// doubles for several servos side by side (src/closed_form/lanes).
template <class Real>
struct BasicServoDynamics {
  Real damping = 0.0;           ///< ζ
  Real motor_inertia = 0.5;     ///< J_M
  Real load_inertia = 0.5;      ///< J_L
  Real motor_friction = 0.0;    ///< F_M
  Real load_friction = 0.0;     ///< F_L
  Real motor_rate = 0.0;        ///< c = F_M/J_M, infinite for a massless motor
  Real load_rate = 0.0;         ///< D = F_L/J_L, infinite for a massless load
  Real backlash = 0.0;          ///< b, rad
  Real restitution = 0.0;       ///< e
  Real torque_per_speed = 0.0;  ///< F_L J_M − F_M J_L, see mesh_torque()
  BasicTorqueFreeLine<Real> torque_free_line;

  bool massless_motor() const { return motor_inertia == 0.0; }
  bool massless_load() const { return load_inertia == 0.0; }

  /// A massless side has no inertia in an impact, and its rebound dies at once: contact engages
  /// whatever the restitution.
  bool plastic_contact() const { return restitution == 0.0 || massless_motor() || massless_load(); }
};
using ServoDynamics = BasicServoDynamics<double>;

/// Without backlash and restitution. A shaft without inertia has an infinite rate. Precondition:
/// each shaft has inertia or friction.
template <class Real>
BasicServoDynamics<Real> dynamics_of_shafts(const Real& damping, const Real& motor_inertia,
                                            const Real& load_inertia, const Real& friction_ratio) {
  using std::sqrt;
  BasicServoDynamics<Real> dynamics;
  dynamics.damping = damping;
  dynamics.motor_inertia = motor_inertia;
  dynamics.load_inertia = load_inertia;
  dynamics.motor_friction = 2.0 * damping * (1.0 - friction_ratio);
  dynamics.load_friction = 2.0 * damping * friction_ratio;
  dynamics.motor_rate = dynamics.motor_friction / motor_inertia;
  dynamics.load_rate = dynamics.load_friction / load_inertia;
  dynamics.torque_per_speed =
      dynamics.load_friction * motor_inertia - dynamics.motor_friction * load_inertia;
  const Real length =
      sqrt(dynamics.torque_per_speed * dynamics.torque_per_speed + load_inertia * load_inertia);
  dynamics.torque_free_line = {dynamics.torque_per_speed / length, load_inertia / length};
  return dynamics;
}

/// Precondition: faults(servo) is empty.
ServoDynamics servo_dynamics(const NormalizedServo& servo);

/// N = J_L ÿ + F_L ẏ = (F_L J_M − F_M J_L) ẏ − J_L y: the torque from engaged faces on the load.
/// The form holds for a massless shaft on either side.
template <class Real>
Real mesh_torque(const BasicServoDynamics<Real>& dynamics, Real position, Real speed) {
  return dynamics.torque_per_speed * speed - dynamics.load_inertia * position;
}

/// Ṅ while engaged.
template <class Real>
Real mesh_torque_rate(const BasicServoDynamics<Real>& dynamics, Real position, Real speed) {
  return -dynamics.torque_per_speed * (2.0 * dynamics.damping * speed + position) -
         dynamics.load_inertia * speed;
}

}  // namespace gearlash
