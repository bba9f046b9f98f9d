// The rigid servo of design section 2 as a hybrid system, written down from its equations.
#pragma once

#include "hybrid/hybrid_system.hpp"
#include "model/normalized_servo.hpp"

namespace gearlash {

/// Modes of servo_system().
enum ServoMode : std::size_t { separated, engaged_forward, engaged_backward };

/// θ_M, v_M, θ_L, v_L about the reference; ω_n = 1. Precondition: two masses, b > 0.
inline hybrid::HybridSystem servo_system(const NormalizedServo& servo) {
  using hybrid::Matrix;
  using hybrid::Vector;
  const double motor = 1.0 / (1.0 + servo.inertia_ratio);
  const double load = servo.inertia_ratio / (1.0 + servo.inertia_ratio);
  const double motor_friction = 2.0 * servo.damping * (1.0 - servo.friction_ratio);
  const double load_friction = 2.0 * servo.damping * servo.friction_ratio;
  Matrix apart = Matrix::Zero(4, 4);
  apart(0, 1) = 1.0;
  apart.row(1) << 0.0, -motor_friction / motor, -1.0 / motor, 0.0;
  apart(2, 3) = 1.0;
  apart(3, 3) = -load_friction / load;
  Matrix together = Matrix::Zero(4, 4);
  together(0, 1) = 1.0;
  together(2, 3) = 1.0;
  together.row(1) << 0.0, 0.0, -1.0, -2.0 * servo.damping;
  together.row(3) = together.row(1);
  // (v_M, v_L) → common momentum, and −e times the relative speed.
  const auto impact = [&](double restitution) {
    Matrix after = Matrix::Identity(4, 4);
    after.row(1) << 0.0, motor - restitution * load, 0.0, load * (1.0 + restitution);
    after.row(3) << 0.0, motor * (1.0 + restitution), 0.0, load - restitution * motor;
    return after;
  };
  const Vector torque =
      (Vector(4) << 0.0, 0.0, -load, load_friction - 2.0 * servo.damping * load).finished();
  const Vector gap = (Vector(4) << 1.0, 0.0, -1.0, 0.0).finished();
  const bool plastic = servo.restitution == 0.0;
  const auto meets = [&](const char* name, double face, std::size_t engaged) {
    hybrid::Transition transition;
    transition.name = name;
    transition.guard = {gap, -0.5 * face * servo.backlash};
    transition.direction = face > 0.0 ? hybrid::Direction::rising : hybrid::Direction::falling;
    transition.reset.matrix = impact(servo.restitution);
    transition.target = plastic ? engaged : separated;
    if (!plastic) transition.settling = hybrid::Settling{engaged, {impact(0.0), {}, {}}};
    return transition;
  };
  // Where they part the shafts have one speed, and the gap is what it is.
  const auto part = [&](double face) {
    Matrix after = Matrix::Identity(4, 4);
    after.row(0) << 0.0, 0.0, 1.0, 0.0;
    after.row(1) << 0.0, 0.0, 0.0, 1.0;
    return hybrid::AffineReset{
        after, (Vector(4) << 0.5 * face * servo.backlash, 0.0, 0.0, 0.0).finished(), {}};
  };
  const auto engaged = [&](const char* name, double face) {
    return hybrid::AffineMode{.name = name,
                              .flow = {together, Vector::Zero(4)},
                              .transitions = {{.name = "separation",
                                               .guard = {torque, 0.0},
                                               .direction = face > 0.0 ? hybrid::Direction::falling
                                                                       : hybrid::Direction::rising,
                                               .reset = part(face),
                                               .target = separated}}};
  };
  return {.state_names = {"motor position", "motor speed", "load position", "load speed"},
          .modes = {{.name = "separated",
                     .flow = {apart, Vector::Zero(4)},
                     .transitions = {meets("forward impact", 1.0, engaged_forward),
                                     meets("backward impact", -1.0, engaged_backward)}},
                    engaged("engaged forward", 1.0),
                    engaged("engaged backward", -1.0)}};
}

}  // namespace gearlash
