#include "gearlash/motion/servo_dynamics.hpp"

#include <cmath>
#include <limits>

namespace gearlash {
namespace {

double rate(double friction, double inertia) {
  return inertia == 0.0 ? std::numeric_limits<double>::infinity() : friction / inertia;
}

}  // namespace

ServoDynamics servo_dynamics(const NormalizedServo& servo) {
  ServoDynamics dynamics;
  dynamics.damping = servo.damping;
  // Each inertia from the ratio itself: 1 − J_M would lose the digits of a light load.
  dynamics.motor_inertia = 1.0 / (1.0 + servo.inertia_ratio);
  dynamics.load_inertia =
      std::isinf(servo.inertia_ratio) ? 1.0 : servo.inertia_ratio / (1.0 + servo.inertia_ratio);
  dynamics.motor_friction = 2.0 * servo.damping * (1.0 - servo.friction_ratio);
  dynamics.load_friction = 2.0 * servo.damping * servo.friction_ratio;
  dynamics.motor_rate = rate(dynamics.motor_friction, dynamics.motor_inertia);
  dynamics.load_rate = rate(dynamics.load_friction, dynamics.load_inertia);
  dynamics.backlash = servo.backlash;
  dynamics.restitution = servo.restitution;
  dynamics.torque_per_speed = dynamics.load_friction * dynamics.motor_inertia -
                              dynamics.motor_friction * dynamics.load_inertia;
  const double length = std::sqrt(dynamics.torque_per_speed * dynamics.torque_per_speed +
                                  dynamics.load_inertia * dynamics.load_inertia);
  dynamics.torque_free_line = {dynamics.torque_per_speed / length, dynamics.load_inertia / length};
  return dynamics;
}

}  // namespace gearlash
