#include "thesis/program_1960.hpp"

#include <cmath>

#include "base/range_check.hpp"

namespace gearlash::thesis {

ProgramParameters program_parameters(const NormalizedServo& servo) {
  require_none(faults(servo));
  RangeCheck check;
  if (servo.inertia_ratio == 0.0 || std::isinf(servo.inertia_ratio)) {
    check.refuse("inertia_ratio", exact_text(servo.inertia_ratio),
                 "must be from 1e-9 to 1e9: the program of 1960 divides by both inertias");
  }
  if (servo.restitution != 0.0) {
    check.refuse("restitution", exact_text(servo.restitution),
                 "must be 0: the program of 1960 knows plastic contact only");
  }
  require_none(check.faults());
  const double motor_inertia = 1.0 / (1.0 + servo.inertia_ratio);
  const double load_inertia = servo.inertia_ratio / (1.0 + servo.inertia_ratio);
  const double friction = 2.0 * servo.damping;
  return {.friction = friction,
          .load_rate = friction * servo.friction_ratio / load_inertia,
          .motor_inertia = motor_inertia,
          .motor_friction = friction * (1.0 - servo.friction_ratio),
          .load_inertia = load_inertia,
          .backlash = servo.backlash};
}

}  // namespace gearlash::thesis
