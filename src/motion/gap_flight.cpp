#include "gearlash/motion/gap_flight.hpp"

#include <cmath>

#include "gearlash/motion/decay_integral.hpp"

namespace gearlash {
namespace {

/// G = −v (D² − 2ζD + 1)/J_M, with the square completed: the sum is of one sign for ζ ≤ 1.
double gap_drive(const ServoDynamics& dynamics, double load_speed) {
  const double offset = dynamics.load_rate - dynamics.damping;
  const double quadratic = offset * offset + (1.0 - dynamics.damping) * (1.0 + dynamics.damping);
  return -load_speed * quadratic / dynamics.motor_inertia;
}

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
GapFlight of_massless_motor(const ServoDynamics& dynamics, const GapState& state,
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

double motor_acceleration(const ServoDynamics& dynamics, const GapState& state) {
  return -dynamics.motor_rate * (state.load_speed + state.gap_speed) -
         state.load_position / dynamics.motor_inertia;
}

/// Two masses. The shafts' own accelerations are not taken from the gap's: of a light load that
/// would lose digits.
GapFlight of_two_masses(const ServoDynamics& dynamics, const GapState& state,
                        double gap_acceleration) {
  return {.load_position = state.load_position,
          .load_speed = state.load_speed,
          .gap = state.gap,
          .gap_speed = state.gap_speed,
          .motor_acceleration = motor_acceleration(dynamics, state),
          .load_deceleration = dynamics.load_rate * state.load_speed,
          .coupling = -state.load_speed / dynamics.motor_inertia,
          .load_rate = dynamics.load_rate,
          .motor_rate = dynamics.motor_rate,
          .gap_acceleration = gap_acceleration,
          .gap_drive = gap_drive(dynamics, state.load_speed)};
}

/// Two masses that part cleanly: the terms of first and second order in time cancel exactly.
GapFlight of_clean_parting(const ServoDynamics& dynamics, const GapState& state) {
  const double drive = gap_drive(dynamics, state.load_speed);
  return {.load_position = state.load_position,
          .load_speed = state.load_speed,
          .gap = state.gap,
          .coupling = drive,
          .load_rate = dynamics.load_rate,
          .motor_rate = dynamics.motor_rate,
          .gap_drive = drive};
}

/// The decays that every quantity of a flight is made of, at one time.
struct Decays {
  Decay load;
  Decay motor;
  Convolution coupled;

  Decays(const GapFlight& flight, double time)
      : load(decay(flight.load_rate * time)),
        motor(decay(flight.motor_rate * time)),
        coupled(convolution(load, motor)) {}
};

FlightMotion motion_after(const GapFlight& flight, double time, const Decays& decays) {
  const double load_moved = flight.load_speed * time * decays.load.integral;
  const double coupling = flight.coupling * time;
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

double displacement_after(const GapFlight& flight, double time, const Decays& decays) {
  return time *
         (flight.gap_speed + time * (flight.motor_acceleration * decays.motor.double_integral +
                                     flight.load_deceleration * decays.load.double_integral +
                                     flight.coupling * time * decays.coupled.double_integral));
}

}  // namespace

FlightMotion motion_in_flight(const GapFlight& flight, double time) {
  return motion_after(flight, time, Decays(flight, time));
}

FlightPoint point_in_flight(const GapFlight& flight, double time) {
  const Decays decays(flight, time);
  return {motion_after(flight, time, decays), displacement_after(flight, time, decays)};
}

GapFlight flight_from(const ServoDynamics& dynamics, const GapState& state) {
  const double motor_speed = state.load_speed + state.gap_speed;
  if (dynamics.massless_load()) {
    return over_massless_load(dynamics, state.load_position, state.gap, motor_speed);
  }
  if (dynamics.massless_motor()) {
    const double driven_speed = -state.load_position / dynamics.motor_friction;
    return of_massless_motor(dynamics, state, driven_speed - state.load_speed);
  }
  return of_two_masses(dynamics, state,
                       motor_acceleration(dynamics, state) + dynamics.load_rate * state.load_speed);
}

GapFlight flight_from_separation(const ServoDynamics& dynamics, double load_position,
                                 double load_speed, double gap) {
  const TorqueFreeLine line = dynamics.torque_free_line;
  const double amplitude = load_position * line.position + load_speed * line.speed;
  const GapState state{amplitude * line.position, amplitude * line.speed, gap, 0.0};
  if (dynamics.massless_load()) {
    return over_massless_load(dynamics, state.load_position, gap, 0.0);
  }
  if (dynamics.massless_motor()) return of_massless_motor(dynamics, state, 0.0);
  return of_clean_parting(dynamics, state);
}

GapFlight flight_from_pull(const ServoDynamics& dynamics, double load_position, double load_speed,
                           double gap) {
  const GapState state{load_position, load_speed, gap, 0.0};
  if (dynamics.massless_load() || dynamics.massless_motor()) return flight_from(dynamics, state);
  const double torque = mesh_torque(dynamics, load_position, load_speed);
  return of_two_masses(dynamics, state, torque / (dynamics.motor_inertia * dynamics.load_inertia));
}

}  // namespace gearlash
