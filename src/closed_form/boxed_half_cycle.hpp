// A half cycle of all servos of a box at once, in interval arithmetic.
#pragma once

#include "base/interval.hpp"
#include "closed_form/cycle_bounds.hpp"

namespace gearlash::detail {

/// The end of a half cycle after flights of given times.
struct BoxedEnd {
  Interval moved;       ///< y at impact minus y at parting
  Interval position;    ///< y at impact
  Interval speed;       ///< P, the common speed just after impact
  Interval kick;        ///< J_M |u̇| just before impact
  Interval crossed;     ///< J_M |u − u₀|; for a massless motor F_M replaces J_M
  Interval gap;         ///< |u − u₀|
  Interval form;        ///< Q(y, P) just after impact, not below 0
  Interval engaged;     ///< t₁, from the impact to the next parting
  Interval log_growth;  ///< ln ρ, −∞ where the faces do not part again
};

/// Half cycles that part at the speed 1. Those of a massless load part at rest, at the position 1.
/// Formulas: docs/explanation/servo.md, "One cycle or none", and docs/explanation/boxes.md.
class BoxedHalfCycle {
 public:
  explicit BoxedHalfCycle(const ServoBox& box);

  /// Q at parting, (λ₁ − D)(λ₂ − D). No servo hunts if it is not positive.
  const Interval& form_at_parting() const { return form_at_parting_; }

  /// μ₀: 0 if the faces never part again, ∞ for a shaft without friction.
  Interval growth_at_rest() const;

  /// After a flight of this time. Precondition: form_at_parting() > 0, time > 0.
  BoxedEnd end(const Interval& time) const;

  /// Half peak-to-peak of the load: where it parts, where it meets, and where it turns while
  /// engaged.
  Interval amplitude(const BoxedEnd& end) const;

  /// J_M U (y + cP) after a flight of this time, U = |u − u₀|. Where Q exceeds it, a longer flight
  /// lowers the amplitude at parting, measured in gaps crossed.
  Interval thrust(const Interval& time, const BoxedEnd& end) const;

  const Interval& motor_rate() const { return motor_rate_; }
  bool has_two_masses() const { return !massless_motor_ && !massless_load_; }

 private:
  bool is_overdamped() const { return damping_.low >= 1.0; }
  Interval form_of(const Interval& position, const Interval& speed) const;
  Interval overdamped_growth_at_rest(const Interval& motor_time, const Interval& load_time,
                                     const Interval& rising) const;

  BoxedEnd flight_of_two_masses(const Interval& time) const;
  BoxedEnd flight_of_massless_motor(const Interval& time) const;
  BoxedEnd flight_over_massless_load(const Interval& time) const;
  void set_growth(BoxedEnd& end) const;
  Interval form_change(const BoxedEnd& end) const;
  Interval speed_change(const BoxedEnd& end) const;
  Interval slow_part(const BoxedEnd& end) const;
  Interval engaged_time(const BoxedEnd& end) const;
  Interval overdamped_engaged_time(const BoxedEnd& end) const;

  bool massless_motor_;
  bool massless_load_;
  Interval damping_;
  Interval motor_inertia_;
  Interval load_inertia_;
  Interval motor_rate_;
  Interval load_rate_;
  Interval slow_rate_;   ///< λ₁ of overdamped servos
  Interval fast_rate_;   ///< λ₂
  Interval rate_split_;  ///< λ₂ − λ₁
  Interval parting_position_;
  Interval form_at_parting_;
};

/// Bounds of the flight times of the cycles of all servos of a box. The growth is below 1 for all
/// of them after the shortest, and above 1 after the longest. 0 or infinity if none is found.
struct FlightTimes {
  double shortest;
  double longest;
};

/// Starts from the flight time of a servo in the box.
FlightTimes bounding_flight_times(const BoxedHalfCycle& half, double guess, bool all_hunt);

}  // namespace gearlash::detail
