// Proved bounds of the limit cycles of all servos in a box.
#pragma once

#include "base/special_numbers.hpp"
#include "gearlash/bounds.hpp"
#include "model/drivetrain.hpp"
#include "model/normalized_servo.hpp"

namespace gearlash {

/// Servos with plastic contact, ω_n = 1 and J_M + J_L = 1, each number within its bounds. One side
/// may be massless, in all of them: its rate is infinite. The five numbers are not independent (J_M
/// c + J_L D = 2ζ). Each is stated as tightly as known, and everything within all of them is
/// covered.
struct ServoBox {
  Bounds damping;        ///< ζ ≥ 0
  Bounds motor_inertia;  ///< J_M, 0 < J_M < 1, or 0 alone
  Bounds load_inertia;   ///< J_L, likewise
  Bounds motor_rate;     ///< c = F_M/J_M
  Bounds load_rate;      ///< D = F_L/J_L
};

/// The number that a double represents.
enum class Reading {
  exact,     ///< itself
  decimal,   ///< the shortest decimal that reads back as it: what an author wrote, such as 0.19
  converted  ///< the result of a computation from data with units, to DataError
};

/// Largest difference between numbers and the data from which they were computed, as shares of
/// themselves: decimals, their units, and products of a few of them. A 0 is exact.
struct DataError {
  double each = 0x1p-46;            ///< sixty-four units in the last place
  double motor_friction = 0x1p-46;  ///< for F_M; more if computed from a friction ratio
  /// N m s/rad: F_M may be larger by this; of a friction ratio that was rounded to 1.
  double hidden_motor_friction = 0.0;
};

/// The box of one servo. Precondition: faults(servo) is empty.
ServoBox box_of(const NormalizedServo& servo, Reading reading);

/// Drives with plastic contact, and the seconds in their unit of time, 1/ω_n.
struct DriveBox {
  ServoBox servo;
  Bounds time_unit;
  Bounds backlash;  ///< rad
};

/// All drives between two, with every number between theirs. This covers drives whose numbers are
/// powers of one parameter, or grow or fall with it. Precondition: both are sound.
DriveBox box_between(const Drivetrain& low, const Drivetrain& high, const DataError& error = {});

/// Bounds that hold for every servo of a box.
struct CycleBounds {
  Bounds growth_at_rest{0.0, infinity};
  /// For the cycle, if there is one: half peak-to-peak of the load over the backlash.
  Bounds amplitude{0.0, infinity};
  Bounds period{0.0, infinity};  ///< likewise, in units of 1/ω_n
  Bounds multiplier{0.0, 1.0};   ///< likewise, Floquet's; if requested
  bool has_cycle = false;        ///< all hunt, and the above are bounds of their cycles

  bool none_hunt() const { return growth_at_rest.high <= 1.0; }
  bool all_hunt() const { return growth_at_rest.low > 1.0; }
};

enum class MultiplierBounds { left_out, wanted };

/// By interval arithmetic on the closed forms (base/interval.hpp), rounded outward. The bounds of a
/// monotone function are its values at the ends. Monotone are the divided differences of exp in
/// their rates, the time to the first zero of a damped oscillation in damping and slope, and the
/// growth of a half cycle in its flight time. So the bounds tighten in proportion to the width of
/// the box. `guessed_flight_time` belongs to a hunting servo in the box; NaN if none is known. A
/// good guess makes the bounds narrower; they hold for any. Sources: Moore, Interval Analysis
/// (1966), chapter 4; the monotony: docs/explanation/boxes.md.
CycleBounds bound_cycles(const ServoBox& box, double guessed_flight_time,
                         MultiplierBounds multiplier = MultiplierBounds::left_out);

}  // namespace gearlash
