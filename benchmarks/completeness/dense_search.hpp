// All cycles of a servo with bounces that a dense scan and long motions find, whatever it costs.
#pragma once

#include <vector>

#include "closed_form/return_map.hpp"
#include "model/normalized_servo.hpp"

namespace gearlash::benchmarks {

/// How much is done for one servo.
struct Density {
  int points = 8000;      ///< of the line on which faces part, log-spaced over 1e-3 … 1e3 b
  int starts = 96;        ///< of motions, half of them at random, off that line
  int traversals = 1500;  ///< of each motion
};

struct DenseCycle {
  std::vector<Arrival> visited;  ///< the arrivals that recur
  bool stable = false;

  /// Relative distance to the nearest of them.
  double distance_to(const Arrival& arrival) const;
};

/// It shares the return map with the search that it is compared with, and nothing else: Newton's
/// method of its own starts wherever one to four traversals come back nearer than at both
/// neighbours, and where motions come back in the end after up to eight.
std::vector<DenseCycle> dense_cycles(const NormalizedServo& servo, const Density& density);

}  // namespace gearlash::benchmarks
