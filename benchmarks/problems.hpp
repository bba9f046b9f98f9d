// The servos that every contestant works on.
#pragma once

#include <vector>

#include "closed_form/limit_cycle.hpp"
#include "model/normalized_servo.hpp"

namespace gearlash::benchmarks {

struct Problem {
  NormalizedServo servo;
  LimitCycle cycle;  ///< ours, against which the answers of the others are checked
};

/// Sixteen servos within the thesis's charts (ζ 0.1 and 0.2, J_L/J_M 1/4 … 4, F_L/F 0.1 and 0.25,
/// b 0.3) with the given restitution; those that do not hunt, or not symmetrically, are left out.
std::vector<Problem> thesis_problems(double restitution);

}  // namespace gearlash::benchmarks
