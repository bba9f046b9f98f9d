#include "gearlash/motion/gap_flight.hpp"

#include <cmath>

#include "gearlash/motion/decay_integral.hpp"

namespace gearlash {
namespace {

/// G = −v (D² − 2ζD + 1)/J_M, with the square completed: the sum is of one sign for ζ ≤ 1.
double gap_drive(const ServoDynamics& dynamics, double load_speed) {
  const double offset = dynamics.load_rate - dynamics.damping;
  const double quadratic =
      offset * offset + (1.0 - dynamics.damping) * (1.0 + dynamics.damping);
  return -load_speed * quadratic / dynamics.motor_inertia;
}

/// A massless load stands still in the gap: u̇ = v_M, v̇_M = −c v_M − y (J_M = 1).
GapFlight over_massless_load(const ServoDynamics& dynamics, double load_position, double gap,
                             double motor_speed) {
  return {.load_position = load_position,
          .load_speed = 0.0,
          .gap = gap,
          .gap_speed = motor_speed,
          .gap_acceleration = -dynamics.motor_rate * motor_speed - load_position,
          .gap_drive = 0.0,
          .load_rate = 0.0,
          .motor_rate = dynamics.motor_rate};
}

/// A massless motor runs at v_M = −y/F_M: u̇ = −y/F_M − v, ü = (D − 1/F_M) v₀ e^{−Dt} (J_L = 1).
GapFlight of_massless_motor(const ServoDynamics& dynamics, const GapState& state,
                            double gap_speed) {
  return {.load_position = state.load_position,
          .load_speed = state.load_speed,
          .gap = state.gap,
          .gap_speed = gap_speed,
          .gap_acceleration =
              (dynamics.load_rate - 1.0 / dynamics.motor_friction) * state.load_speed,
          .gap_drive = 0.0,
          .load_rate = dynamics.load_rate,
          .motor_rate = dynamics.load_rate};
}

GapFlight of_two_masses(const ServoDynamics& dynamics, const GapState& state,
                        double gap_acceleration) {
  return {.load_position = state.load_position,
          .load_speed = state.load_speed,
          .gap = state.gap,
          .gap_speed = state.gap_speed,
          .gap_acceleration = gap_acceleration,
          .gap_drive = gap_drive(dynamics, state.load_speed),
          .load_rate = dynamics.load_rate,
          .motor_rate = dynamics.motor_rate};
}

}  // namespace

FlightMotion motion_in_flight(const GapFlight& flight, double time) {
  const Decay load = decay(flight.load_rate * time);
  const Decay motor = decay(flight.motor_rate * time);
  const double load_moved = flight.load_speed * time * load.integral();
  FlightMotion motion{
      .load_moved = load_moved,
      .load_position = flight.load_position + load_moved,
      .load_speed = flight.load_speed * load.factor,
      .gap_speed = flight.gap_speed + flight.gap_acceleration * time * motor.integral(),
      .gap_acceleration = flight.gap_acceleration * motor.factor};
  if (flight.gap_drive != 0.0) {
    const double drive = flight.gap_drive * time;
    motion.gap_speed += drive * time * convolution_integral(load, motor);
    motion.gap_acceleration += drive * decay_convolution(load, motor);
  }
  return motion;
}

double gap_displacement_at(const GapFlight& flight, double time) {
  const double motor_decay = flight.motor_rate * time;
  double displacement = flight.gap_speed * time;
  if (flight.gap_acceleration != 0.0) {
    displacement +=
        flight.gap_acceleration * time * time * decay_double_integral(motor_decay);
  }
  if (flight.gap_drive != 0.0) {
    displacement += flight.gap_drive * time * time * time *
                    convolution_double_integral(flight.load_rate * time, motor_decay);
  }
  return displacement;
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
  const double gap_acceleration = -dynamics.motor_rate * motor_speed -
                                  state.load_position / dynamics.motor_inertia +
                                  dynamics.load_rate * state.load_speed;
  return of_two_masses(dynamics, state, gap_acceleration);
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
  return of_two_masses(dynamics, state, 0.0);
}

GapFlight flight_from_pull(const ServoDynamics& dynamics, double load_position, double load_speed,
                           double gap) {
  const GapState state{load_position, load_speed, gap, 0.0};
  if (dynamics.massless_load() || dynamics.massless_motor()) return flight_from(dynamics, state);
  const double torque = mesh_torque(dynamics, load_position, load_speed);
  return of_two_masses(dynamics, state,
                       torque / (dynamics.motor_inertia * dynamics.load_inertia));
}

}  // namespace gearlash
