// Finds the servo's limit cycles and decides whether it hunts.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "base/special_numbers.hpp"
#include "closed_form/cycle_bounds.hpp"
#include "closed_form/trajectory.hpp"
#include "gearlash/answer.hpp"
#include "model/normalized_servo.hpp"

namespace gearlash {

/// Energy lost in a period; NaN where not computed.
struct EnergyLost {
  double motor_friction = std::numeric_limits<double>::quiet_NaN();
  double load_friction = std::numeric_limits<double>::quiet_NaN();
  double impacts = std::numeric_limits<double>::quiet_NaN();

  double total() const { return motor_friction + load_friction + impacts; }
};

/// Times in units of 1/ω_n, angles in rad at the load shaft. NaN where not computed.
struct LimitCycle {
  CycleKind kind = CycleKind::symmetric;
  bool stable = false;                                          ///< |multiplier| < 1
  double amplitude = std::numeric_limits<double>::quiet_NaN();  ///< half peak-to-peak of the load
  double motor_amplitude = std::numeric_limits<double>::quiet_NaN();  ///< the same of the motor
  double period = std::numeric_limits<double>::quiet_NaN();
  double multiplier = std::numeric_limits<double>::quiet_NaN();    ///< Floquet's, largest modulus,
                                                                   ///< over a whole period
  double impact_speed = std::numeric_limits<double>::quiet_NaN();  ///< |v_M − v_L| before the
                                                                   ///< hardest impact
  double mesh_torque = std::numeric_limits<double>::quiet_NaN();   ///< the largest |N| of engaged
                                                                   ///< faces, units of K rad
  double engaged_time = std::numeric_limits<double>::quiet_NaN();  ///< a period's share
  double separated_time = std::numeric_limits<double>::quiet_NaN();  ///< a period's share
  double residual = std::numeric_limits<double>::quiet_NaN();  ///< relative mismatch of the state
                                                               ///< after one map, of its amplitude
  int traversals = 1;  ///< of the gap, after which it repeats (mirrored if they are odd)
  std::size_t impacts_per_period = 0;  ///< impacts counted one by one; a settling adds none more
  bool settles = false;                ///< bounces settle (or are plastic) before each separation
  EnergyLost energy{};                 ///< a period, units of K rad²
  ServoState start;  ///< a state on the cycle, about reference 0: as the faces part forward
                     ///< (plastic contact), or just after an impact on the forward face
};

struct LimitCycleAnalysis {
  Verdict verdict = Verdict::cannot_hunt;
  /// For the verdict, and for the number of limit cycles that mirror themselves.
  Certainty certainty = Certainty::searched;
  double growth_at_rest = std::numeric_limits<double>::quiet_NaN();  ///< μ₀, see growth_at_rest()
  /// Whether no restitution can make it hunt: 1/c + 1/D ≤ 2ζ, decided exactly for the given numbers
  /// (docs/explanation/absence-by-energy.md).
  bool is_dissipative = false;
  /// Whether some motions may end at rest with the faces together, on either: ζ ≥ 1, of a box for
  /// some ζ in it. Such a servo has rest beside its limit cycle: small motion in the gap grows, and
  /// a large one ends with the faces together (docs/explanation/servo.md, One cycle or none).
  bool rests_engaged = false;
  /// Whether some cycles could not be separated from their neighbours, because their multiplier is
  /// 1 to within rounding (on a boundary in the parameters, or ζ below 1e-9). They are not listed.
  bool neutral_swings = false;
  std::vector<LimitCycle> cycles;  ///< by decreasing amplitude
  /// Half the peak-to-peak of bounded motion that was not seen to repeat. It may exist beside a
  /// stable cycle. NaN if every start ended in a cycle or at rest.
  double irregular_amplitude = std::numeric_limits<double>::quiet_NaN();
  std::optional<CycleBounds> bounds;  ///< proved; set on request if contact is plastic

  bool is_proved() const { return certainty >= Certainty::enclosed; }
};

/// All limit cycles that can be found, and the verdict.
///
/// e = 0 (or a massless side): the return map is one-dimensional. There is exactly one cycle that
/// mirrors itself when growth_at_rest > 1 and none otherwise (proof:
/// docs/explanation/servo.md). It is the root of one scalar equation and always found. The
/// verdict is `computed`, or a `theorem` if growth at rest is not needed (a shaft, or both, without
/// friction; no backlash; 1/c + 1/D ≤ 2ζ). 0 < e ≤ 1: if 1/c + 1/D ≤ 2ζ nothing can hunt, a
/// `theorem`. Otherwise Newton's method finds fixed points of the return map (return_map.hpp), from
/// a scan over amplitudes, from the motions in which small, middle and large starts end, and from
/// the unstable cycles found. The list is as complete as the scan is fine, hence `searched`. Every
/// cycle reported is one, to its residual. Throws InvalidInput.
LimitCycleAnalysis analyse_limit_cycles(const NormalizedServo& servo);

/// The same, proved: with plastic contact the growth at rest, the cycle and its multiplier are
/// enclosed for every servo of `box`, which holds the data from which `servo` was rounded. The
/// verdict is `enclosed` if all of the box agree with it. Otherwise it is undecided, and
/// bounds->growth_at_rest gives the width about 1. Throws InvalidInput.
LimitCycleAnalysis enclose_limit_cycles(const NormalizedServo& servo, const ServoBox& box);
/// For the servo itself, or for the decimals that its numbers represent.
LimitCycleAnalysis enclose_limit_cycles(const NormalizedServo& servo, Reading reading);

/// Growth at rest and, near the cycle of a servo that differs slightly, the cycle of `servo`,
/// without a verdict. With bounces it is followed by Newton's method, and left out where it has
/// another number of impacts. Precondition: sound servos, and a cycle of `servo_near` or nullptr.
LimitCycleAnalysis analyse_beside(const NormalizedServo& servo, const LimitCycle* near,
                                  const NormalizedServo& servo_near);

/// The cycle that is seen in practice: the largest stable one, or nullptr.
const LimitCycle* largest_stable(const LimitCycleAnalysis& analysis);

}  // namespace gearlash
