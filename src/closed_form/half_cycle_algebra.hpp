// The half cycle's branch-free formulas, for one servo or several side by side.
//
// They hold for every servo alike and call no library function but √. Real is double for one servo,
// or a vector of doubles for several (src/closed_form/lanes).
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/bracketed_root.hpp"
#include "closed_form/engaged_flow.hpp"
#include "closed_form/gap_flight.hpp"
#include "closed_form/servo_dynamics.hpp"

namespace gearlash {

/// Half a cycle that starts with the faces parting forward at unit amplitude on the torque-free
/// line, as a function of the flight time t. Everything scales with the amplitude.
template <class Real>
struct BasicUnitHalfCycle {
  Real flight_time;       ///< t₂
  Real engaged_time;      ///< t₁, infinite if the faces do not part again
  Real load_moved;        ///< y at impact minus y at parting
  Real load_position;     ///< y at impact
  Real load_speed;        ///< v_L just before impact
  Real gap_displacement;  ///< u − u₀ at impact, < 0
  Real gap_speed;         ///< u̇ just before impact, ≤ 0
  Real gap_acceleration;  ///< ü just before impact
  Real common_speed;      ///< P = J_M v_M + J_L v_L, the speed just after impact
  Real square_change;     ///< (y² + P²) just after impact minus (y² + v²) at parting
  Real form_change;       ///< Q just after impact minus Q at parting
  Real form;              ///< Q(y, P) = y² + 2ζyP + P² just after impact
  Real log_growth;        ///< ln ρ, ρ the amplitude at the next parting; −∞ if there is none
  Real log_growth_slope;  ///< d ln ρ/dt₂ = |u̇| (J_M y + F_M P)/(y² + 2ζyP + P²), > 0
};
using UnitHalfCycle = BasicUnitHalfCycle<double>;

/// Q at parting.
template <class Real>
Real start_form(const BasicServoDynamics<Real>& dynamics, const BasicGapFlight<Real>& flight) {
  return decaying_form(dynamics.damping, flight.load_position, flight.load_speed);
}

/// All that follows from the state at the impact. The engaged time and the growth are set later.
template <class Real>
BasicUnitHalfCycle<Real> impact_at(const BasicServoDynamics<Real>& dynamics,
                                   const BasicGapFlight<Real>& flight, Real time,
                                   const BasicFlightPoint<Real>& point) {
  const BasicFlightMotion<Real>& motion = point.motion;
  BasicUnitHalfCycle<Real> half;
  half.flight_time = time;
  half.gap_displacement = point.gap_displacement;
  half.load_moved = motion.load_moved;
  half.load_position = motion.load_position;
  half.load_speed = motion.load_speed;
  half.gap_speed = motion.gap_speed;
  half.gap_acceleration = motion.gap_acceleration;
  half.common_speed = motion.load_speed + dynamics.motor_inertia * motion.gap_speed;

  // Q(impact) − Q(start) comes from the differences of position and speed: for light damping it is
  // far smaller than either.
  const Real moved = motion.load_moved;
  const Real speeded = -flight.load_rate * moved + dynamics.motor_inertia * motion.gap_speed;
  half.square_change =
      moved * (2.0 * flight.load_position + moved) + speeded * (2.0 * flight.load_speed + speeded);
  half.form_change = half.square_change + 2.0 * dynamics.damping *
                                              (flight.load_position * speeded +
                                               moved * flight.load_speed + moved * speeded);
  half.form = start_form(dynamics, flight) + half.form_change;
  half.log_growth_slope =
      -half.gap_speed *
      (dynamics.motor_inertia * half.load_position + dynamics.motor_friction * half.common_speed) /
      half.form;
  return half;
}

/// The amplitude at the next parting of faces that engage with the load at rest at −1 and the motor
/// arriving at contact_speed, and the position at which the load then comes to rest: μ₀.
template <class Real>
Real growth_after_contact(const BasicServoDynamics<Real>& dynamics, const Real& contact_speed,
                          const Real& engaged_time) {
  using std::abs;
  using std::exp;
  using std::sqrt;
  const BasicTorqueFreeLine<Real>& line = dynamics.torque_free_line;
  const Real start = decaying_form<Real>(dynamics.damping, -1.0, contact_speed);
  const Real end = decaying_form(dynamics.damping, line.position, line.speed);
  return sqrt(start / end) * exp(-dynamics.damping * engaged_time) *
         abs(line.position + line.speed / dynamics.load_rate);
}

/// (Ṅ + ζN)/|N| as the motor arrives at a load at rest, where N is the mesh torque:
///   (1 − ζ² − (c − ζ)(D − ζ))/(J_M D + J_L c),
/// by the shafts' time constants 1/c and 1/D, which are 0 for a massless side. It is the slope of
/// e^{ζt}N/|N|, whose first zero ends the contact.
template <class Real>
Real rising_at_rest(const Real& damping, const Real& motor_inertia, const Real& load_inertia,
                    const Real& motor_time, const Real& load_time) {
  const Real square = (1.0 - damping) * (1.0 + damping);
  return (square * (motor_time * load_time) -
          (1.0 - damping * motor_time) * (1.0 - damping * load_time)) /
         (motor_inertia * motor_time + load_inertia * load_time);
}

/// Change of the state at the impact with the flight time.
template <class Real>
struct BasicArrivalRates {
  Real motor_acceleration;  ///< v̇_M before the impact
  Real load_acceleration;   ///< v̇_L
  Real momentum;            ///< Ṗ
  Real form;                ///< Q̇
  Real growth_curvature;    ///< d² ln ρ/dt²
};
using ArrivalRates = BasicArrivalRates<double>;

/// d² ln ρ/dt² from the product that makes its slope: with S = J_M y + F_M P,
///   (ln ρ)″/(ln ρ)′ = ü/u̇ + Ṡ/S − Q̇/Q.
template <class Real>
BasicArrivalRates<Real> arrival_rates(const BasicServoDynamics<Real>& dynamics,
                                      const BasicGapFlight<Real>& flight,
                                      const BasicUnitHalfCycle<Real>& half) {
  const Real motor_speed = half.load_speed + half.gap_speed;
  const Real load_acceleration = -flight.load_rate * half.load_speed;
  const Real momentum = -dynamics.motor_friction * motor_speed -
                        dynamics.load_friction * half.load_speed - half.load_position;
  const Real form =
      2.0 *
      (half.load_position * half.load_speed + half.common_speed * momentum +
       dynamics.damping * (half.load_speed * half.common_speed + half.load_position * momentum));
  const Real drive =
      dynamics.motor_inertia * half.load_position + dynamics.motor_friction * half.common_speed;
  const Real drive_rate =
      dynamics.motor_inertia * half.load_speed + dynamics.motor_friction * momentum;
  const Real curvature = half.log_growth_slope * (half.gap_acceleration / half.gap_speed +
                                                  drive_rate / drive - form / half.form);
  return {half.gap_acceleration + load_acceleration, load_acceleration, momentum, form, curvature};
}

/// ln ρ with its derivatives.
template <class Real>
BasicValueAndSlope<Real> growth_at(const BasicUnitHalfCycle<Real>& half,
                                   const BasicArrivalRates<Real>& rates) {
  return {half.log_growth, half.log_growth_slope, rates.growth_curvature};
}

/// d³u/dt³ of two masses, from ü e^{ct} = ü₀ + G t φ₁((c − D)t) after a clean parting.
template <class Real>
Real gap_jerk_of_two_masses(const BasicGapFlight<Real>& flight,
                            const BasicUnitHalfCycle<Real>& half) {
  return flight.gap_drive * (half.load_speed / flight.load_speed) -
         flight.motor_rate * half.gap_acceleration;
}

/// Half a cycle whose flight is `step` longer, to second order in the step; gap_jerk is d³u/dt³.
template <class Real>
BasicUnitHalfCycle<Real> stepped(const BasicServoDynamics<Real>& dynamics,
                                 const BasicGapFlight<Real>& flight,
                                 const BasicUnitHalfCycle<Real>& half,
                                 const BasicArrivalRates<Real>& rates, Real gap_jerk, Real step) {
  const Real moved = step * (half.load_speed + 0.5 * step * rates.load_acceleration);
  const BasicFlightPoint<Real> point = {
      .motion = {.load_moved = half.load_moved + moved,
                 .load_position = half.load_position + moved,
                 .load_speed = half.load_speed - flight.load_rate * moved,
                 .gap_speed =
                     half.gap_speed + step * (half.gap_acceleration + 0.5 * step * gap_jerk),
                 .gap_acceleration = half.gap_acceleration + step * gap_jerk},
      .gap_displacement =
          half.gap_displacement + step * (half.gap_speed + 0.5 * step * half.gap_acceleration)};
  BasicUnitHalfCycle<Real> next = impact_at(dynamics, flight, half.flight_time + step, point);
  const Real momentum_acceleration = -dynamics.motor_friction * rates.motor_acceleration -
                                     dynamics.load_friction * rates.load_acceleration -
                                     half.load_speed;
  const Real form_acceleration =
      2.0 * (half.load_speed * half.load_speed + half.load_position * rates.load_acceleration +
             rates.momentum * rates.momentum + half.common_speed * momentum_acceleration +
             dynamics.damping * (rates.load_acceleration * half.common_speed +
                                 2.0 * half.load_speed * rates.momentum +
                                 half.load_position * momentum_acceleration));
  // From ln ρ = ½ ln Q − ζ t₁ + const.
  const Real relative_rate = rates.form / half.form;
  const Real engaged_rate = (0.5 * relative_rate - half.log_growth_slope) / dynamics.damping;
  const Real engaged_acceleration =
      (0.5 * (form_acceleration / half.form - relative_rate * relative_rate) -
       rates.growth_curvature) /
      dynamics.damping;
  next.engaged_time = half.engaged_time + step * (engaged_rate + 0.5 * step * engaged_acceleration);
  next.log_growth =
      half.log_growth + step * (half.log_growth_slope + 0.5 * step * rates.growth_curvature);
  return next;
}

/// A flight time near the root of ln ρ(t) = 0, usually within 2 %.
///
/// Near t = 0, ln ρ = −δ + κ t³/6 + t⁴/8 with δ = ζπ/w, κ = c J_L + D J_M the drag on the gap's
/// motion. In the end it tends to ln μ₀. One step of Newton's method gives the first root, and a
/// factor √(1 + δ/ln μ₀) the second. A polynomial corrects both; it is fitted to the thesis's range
/// and beyond (damping 0.05 to 0.6, inertia ratio 1/9 to 9, friction ratio 0.04 to 0.99).
template <class Real>
Real guessed_flight_time(const BasicServoDynamics<Real>& dynamics, Real log_growth_at_rest) {
  using std::max;
  using std::min;
  using std::sqrt;
  const Real fastest_rate = 1e3;
  const Real least_frequency_squared = 0.05;
  const Real drag = min(dynamics.motor_rate, fastest_rate) * dynamics.load_inertia +
                    min(dynamics.load_rate, fastest_rate) * dynamics.motor_inertia;
  const Real frequency_squared = 1.0 - dynamics.damping * dynamics.damping;
  const Real deficit =
      std::numbers::pi * dynamics.damping / sqrt(max(least_frequency_squared, frequency_squared));
  // From t⁴/8 = δ: 3t/4 + … instead of t minus the step.
  const Real undragged = sqrt(sqrt(8.0 * deficit));
  const Real early = undragged * (1.0 - drag / (3.0 * (undragged + drag)));
  const Real fitted = 8.0;
  const Real fitted_excess = 4.0;
  const Real longest = 1e3;
  const Real excess = deficit / log_growth_at_rest;
  const Real whole_drag = drag * early;
  const Real k = min(whole_drag, fitted);
  const Real x = min(excess, fitted_excess);
  const Real correction =
      1.0 + k * (0.019 - 0.0087 * k) + x * (0.0119 - 0.0211 * x) + early * (0.0385 + 0.072 * k);
  const Real guess = early * sqrt(1.0 + excess) * correction;
  return min(longest, guess);
}

/// Steps this short, in units of the fastest of the flight's rates, end the search: what
/// second order omits is then below rounding.
inline constexpr double short_step = 1e-5;

/// The motor's speed at one time of the flight and its derivatives: v̈ = −c v̇ − a, ȧ = −D a, where
/// a = motor_drive v_L.
template <class Real>
struct BasicMotorSpeed {
  BasicValueAndSlope<Real> speed;
  Real third;   ///< d³v/dt³
  Real fourth;  ///< d⁴v/dt⁴
};

/// motor_drive is 1/J_M; and for a massless motor, whose v_M = −y/F_M, −D/F_M (and c = 0).
template <class Real>
BasicMotorSpeed<Real> motor_speed_at(const BasicGapFlight<Real>& flight, Real motor_drive,
                                     Real load_speed, Real gap_speed, Real gap_acceleration) {
  const Real drive = motor_drive * load_speed;
  const Real acceleration = gap_acceleration - flight.load_rate * load_speed;
  const Real jerk = -flight.motor_rate * acceleration - drive;
  const Real drive_rate = -flight.load_rate * drive;
  const Real third = -flight.motor_rate * jerk - drive_rate;
  const Real fourth = -flight.motor_rate * third + flight.load_rate * drive_rate;
  return {{load_speed + gap_speed, acceleration, jerk}, third, fourth};
}

/// Root of the quintic through value, slope and curvature at 0 and at `end`, values of opposite
/// sign, to about 1e-4 of `end`: Halley's step from the root of a parabola.
template <class Real>
Real quintic_root(const BasicValueAndSlope<Real>& at_start, const BasicValueAndSlope<Real>& at_end,
                  Real end) {
  using std::sqrt;
  const Real value = at_start.value;
  const Real slope = at_start.slope * end;
  const Real square = 0.5 * at_start.curvature * end * end;
  const Real rise = at_end.value - value;
  const Real parabola_root =
      2.0 * value / (sqrt(slope * slope - 4.0 * (rise - slope) * value) - slope);
  const Real value_left = rise - slope - square;
  const Real slope_left = at_end.slope * end - slope - 2.0 * square;
  const Real curvature_left = 0.5 * at_end.curvature * end * end - square;
  const Real cubic = 10.0 * value_left - 4.0 * slope_left + curvature_left;
  const Real quartic = -15.0 * value_left + 7.0 * slope_left - 2.0 * curvature_left;
  const Real quintic = 6.0 * value_left - 3.0 * slope_left + curvature_left;
  const Real x = parabola_root;
  const BasicValueAndSlope<Real> at_x = {
      value + x * (slope + x * (square + x * (cubic + x * (quartic + x * quintic)))),
      slope + x * (2.0 * square + x * (3.0 * cubic + x * (4.0 * quartic + x * 5.0 * quintic))),
      2.0 * square + x * (6.0 * cubic + x * (12.0 * quartic + x * 20.0 * quintic))};
  return (x + newton_step(at_x)) * end;
}

/// This near the motor's turn position_at_turn() may start, as a share of a flight of this length:
/// the omitted term of Taylor's series is below rounding.
template <class Real>
Real nearness_of_turn(const BasicGapFlight<Real>& flight, const Real& time) {
  return 0.006 / (1.0 + (flight.motor_rate + flight.load_rate) * time);
}

/// The motor's position, from the gap's middle line, where it turns (and is stationary), by
/// Taylor's series from a time next to it.
template <class Real>
Real position_at_turn(const BasicFlightPoint<Real>& point, const BasicMotorSpeed<Real>& here) {
  const Real step = newton_step(here.speed);
  return point.motion.load_position + point.gap_displacement +
         step * (here.speed.value +
                 step * (here.speed.slope / 2.0 +
                         step * (here.speed.curvature / 6.0 +
                                 step * (here.third / 24.0 + step * here.fourth / 120.0))));
}

/// F_L ∫ v_L² dt over the flight, in which v_L falls in proportion to the distance.
template <class Real>
Real load_friction_in_flight(const BasicServoDynamics<Real>& dynamics,
                             const BasicGapFlight<Real>& flight,
                             const BasicUnitHalfCycle<Real>& half) {
  return 0.5 * dynamics.load_friction * half.load_moved * (flight.load_speed + half.load_speed);
}

/// Losses of a whole period for a unit amplitude, in units of K rad².
template <class Real>
struct BasicCycleLosses {
  Real motor_friction;
  Real load_friction;
  Real impacts;
};

/// motor_in_flight is F_M ∫ v_M² dt over the flight. The engaged motion loses what the flight and
/// the impact have added. The shafts share this loss as they share the friction.
template <class Real>
BasicCycleLosses<Real> cycle_losses(const BasicServoDynamics<Real>& dynamics,
                                    const BasicGapFlight<Real>& flight,
                                    const BasicUnitHalfCycle<Real>& half,
                                    const Real& motor_in_flight) {
  const Real engaged = 0.5 * half.square_change;
  const Real load_share =
      dynamics.load_friction / (dynamics.load_friction + dynamics.motor_friction);
  return {2.0 * (motor_in_flight + (1.0 - load_share) * engaged),
          2.0 * (load_friction_in_flight(dynamics, flight, half) + load_share * engaged),
          dynamics.motor_inertia * dynamics.load_inertia * half.gap_speed * half.gap_speed};
}

/// R′ = 1 − |Δu| (J_M y + F_M P)/Q of the balanced half cycle; its square is the multiplier.
template <class Real>
Real half_map_slope(const BasicUnitHalfCycle<Real>& half) {
  return 1.0 - half.gap_displacement * half.log_growth_slope / half.gap_speed;
}

/// F_M ∫ v_M² dt over the flight from the balance of the motor's energy,
///   F_M ∫ v_M² = −½J_M Δ(v_M²) − ∫ y v_M,   ∫ v_L v_M = −(½Δ(y²) + J_M Δ(v_L v_M))/(J_M D + F_M),
/// with, by parts, either y = y∞ − v_L/D, or
///   F_M ∫ y v_M = J_M ∫ v_L v_M − J_M Δ(y v_M) − ∫ y².
/// The first form loses digits as D t → 0, and both as c t → 0.
template <class Real>
struct MotorFrictionBalance {
  Real kinetic_loss;   ///< −½J_M Δ(v_M²)
  Real speed_product;  ///< ∫ v_L v_M
  Real edge;           ///< Δ(y v_M)
  Real motor_moved;

  MotorFrictionBalance(const BasicServoDynamics<Real>& dynamics, const BasicGapFlight<Real>& flight,
                       const BasicUnitHalfCycle<Real>& half)
      : motor_moved(half.load_moved + half.gap_displacement) {
    const Real start_speed = flight.load_speed;
    const Real motor_speed = half.load_speed + half.gap_speed;
    const Real square_change = half.load_moved * (2.0 * flight.load_position + half.load_moved);
    kinetic_loss =
        0.5 * dynamics.motor_inertia * (start_speed * start_speed - motor_speed * motor_speed);
    speed_product =
        -(0.5 * square_change +
          dynamics.motor_inertia * (half.load_speed * motor_speed - start_speed * start_speed)) /
        (dynamics.motor_inertia * dynamics.load_rate + dynamics.motor_friction);
    edge = half.load_position * motor_speed - flight.load_position * start_speed;
  }

  Real of_braked_load(const BasicGapFlight<Real>& flight) const {
    const Real rest = flight.load_position + flight.load_speed / flight.load_rate;
    return kinetic_loss - rest * motor_moved + speed_product / flight.load_rate;
  }

  /// ∫ y² from ∫ (t φ(Dt))² = 2 t³ exp[0, 0, −Dt, −2Dt].
  Real of_coasting_load(const BasicServoDynamics<Real>& dynamics,
                        const BasicGapFlight<Real>& flight, Real time, const BasicDecay<Real>& once,
                        const BasicConvolution<Real>& twice) const {
    const Real position = flight.load_position;
    const Real way = flight.load_speed * time;
    const Real position_square =
        time * (position * position +
                2.0 * way * (position * once.double_integral + way * twice.double_integral));
    return kinetic_loss - (dynamics.motor_inertia * (speed_product - edge) - position_square) /
                              dynamics.motor_friction;
  }
};

}  // namespace gearlash
