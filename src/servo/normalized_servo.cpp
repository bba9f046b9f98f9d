#include "gearlash/servo/normalized_servo.hpp"

#include <cmath>

#include "gearlash/servo/range_check.hpp"

namespace gearlash {
namespace {

constexpr double smallest_damping = 1e-15;
constexpr double largest_damping = 1e3;
constexpr double smallest_inertia_ratio = 1e-9;
constexpr double largest_inertia_ratio = 1e9;
constexpr double smallest_backlash = 1e-15;
constexpr double largest_backlash = 1e6;

bool permitted_inertia_ratio(double ratio) {
  return ratio == 0.0 || (ratio >= smallest_inertia_ratio && ratio <= largest_inertia_ratio) ||
         (std::isinf(ratio) && ratio > 0.0);
}

}  // namespace

std::vector<Violation> validate(const NormalizedServo& servo) {
  RangeCheck check;
  if (servo.damping != 0.0) {
    check.within("damping", servo.damping, smallest_damping, largest_damping, "0 or ");
  }
  if (!permitted_inertia_ratio(servo.inertia_ratio)) {
    check.refuse("inertia_ratio", exact_text(servo.inertia_ratio),
                 "must be 0 (massless load), from 1e-9 to 1e9, or inf (massless motor)");
  }
  check.within("friction_ratio", servo.friction_ratio, 0.0, 1.0);
  if (servo.backlash != 0.0) {
    check.within("backlash", servo.backlash, smallest_backlash, largest_backlash, "0 or ");
  }
  check.within("restitution", servo.restitution, 0.0, 1.0);
  if (servo.sensor != Sensor::load) {
    check.refuse("sensor", "motor", "must be load (a sensor on the motor comes with drives)");
  }
  const double load_friction = servo.damping * servo.friction_ratio;
  const double motor_friction = servo.damping * (1.0 - servo.friction_ratio);
  if (servo.inertia_ratio == 0.0 && load_friction == 0.0) {
    check.refuse("inertia_ratio", "0",
                 "must be positive where the load has no friction (damping * friction_ratio = 0): "
                 "a shaft with neither has no law of motion");
  }
  if (std::isinf(servo.inertia_ratio) && motor_friction == 0.0) {
    check.refuse("inertia_ratio", "inf",
                 "must be finite where the motor has no friction (damping * (1 - friction_ratio) "
                 "= 0): a shaft with neither has no law of motion");
  }
  return check.violations();
}

}  // namespace gearlash
