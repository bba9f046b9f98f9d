// What every servo of a box has in common: proved bounds of its limit cycle.
#pragma once

#include <limits>

#include "base/bounds.hpp"
#include "model/drivetrain.hpp"
#include "model/normalized_servo.hpp"

namespace gearlash {

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

/// Which number a double stands for.
enum class Reading {
  exact,     ///< itself
  decimal,   ///< the shortest decimal that reads back as it: what an author wrote, as 0.19
  converted  ///< what it was worked out as from data with units, to DataError
};

/// How far numbers may be from the data that they were worked out from, as shares of themselves:
/// decimals, their units, and products of a few of them. A 0 is one.
struct DataError {
  double each = 0x1p-46;            ///< sixty-four units in the last place
  double motor_friction = 0x1p-46;  ///< of F_M: more where it was worked out from a friction ratio
};

/// The box of one servo. Precondition: validate(servo) is empty.
ServoBox box_of(const NormalizedServo& servo, Reading reading);

/// Drives, with plastic contact; and how many seconds their unit of time, 1/ω_n, lasts.
struct DriveBox {
  ServoBox servo;
  Bounds time_unit;
  Bounds backlash;  ///< rad
};

/// The drives between two, of which every number lies between theirs: those whose numbers are
/// powers of one parameter, or grow or fall with it. Precondition: both are sound.
DriveBox box_between(const Drivetrain& low, const Drivetrain& high, const DataError& error = {});

/// Bounds that hold for every servo of a box.
struct CycleBounds {
  static constexpr double infinity = std::numeric_limits<double>::infinity();

  Bounds growth_at_rest{0.0, infinity};
  /// Of the cycle, if there is one: half peak-to-peak of the load over the backlash.
  Bounds size{0.0, infinity};
  Bounds period{0.0, infinity};  ///< likewise, in units of 1/ω_n
  Bounds multiplier{0.0, 1.0};   ///< likewise, Floquet's; where it was asked for
  bool has_cycle = false;        ///< all hunt, and all of the above are bounds of their cycles

  bool none_hunt() const { return growth_at_rest.high <= 1.0; }
  bool all_hunt() const { return growth_at_rest.low > 1.0; }
};

enum class MultiplierBounds { left_out, wanted };

/// By interval arithmetic on the closed forms (base/interval.hpp), rounded outward: where a
/// function is monotone (the divided differences of exp in their rates, the time to the first zero
/// of a damped oscillation in damping and slope, the growth of a half cycle in its flight time) its
/// bounds are those at the ends, so that they close in on the exact values as the box shrinks, in
/// proportion to its width. `guessed_flight_time` is of a servo in the box that hunts, and NaN
/// where none is known: bounds are narrower where it is good, and true where it is not. Sources:
/// Moore, Interval Analysis (1966), chapter 4; the monotony: docs/mathematics.md.
CycleBounds bound_cycles(const ServoBox& box, double guessed_flight_time,
                         MultiplierBounds multiplier = MultiplierBounds::left_out);

}  // namespace gearlash
