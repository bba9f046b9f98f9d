// Servos that energy proves not to hunt, followed for long by the reference simulator.
#pragma once

#include <cstdint>

#include "model/normalized_servo.hpp"
#include "random_servo.hpp"

namespace gearlash::oracle {

struct DissipationCheck {
  RandomCase drawn;
  double early = 0.0;  ///< largest |y| at events and samples, over the first hundredth
  double late = 0.0;   ///< and over the last fifth
  bool exhausted =
      false;           ///< more bounces than are followed, as where e is 1 or nearly: not judged
  bool hunts = false;  ///< late is not below a tenth of both early and the backlash
};

/// Case `index` of a seed: damping 0.71 … 10, inertia ratio 1e-2 … 1e2, a restitution of 0 … 1
/// (one in ten 0, one in ten 1), in the region 1/c + 1/D ≤ 2ζ; from the gap with any speeds.
DissipationCheck check_dissipation(std::uint64_t seed, std::uint64_t index);

}  // namespace gearlash::oracle
