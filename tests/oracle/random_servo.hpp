// Seeded servos and starts that cover the whole range of parameters, both ends included.
#pragma once

#include <cstdint>
#include <string>

#include "closed_form/trajectory.hpp"
#include "model/normalized_servo.hpp"

namespace gearlash::oracle {

struct RandomCase {
  NormalizedServo servo;
  ServoState initial;
  double reference = 0.0;
};

/// The case number `index` of a seed: the same on every machine and for any number of threads.
///   damping         0 … 1.5; 5 % exactly 0, 5 % exactly 1, 5 % within 1e-3 of 1
///   inertia_ratio   log-uniform 1e-6 … 1e6; 5 % 0, 5 % infinite
///   friction_ratio  0 … 1; 8 % exactly 0, 8 % exactly 1 (where the servo permits)
///   backlash        log-uniform 1e-3 … 1
///   restitution     30 % 0, 10 % 1, else uniform
///   start           engaged on either face (pressed or to be parted at once), or anywhere in the
///                   gap with any speeds; step reference −1 … 1
/// Backlash and positions are whole multiples of 2^-30, so that a face is where it should be in
/// double precision too.
RandomCase random_case(std::uint64_t seed, std::uint64_t index);

/// All numbers of a case, for a report of failure.
std::string describe(const RandomCase& drawn);

}  // namespace gearlash::oracle
