// Both shafts as one: the closed form of ÿ + 2ζẏ + y = 0 and its zeros.
#pragma once

#include <cmath>
#include <limits>

namespace gearlash {

/// A damped oscillation given by its state at time 0. The closed form holds for every ζ ≥ 0 and is
/// continuous through ζ = 1:
///   y(t) = y₀ (C + ζS) + ẏ₀ S,   ẏ(t) = ẏ₀ (C − ζS) − y₀ S,
///   C = e^{−ζt} cos wt, S = e^{−ζt} sin(wt)/w, w = √(1−ζ²)   (cosh, sinh beyond ζ = 1).
struct EngagedFlow {
  double damping = 0.0;   ///< ζ
  double position = 0.0;  ///< y₀, rad from the reference
  double speed = 0.0;     ///< ẏ₀

  struct State {
    double position;
    double speed;
  };
  State at(double time) const;
};

/// Q(y, v) = y² + 2ζyv + v², which the engaged flow multiplies by e^{−2ζt} for every ζ.
template <class Real>
Real decaying_form(Real damping, Real position, Real speed) {
  return position * position + 2.0 * damping * position * speed + speed * speed;
}

/// First time > 0 at which x(t) = 0, where ẍ + 2ζẋ + x = 0, x(0) = value, ẋ(0) = slope; infinity
/// if there is none. A zero at t = 0 itself is not counted.
///
/// Guarantee: x is one damped sinusoid (ζ < 1) or a sum of two decaying exponentials (ζ ≥ 1), so
/// its zeros have a closed form. For ζ < 1 the first is at angle wt ∈ (0, π] given by atan2(|x₀| w,
/// ∓(ẋ₀ + ζx₀)). For ζ ≥ 1 there is at most one, where (e^{2ωt} − 1)/(2ω) = −x₀/(ẋ₀ + λ₂x₀), ω =
/// √(ζ²−1), λ₂ = ζ + ω. There is no search, so in exact arithmetic none is missed. A double zero
/// exists only where x vanishes identically. In doubles rounding decides, for ζ ≥ 1, where ẋ₀ +
/// λ₂x₀ is a difference of nearly equal terms. The slow decay is then absent to rounding, and its
/// zero would come when x has nearly died out.
template <class Real>
Real first_zero(Real damping, Real value, Real slope) {
  using std::abs;
  using std::acos;
  using std::atan2;
  using std::isinf;
  using std::log1p;
  using std::sqrt;
  const Real never = std::numeric_limits<Real>::infinity();
  if (damping < 1.0) {
    const Real frequency = sqrt((1.0 - damping) * (1.0 + damping));
    if (value == 0.0) return slope == 0.0 ? never : Real(acos(Real(-1.0)) / frequency);
    const Real rising = slope + damping * value;
    return atan2(abs(value) * frequency, value > 0.0 ? Real(-rising) : rising) / frequency;
  }
  const Real half_split = sqrt((damping - 1.0) * (damping + 1.0));
  const Real fast = damping + half_split;
  const Real quotient = -value / (slope + fast * value);
  if (!(quotient > 0.0) || isinf(quotient)) return never;
  if (half_split == 0.0) return quotient;
  return log1p(2.0 * half_split * quotient) / (2.0 * half_split);
}

}  // namespace gearlash
