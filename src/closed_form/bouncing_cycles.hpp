// Finds limit cycles of servos whose faces bounce (0 < e ≤ 1).
#pragma once

#include <limits>
#include <vector>

#include "closed_form/limit_cycle.hpp"
#include "closed_form/servo_dynamics.hpp"
#include "model/normalized_servo.hpp"

namespace gearlash {

struct BouncingCycles {
  std::vector<LimitCycle> cycles;  ///< by decreasing amplitude
  bool all_starts_settled = true;  ///< every start tried ended in one of the cycles, or at rest
  bool cut_short = false;    ///< events ran out, or a motion still grew at the end of its watch
  bool any_neutral = false;  ///< a cycle was met whose multiplier is 1 to within rounding
  double irregular_amplitude =
      std::numeric_limits<double>::quiet_NaN();  ///< largest half peak-to-peak
                                                 ///< of those that did not
};

/// Four stages (docs/explanation/servo.md, Bounces):
///   a scan of the line on which faces part, from the largest amplitude that can last down to that
///   below which motion creeps (parting_scan.hpp). Where bounces settle, the amplitude at the
///   parting is the whole state, and each change of sign of its growth is a cycle. If the map rises
///   there, all motions from there on settle on these;
///   Newton's method from samples that nearly come back after one traversal or two;
///   motions from eight starts over b × [0.05, 50], each followed for at most 1,500 traversals,
///   with Newton's method where they come back after up to 8 traversals, or ever more closely after
///   up to 32; what lies beside the unstable cycles: those of twice the length, and motions to
///   either side.
/// Once sixteen cycles are known the recurrences of motions are no longer tried. At most four
/// million events are followed in all, and 200,000 within one traversal: a second or two.
/// Precondition: faults(servo) is empty, b > 0, contact not plastic.
BouncingCycles find_bouncing_cycles(const NormalizedServo& servo, const ServoDynamics& dynamics);

}  // namespace gearlash
