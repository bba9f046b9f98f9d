// The equations of motion as DESIGN and the header of NormalizedServo state them, with nothing
// solved: all that the reference simulator knows of the physics between events.
#pragma once

#include <array>
#include <cmath>

#include "model/normalized_servo.hpp"

namespace gearlash::oracle {

/// Everything is seen from the face that was touched last, mirrored where that is the backward
/// face, so that "towards the face" is always positive: y and v of the load (about the reference),
/// the distance of the motor from the face and its rate (the opening speed).
///
/// The distance is a coordinate of its own: bounces of 1e-13 of the first are then still exact to
/// many digits, which a difference of two shaft positions would not be.
template <class Real>
using State = std::array<Real, 4>;
enum Coordinate : unsigned { load_position, load_speed, distance, opening_speed };

template <class Real>
struct RawServo {
  Real motor_inertia;
  Real load_inertia;
  Real motor_friction;
  Real load_friction;
  Real backlash;
  Real restitution;

  bool massless_motor() const { return motor_inertia == 0; }
  bool massless_load() const { return load_inertia == 0; }
  bool plastic() const { return restitution == 0 || massless_motor() || massless_load(); }

  /// The fastest decay of either shaft; massless sides have none.
  Real fastest_rate() const {
    const Real motor = massless_motor() ? Real(0) : Real(motor_friction / motor_inertia);
    const Real load = massless_load() ? Real(0) : Real(load_friction / load_inertia);
    const Real together = motor_friction + load_friction + 1;
    const Real apart = motor > load ? motor : load;
    return apart > together ? apart : together;
  }
};

template <class Real>
RawServo<Real> raw_servo(const NormalizedServo& servo) {
  const Real ratio = servo.inertia_ratio;
  const bool massless_motor = std::isinf(servo.inertia_ratio);
  const Real friction = 2 * Real(servo.damping);
  const Real share = servo.friction_ratio;
  return {.motor_inertia = massless_motor ? Real(0) : Real(1 / (1 + ratio)),
          .load_inertia = massless_motor ? Real(1) : Real(ratio / (1 + ratio)),
          .motor_friction = friction * (1 - share),
          .load_friction = friction * share,
          .backlash = servo.backlash,
          .restitution = servo.restitution};
}

/// Both shafts as one: (J_M + J_L) ÿ + (F_M + F_L) ẏ + y = 0.
template <class Real>
State<Real> engaged_derivative(const RawServo<Real>& servo, const State<Real>& z) {
  const Real friction = servo.motor_friction + servo.load_friction;
  const Real inertia = servo.motor_inertia + servo.load_inertia;
  return {z[load_speed], -(friction * z[load_speed] + z[load_position]) / inertia, Real(0),
          Real(0)};
}

/// Shafts apart: J_L v̇_L + F_L v_L = 0, J_M v̇_M + F_M v_M + y_L = 0, with v_M = v_L − opening
/// speed. A massless load stands still; a massless motor runs at v_M = −y_L/F_M.
template <class Real>
State<Real> gap_derivative(const RawServo<Real>& servo, const State<Real>& z) {
  const Real load_acceleration =
      servo.massless_load() ? Real(0)
                            : Real(-servo.load_friction * z[load_speed] / servo.load_inertia);
  const Real motor_speed = z[load_speed] - z[opening_speed];
  const Real motor_acceleration =
      servo.massless_motor()
          ? Real(-z[load_speed] / servo.motor_friction)
          : Real(-(servo.motor_friction * motor_speed + z[load_position]) / servo.motor_inertia);
  return {z[load_speed], load_acceleration, z[opening_speed],
          load_acceleration - motor_acceleration};
}

/// Mesh torque on the load as if the faces were engaged, N = J_L ÿ + F_L ẏ; the face can only push
/// (N ≥ 0, mirrored).
template <class Real>
Real engaged_torque(const RawServo<Real>& servo, const State<Real>& z) {
  const State<Real> rate = engaged_derivative(servo, z);
  return servo.load_inertia * rate[load_speed] + servo.load_friction * z[load_speed];
}

}  // namespace gearlash::oracle
