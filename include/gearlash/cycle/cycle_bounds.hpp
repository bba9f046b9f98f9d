// What every servo of a box has in common: proved bounds of its limit cycle.
#pragma once

#include <limits>

namespace gearlash {

/// All numbers from low to high.
struct Bounds {
  double low = 0.0;
  double high = 0.0;

  bool operator==(const Bounds&) const = default;
};

/// Servos with plastic contact, ω_n = 1 and J_M + J_L = 1, of which each number lies within its
/// bounds. One side may be massless, in all of them: its rate is infinite. The five are not
/// independent (J_M c + J_L D = 2ζ): each is stated as tightly as is known, and whatever lies
/// within all of them is covered.
struct ServoBox {
  Bounds damping;        ///< ζ ≥ 0
  Bounds motor_inertia;  ///< J_M, 0 < J_M < 1, or 0 alone
  Bounds load_inertia;   ///< J_L, likewise
  Bounds motor_rate;     ///< c = F_M/J_M
  Bounds load_rate;      ///< D = F_L/J_L
};

/// Bounds that hold for every servo of a box.
struct CycleBounds {
  static constexpr double infinity = std::numeric_limits<double>::infinity();

  Bounds growth_at_rest{0.0, infinity};
  /// Of the cycle, if there is one: half peak-to-peak of the load over the backlash.
  Bounds size{0.0, infinity};
  Bounds period{0.0, infinity};  ///< likewise, in units of 1/ω_n

  bool none_hunt() const { return growth_at_rest.high <= 1.0; }
  bool all_hunt() const { return growth_at_rest.low > 1.0; }
};

/// By interval arithmetic on the closed forms: where a function is monotone (the divided
/// differences of exp in their rates, the time to the first zero of a damped oscillation in damping
/// and slope, the growth of a half cycle in its flight time) its bounds are those at the ends, so
/// that they close in on the exact values as the box shrinks, in proportion to its width. Bounds
/// that rounding could decide are widened by 1e-12 of themselves. `guessed_flight_time` is of a
/// servo in the box that hunts, and NaN where none is known: bounds are narrower where it is good,
/// and true where it is not.
/// Sources: Moore, Interval Analysis (1966), chapter 4; the monotony: docs/mathematics.md.
CycleBounds bound_cycles(const ServoBox& box, double guessed_flight_time);

}  // namespace gearlash
