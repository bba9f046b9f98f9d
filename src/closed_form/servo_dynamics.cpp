#include "closed_form/servo_dynamics.hpp"

namespace gearlash {

ServoDynamics servo_dynamics(const NormalizedServo& servo) {
  // Each inertia from the ratio itself: 1 − J_M would lose the digits of a light load.
  const double ratio = servo.inertia_ratio;
  ServoDynamics dynamics =
      dynamics_of_shafts(servo.damping, 1.0 / (1.0 + ratio),
                         std::isinf(ratio) ? 1.0 : ratio / (1.0 + ratio), servo.friction_ratio);
  dynamics.backlash = servo.backlash;
  dynamics.restitution = servo.restitution;
  return dynamics;
}

}  // namespace gearlash
