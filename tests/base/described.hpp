// A servo in words, for the message of a test that fails.
#pragma once

#include <string>

#include "base/range_check.hpp"
#include "model/normalized_servo.hpp"

namespace gearlash {

inline std::string described(const NormalizedServo& servo) {
  return "damping " + exact_text(servo.damping) + " inertia_ratio " +
         exact_text(servo.inertia_ratio) + " friction_ratio " + exact_text(servo.friction_ratio) +
         " backlash " + exact_text(servo.backlash) + " restitution " +
         exact_text(servo.restitution);
}

}  // namespace gearlash
