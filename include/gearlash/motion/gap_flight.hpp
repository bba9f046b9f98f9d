// Faces apart: the load coasts, the motor runs under the loop; closed form of both.
#pragma once

#include "gearlash/motion/servo_dynamics.hpp"

namespace gearlash {

/// Motion across the gap from time 0. With D = F_L/J_L, c = F_M/J_M:
///   load   y(t) = y₀ + v₀ t φ(Dt),  v(t) = v₀ e^{−Dt},           φ = decay_integral
///   gap    u(t) = u₀ + u̇₀ t + A t² exp[0,0,−ct] + B t² exp[0,0,−Dt] + C t³ exp[0,0,−Dt,−ct]
///   with   A = v̇_M(0) = −c v_M − y₀/J_M,  B = −v̇_L(0) = D v₀,  C = −v₀/J_M.
/// (From v̈_M + c v̇_M = −v_L/J_M and v̇_L = −D v_L.) u is written in its own coordinates, not as a
/// difference of two shafts, so that it keeps its relative accuracy however short the flight. A
/// massless load stands still (B = C = 0); for a massless motor v_M = −y/F_M leaves
/// B = (D − 1/F_M) v₀ alone; after a clean parting u̇₀ = ü₀ = 0 leaves C = G alone.
struct GapFlight {
  double load_position = 0.0;       ///< y₀, from the reference
  double load_speed = 0.0;          ///< v₀
  double gap = 0.0;                 ///< u₀
  double gap_speed = 0.0;           ///< u̇₀
  double motor_acceleration = 0.0;  ///< A
  double load_deceleration = 0.0;   ///< B
  double coupling = 0.0;            ///< C
  double load_rate = 0.0;           ///< D; 0 for a massless load
  double motor_rate = 0.0;          ///< c; 0 for a massless motor
  double gap_acceleration = 0.0;    ///< ü₀ = A + B, known more exactly than that sum
  double gap_drive = 0.0;  ///< G = −v₀(D² − 2ζD + 1)/J_M = (c − D) B + C, likewise:
                           ///< ü e^{ct} = ü₀ + G t φ₁((c − D)t)
};

/// A flight at one time, but for the gap's displacement, which costs a second integral.
struct FlightMotion {
  double load_moved;        ///< y − y₀
  double load_position;     ///< y
  double load_speed;        ///< v_L
  double gap_speed;         ///< u̇ = v_M − v_L
  double gap_acceleration;  ///< ü
};

/// A flight at one time, whole.
struct FlightPoint {
  FlightMotion motion;
  double gap_displacement;  ///< u − u₀
};

FlightMotion motion_in_flight(const GapFlight& flight, double time);
FlightPoint point_in_flight(const GapFlight& flight, double time);

/// The shafts just after parting (or as given): positions and speeds about the reference.
struct GapState {
  double load_position;
  double load_speed;
  double gap;
  double gap_speed;
};

/// Flight from any state in the gap. A massless load stops at once (its speed is ignored), a
/// massless motor takes at once the speed −y/F_M that the loop drives it at.
GapFlight flight_from(const ServoDynamics& dynamics, const GapState& state);

/// Flight from the instant when the mesh torque of engaged faces reaches zero: there u̇ = ü = 0
/// exactly, and (y, v) lies on the line of zero mesh torque, onto which it is projected.
GapFlight flight_from_separation(const ServoDynamics& dynamics, double load_position,
                                 double load_speed, double gap);

/// Flight from faces that touch with no relative speed but with a mesh torque that would have to
/// pull: u̇ = 0, ü = N/(J_M J_L).
GapFlight flight_from_pull(const ServoDynamics& dynamics, double load_position, double load_speed,
                           double gap);

}  // namespace gearlash
