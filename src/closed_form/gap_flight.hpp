// The closed form of a flight: the load coasts, the motor runs under the loop.
#pragma once

#include "closed_form/decay_integral.hpp"
#include "closed_form/servo_dynamics.hpp"

namespace gearlash {

/// Motion across the gap from time 0. With D = F_L/J_L, c = F_M/J_M:
///   load   y(t) = y₀ + v₀ t φ(Dt),  v(t) = v₀ e^{−Dt},           φ = decay_integral
///   gap    u(t) = u₀ + u̇₀ t + A t² exp[0,0,−ct] + B t² exp[0,0,−Dt] + C t³ exp[0,0,−Dt,−ct]
///   with   A = v̇_M(0) = −c v_M − y₀/J_M,  B = −v̇_L(0) = D v₀,  C = −v₀/J_M.
/// (From v̈_M + c v̇_M = −v_L/J_M and v̇_L = −D v_L.) u has its own coordinates instead of a
/// difference of two shafts, so it keeps its relative accuracy however short the flight. A massless
/// load stands still (B = C = 0). For a massless motor v_M = −y/F_M leaves B = (D − 1/F_M) v₀
/// alone. After a clean parting u̇₀ = ü₀ = 0 leaves C = G alone.
template <class Real>
struct BasicGapFlight {
  Real load_position = 0.0;       ///< y₀, from the reference
  Real load_speed = 0.0;          ///< v₀
  Real gap = 0.0;                 ///< u₀
  Real gap_speed = 0.0;           ///< u̇₀
  Real motor_acceleration = 0.0;  ///< A
  Real load_deceleration = 0.0;   ///< B
  Real coupling = 0.0;            ///< C
  Real load_rate = 0.0;           ///< D; 0 for a massless load
  Real motor_rate = 0.0;          ///< c; 0 for a massless motor
  Real gap_acceleration = 0.0;    ///< ü₀ = A + B; after a parting more exact than that sum
  Real gap_drive = 0.0;  ///< G = −v₀(D² − 2ζD + 1)/J_M = (c − D) B + C, likewise:
                         ///< ü e^{ct} = ü₀ + G t φ₁((c − D)t)
};
using GapFlight = BasicGapFlight<double>;

/// A flight at one time, without the gap's displacement, which costs a second integral.
template <class Real>
struct BasicFlightMotion {
  Real load_moved;        ///< y − y₀
  Real load_position;     ///< y
  Real load_speed;        ///< v_L
  Real gap_speed;         ///< u̇ = v_M − v_L
  Real gap_acceleration;  ///< ü
};
using FlightMotion = BasicFlightMotion<double>;

/// A flight at one time, complete.
template <class Real>
struct BasicFlightPoint {
  BasicFlightMotion<Real> motion;
  Real gap_displacement;  ///< u − u₀
};
using FlightPoint = BasicFlightPoint<double>;

/// The decays that make up every quantity of a flight, at one time.
template <class Real>
struct BasicFlightDecays {
  BasicDecay<Real> load;
  BasicDecay<Real> motor;
  BasicConvolution<Real> coupled;
};

template <class Real>
BasicFlightMotion<Real> motion_after(const BasicGapFlight<Real>& flight, Real time,
                                     const BasicFlightDecays<Real>& decays) {
  const Real load_moved = flight.load_speed * time * decays.load.integral;
  const Real coupling = flight.coupling * time;
  return {
      .load_moved = load_moved,
      .load_position = flight.load_position + load_moved,
      .load_speed = flight.load_speed * decays.load.factor,
      .gap_speed = flight.gap_speed + time * (flight.motor_acceleration * decays.motor.integral +
                                              flight.load_deceleration * decays.load.integral +
                                              coupling * decays.coupled.integral),
      .gap_acceleration = flight.motor_acceleration * decays.motor.factor +
                          flight.load_deceleration * decays.load.factor +
                          coupling * decays.coupled.value};
}

/// G = −v (D² − 2ζD + 1)/J_M, with the square completed: the sum is of one sign for ζ ≤ 1.
template <class Real>
Real gap_drive(const BasicServoDynamics<Real>& dynamics, Real load_speed) {
  const Real offset = dynamics.load_rate - dynamics.damping;
  const Real quadratic = offset * offset + (1.0 - dynamics.damping) * (1.0 + dynamics.damping);
  return -load_speed * quadratic / dynamics.motor_inertia;
}

/// u − u₀.
template <class Real>
Real displacement_after(const BasicGapFlight<Real>& flight, Real time,
                        const BasicFlightDecays<Real>& decays) {
  return time *
         (flight.gap_speed + time * (flight.motor_acceleration * decays.motor.double_integral +
                                     flight.load_deceleration * decays.load.double_integral +
                                     flight.coupling * time * decays.coupled.double_integral));
}

BasicFlightDecays<double> decays_at(const GapFlight& flight, double time);
FlightMotion motion_in_flight(const GapFlight& flight, double time);
FlightPoint point_in_flight(const GapFlight& flight, double time);

/// The shafts just after parting (or as given): positions and speeds about the reference.
template <class Real>
struct BasicGapState {
  Real load_position;
  Real load_speed;
  Real gap;
  Real gap_speed;
};
using GapState = BasicGapState<double>;

template <class Real>
BasicGapState<Real> state_after(const BasicGapFlight<Real>& flight, const Real& time,
                                const BasicFlightDecays<Real>& decays) {
  const BasicFlightMotion<Real> motion = motion_after(flight, time, decays);
  return {motion.load_position, motion.load_speed,
          flight.gap + displacement_after(flight, time, decays), motion.gap_speed};
}

/// Flight of two masses from any state in the gap. The shafts' own accelerations do not come from
/// the gap's, which would lose digits for a light load.
template <class Real>
BasicGapFlight<Real> flight_of_two_masses(const BasicServoDynamics<Real>& dynamics,
                                          const BasicGapState<Real>& state) {
  const Real motor_acceleration = -dynamics.motor_rate * (state.load_speed + state.gap_speed) -
                                  state.load_position / dynamics.motor_inertia;
  const Real load_deceleration = dynamics.load_rate * state.load_speed;
  return {.load_position = state.load_position,
          .load_speed = state.load_speed,
          .gap = state.gap,
          .gap_speed = state.gap_speed,
          .motor_acceleration = motor_acceleration,
          .load_deceleration = load_deceleration,
          .coupling = -state.load_speed / dynamics.motor_inertia,
          .load_rate = dynamics.load_rate,
          .motor_rate = dynamics.motor_rate,
          .gap_acceleration = motor_acceleration + load_deceleration,
          .gap_drive = gap_drive(dynamics, state.load_speed)};
}

/// Flight from any state in the gap. A massless load stops at once (its speed is ignored). A
/// massless motor takes the loop's speed −y/F_M at once.
GapFlight flight_from(const ServoDynamics& dynamics, const GapState& state);

/// Flight from the instant when the mesh torque of engaged faces reaches zero: there u̇ = ü = 0
/// exactly, and (y, v) lies on the line of zero mesh torque, onto which it is projected.
GapFlight flight_from_separation(const ServoDynamics& dynamics, double load_position,
                                 double load_speed, double gap);

/// Flight of two masses from a state on the torque-free line, where u̇ = ü = 0: the terms of first
/// and second order in time cancel exactly.
template <class Real>
BasicGapFlight<Real> clean_parting(const BasicServoDynamics<Real>& dynamics, Real load_position,
                                   Real load_speed, Real gap) {
  const Real drive = gap_drive(dynamics, load_speed);
  return {.load_position = load_position,
          .load_speed = load_speed,
          .gap = gap,
          .coupling = drive,
          .load_rate = dynamics.load_rate,
          .motor_rate = dynamics.motor_rate,
          .gap_drive = drive};
}

/// Flight from faces that touch with no relative speed, where the mesh torque would have to pull:
/// u̇ = 0, ü = N/(J_M J_L).
GapFlight flight_from_pull(const ServoDynamics& dynamics, double load_position, double load_speed,
                           double gap);

}  // namespace gearlash
