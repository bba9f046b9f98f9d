// The classical harmonic balance of the servo of 1960, beside which other analyses are put.
#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include "gearlash/fault.hpp"
#include "model/normalized_servo.hpp"
#include "question/loop/describing/harmonic_balance.hpp"

namespace gearlash {

/// The assumed motion of the load while the gap is crossed.
enum class LoadInGap {
  held_by_friction,  ///< it stays (FrictionControlledBacklash)
  coasting           ///< it keeps its speed (InertiaControlledBacklash)
};

/// Times in units of 1/ω_n, angles in rad at the load shaft.
struct DescribedCycle {
  LoadInGap load = LoadInGap::held_by_friction;
  double amplitude = std::numeric_limits<double>::quiet_NaN();  ///< half peak-to-peak of the load
  double motor_amplitude = std::numeric_limits<double>::quiet_NaN();  ///< the motor's amplitude
  double period = std::numeric_limits<double>::quiet_NaN();
  bool stable = false;
  double residual = std::numeric_limits<double>::quiet_NaN();
};

/// What the classical harmonic balance predicts of the servo, to be put beside the exact answer of
/// analyse_limit_cycles(): first the cycles of a load held by friction, then of a coasting one,
/// each by increasing amplitude.
///
/// Assumed, as textbooks do: the motor drives all the inertia and all the friction at all times, so
/// that θ_M = −G θ_L with G = 1/(s² + 2ζs), and the load is a function of the motor's angle alone,
/// θ_L = N(A) θ_M. Neglected: that the motor is lighter and less damped while the faces are apart;
/// the torque and the loss of the impact; all harmonics; the true motion of the load in the gap, of
/// which the two cases are the limits of much and no load friction. So the prediction depends on
/// damping and backlash alone, and inertia_ratio, friction_ratio and restitution say only which
/// case is the likelier.
///
/// What comes of it: with the load held by friction two cycles for ζ < 0.270504 (the smaller
/// unstable), none above; with a coasting load one, stable, for every ζ > 0; for ζ = 0 none, its
/// amplitude being infinite. (K/(s(Ts+1)) with K = T = 1/2ζ: KT = 1/4ζ² ≥ 3.4165809.) The smaller
/// cycle is left out for ζ < 2e-7, where A is next to h.
/// Throws InvalidInput.
inline std::vector<DescribedCycle> describing_function_estimate(const NormalizedServo& servo) {
  require_none(faults(servo));
  std::vector<DescribedCycle> estimate;
  const double damping = servo.damping;
  const double gap = servo.backlash;
  if (damping == 0.0 || gap == 0.0) return estimate;
  const TransferFunction loop{{1.0}, {1.0, 2.0 * damping, 0.0}, 0.0};
  // |N| < 4/π has ω below 1.13. For small ζ the smaller cycle is at 11 ζ³, and for great ζ the only
  // one at 0.64/ζ.
  const Bounds frequencies{std::min(damping * damping * damping, 0.1 / damping), 2.0};
  const auto append = [&](LoadInGap load, const auto& play) {
    for (const PredictedCycle& cycle : harmonic_balance(play, loop, frequencies).cycles) {
      estimate.push_back({load, load_amplitude(play, cycle), cycle.amplitude, cycle.period,
                          cycle.stable, cycle.residual});
    }
  };
  append(LoadInGap::held_by_friction, FrictionControlledBacklash{gap});
  append(LoadInGap::coasting, InertiaControlledBacklash{gap});
  return estimate;
}

}  // namespace gearlash
