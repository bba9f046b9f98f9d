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

/// Newton's method on k-fold traversals, k = 1, 2, 3, 4, 6, 8. It starts from the plastic cycle,
/// from a scan of 121 amplitudes over b × [1e-4, 1e4], and from the recurrences of motions from
/// eight starts over b × [0.05, 50]. Each motion is followed for at most 1,500 traversals, or until
/// it creeps to rest. Once sixteen cycles are known the recurrences are no longer tried. At most
/// four million events are followed in all, and 200,000 within one traversal: a second or two.
/// Precondition: validate(servo) is empty, b > 0, contact not plastic.
BouncingCycles find_bouncing_cycles(const NormalizedServo& servo, const ServoDynamics& dynamics);

}  // namespace gearlash
