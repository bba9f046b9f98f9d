#include "closed_form/gap_flight.hpp"

#include <cmath>

namespace gearlash {
namespace {

/// A massless load stands still in the gap: u̇ = v_M, v̇_M = −c v_M − y (J_M = 1).
GapFlight over_massless_load(const ServoDynamics& dynamics, double load_position, double gap,
                             double motor_speed) {
  const double acceleration = -dynamics.motor_rate * motor_speed - load_position;
  return {.load_position = load_position,
          .gap = gap,
          .gap_speed = motor_speed,
          .motor_acceleration = acceleration,
          .motor_rate = dynamics.motor_rate,
          .gap_acceleration = acceleration};
}

/// A massless motor runs at v_M = −y/F_M: u̇ = −y/F_M − v, ü = (D − 1/F_M) v₀ e^{−Dt} (J_L = 1).
GapFlight massless_motor_flight(const ServoDynamics& dynamics, const GapState& state,
                                double gap_speed) {
  const double acceleration =
      (dynamics.load_rate - 1.0 / dynamics.motor_friction) * state.load_speed;
  return {.load_position = state.load_position,
          .load_speed = state.load_speed,
          .gap = state.gap,
          .gap_speed = gap_speed,
          .load_deceleration = acceleration,
          .load_rate = dynamics.load_rate,
          .gap_acceleration = acceleration};
}

}  // namespace

BasicFlightDecays<double> decays_at(const GapFlight& flight, double time) {
  const Decay load = decay(flight.load_rate * time);
  const Decay motor = decay(flight.motor_rate * time);
  return {load, motor, convolution(load, motor)};
}

FlightMotion motion_in_flight(const GapFlight& flight, double time) {
  return motion_after(flight, time, decays_at(flight, time));
}

FlightPoint point_in_flight(const GapFlight& flight, double time) {
  const BasicFlightDecays<double> decays = decays_at(flight, time);
  return {motion_after(flight, time, decays), displacement_after(flight, time, decays)};
}

GapFlight flight_from(const ServoDynamics& dynamics, const GapState& state) {
  const double motor_speed = state.load_speed + state.gap_speed;
  if (dynamics.massless_load()) {
    return over_massless_load(dynamics, state.load_position, state.gap, motor_speed);
  }
  if (dynamics.massless_motor()) {
    const double driven_speed = -state.load_position / dynamics.motor_friction;
    return massless_motor_flight(dynamics, state, driven_speed - state.load_speed);
  }
  return flight_of_two_masses(dynamics, state);
}

GapFlight flight_from_separation(const ServoDynamics& dynamics, double load_position,
                                 double load_speed, double gap) {
  const TorqueFreeLine line = dynamics.torque_free_line;
  const double amplitude = load_position * line.position + load_speed * line.speed;
  const GapState state{amplitude * line.position, amplitude * line.speed, gap, 0.0};
  if (dynamics.massless_load()) {
    return over_massless_load(dynamics, state.load_position, gap, 0.0);
  }
  if (dynamics.massless_motor()) return massless_motor_flight(dynamics, state, 0.0);
  return clean_parting(dynamics, state.load_position, state.load_speed, gap);
}

GapFlight flight_from_pull(const ServoDynamics& dynamics, double load_position, double load_speed,
                           double gap) {
  const GapState state{load_position, load_speed, gap, 0.0};
  if (dynamics.massless_load() || dynamics.massless_motor()) return flight_from(dynamics, state);
  const double torque = mesh_torque(dynamics, load_position, load_speed);
  GapFlight flight = flight_of_two_masses(dynamics, state);
  flight.gap_acceleration = torque / (dynamics.motor_inertia * dynamics.load_inertia);
  return flight;
}

}  // namespace gearlash
