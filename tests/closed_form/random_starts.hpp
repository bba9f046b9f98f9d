// Seeded servos with starts anywhere: engaged on either face, in the gap, on a face moving into it.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "base/range_check.hpp"
#include "base/seeded_draws.hpp"
#include "closed_form/trajectory.hpp"

namespace gearlash {

struct RandomStart {
  NormalizedServo servo;
  ServoState initial;
  double reference = 0.0;

  /// Largest of all lengths and speeds at the start: what epsilons are counted of.
  double scale() const {
    return std::max({std::abs(initial.motor_position - reference),
                     std::abs(initial.load_position - reference), std::abs(initial.motor_speed),
                     std::abs(initial.load_speed), servo.backlash});
  }
};

struct RandomRange {
  double largest_damping = 1.5;
  double smallest_inertia_ratio = 1e-2;
  double largest_inertia_ratio = 1e2;
  bool massless_sides = false;
};

inline RandomStart random_start(SeededDraws& draws, const RandomRange& range = {}) {
  RandomStart random;
  NormalizedServo& servo = random.servo;
  servo.damping =
      draws.happens(0.1) ? draws.one_of({0.0, 1.0}) : draws.uniform(0.0, range.largest_damping);
  servo.inertia_ratio =
      draws.log_uniform(range.smallest_inertia_ratio, range.largest_inertia_ratio);
  servo.friction_ratio = draws.happens(0.2) ? draws.one_of({0.0, 1.0}) : draws.uniform(0.0, 1.0);
  servo.backlash = draws.log_uniform(1e-2, 1.0);
  servo.restitution = draws.happens(0.4) ? draws.one_of({0.0, 1.0}) : draws.uniform(0.0, 1.0);
  if (range.massless_sides && draws.happens(0.3)) {
    servo.damping = draws.uniform(0.05, 1.5);
    servo.friction_ratio = draws.uniform(0.05, 0.95);
    servo.inertia_ratio = draws.one_of({0.0, std::numeric_limits<double>::infinity()});
  }
  random.reference = draws.happens(0.3) ? 0.0 : draws.uniform(-1.0, 1.0);
  const double position = draws.uniform(-1.0, 1.0);
  const double speed = draws.uniform(-1.0, 1.0);
  if (draws.happens(0.4)) {
    const double side = draws.sign();
    random.initial = {position + 0.5 * side * servo.backlash, speed, position, speed};
  } else {
    const double share = draws.happens(0.2) ? draws.sign() : draws.uniform(-1.0, 1.0);
    random.initial = {position + 0.5 * share * servo.backlash, speed + draws.uniform(-1.0, 1.0),
                      position, speed};
  }
  return random;
}

inline std::string describe(const RandomStart& r) {
  return "damping " + exact_text(r.servo.damping) + " inertia_ratio " +
         exact_text(r.servo.inertia_ratio) + " friction_ratio " +
         exact_text(r.servo.friction_ratio) + " backlash " + exact_text(r.servo.backlash) +
         " restitution " + exact_text(r.servo.restitution) + " start {" +
         exact_text(r.initial.motor_position) + ", " + exact_text(r.initial.motor_speed) + ", " +
         exact_text(r.initial.load_position) + ", " + exact_text(r.initial.load_speed) +
         "} reference " + exact_text(r.reference);
}

/// Largest difference of positions and speeds.
inline double distance(const ServoState& a, const ServoState& b) {
  return std::max(
      {std::abs(a.motor_position - b.motor_position), std::abs(a.motor_speed - b.motor_speed),
       std::abs(a.load_position - b.load_position), std::abs(a.load_speed - b.load_speed)});
}

}  // namespace gearlash
