#include "closed_form/plastic_cycle.hpp"

#include <algorithm>
#include <cmath>

#include "base/bracketed_root.hpp"
#include "closed_form/contact_law.hpp"
#include "closed_form/decay_integral.hpp"
#include "closed_form/engaged_flow.hpp"
#include "numeric/panel_quadrature.hpp"

namespace gearlash {
namespace {

/// F_M ∫ v_M² dt over a unit flight. If the motor's decay is slight, it is computed from the
/// definition, which keeps its relative accuracy as F_M → 0, otherwise from the balance of the
/// motor's energy.
double motor_friction_in_flight(const ServoDynamics& dynamics, const GapFlight& flight,
                                const UnitHalfCycle& half) {
  constexpr double slight = 0.1;
  const double time = half.flight_time;
  if (dynamics.motor_rate * time <= slight) {
    return dynamics.motor_friction * panel_integral(
                                         [&](double t) {
                                           const FlightMotion at = motion_in_flight(flight, t);
                                           return std::pow(at.load_speed + at.gap_speed, 2);
                                         },
                                         time, flight.load_rate);
  }
  const MotorFrictionBalance<double> balance(dynamics, flight, half);
  if (flight.load_speed == 0.0) {
    return balance.kinetic_loss - flight.load_position * balance.motor_moved;
  }
  if (dynamics.load_rate * time > slight) return balance.of_braked_load(flight);
  const Decay once = decay(dynamics.load_rate * time);
  return balance.of_coasting_load(dynamics, flight, time, once,
                                  convolution(once, decay(2.0 * dynamics.load_rate * time)));
}

/// Position at which the motor turns within the flight, from the gap's middle line; the start's
/// position if it does not turn. e^{ct} v_M has the slope −y e^{ct}/J_M, and y changes its sign at
/// most once, from below. So v_M, positive at the start, has at most one zero.
double motor_turning_position(const ServoDynamics& dynamics, const GapFlight& flight,
                              const UnitHalfCycle& half) {
  const double motor_drive = dynamics.massless_motor() ? -flight.load_rate / dynamics.motor_friction
                                                       : 1.0 / dynamics.motor_inertia;
  const auto at_start =
      motor_speed_at(flight, motor_drive, flight.load_speed, 0.0, flight.gap_acceleration);
  const auto at_end =
      motor_speed_at(flight, motor_drive, half.load_speed, half.gap_speed, half.gap_acceleration);
  if (!(at_end.speed.value < 0.0) || !(at_start.speed.value > 0.0)) return flight.load_position;
  const auto at = [&](const FlightMotion& motion) {
    return motor_speed_at(flight, motor_drive, motion.load_speed, motion.gap_speed,
                          motion.gap_acceleration);
  };
  const double time = half.flight_time;
  const double tolerance = nearness_of_turn(flight, time);
  double near = quintic_root(at_start.speed, at_end.speed, time);
  if (!(near > 0.0 && near < time)) near = 0.5 * time;
  FlightPoint point = point_in_flight(flight, near);
  const ValueAndSlope guess = at(point.motion).speed;
  if (!(guess.slope < 0.0 && is_near_zero(guess, tolerance * time))) {
    near = bracketed_root([&](double t) { return at(motion_in_flight(flight, t)).speed; }, 0.0,
                          time, near, -1.0, tolerance);
    point = point_in_flight(flight, near);
  }
  return position_at_turn(point, at(point.motion));
}

/// Amplitudes of both shafts for a unit amplitude σ at parting; half_gap is b/2 in that unit. The
/// load turns at the impact or in the engaged motion after it. The motor turns there or in the
/// flight.
struct Amplitudes {
  double load;
  double motor;
};

Amplitudes amplitudes_of(const ServoDynamics& dynamics, const GapFlight& flight,
                         const UnitHalfCycle& half, double half_gap) {
  double turning = half.load_position;
  const double turning_time =
      first_zero(dynamics.damping, half.common_speed,
                 -2.0 * dynamics.damping * half.common_speed - half.load_position);
  // At the turning point ẏ = 0, so Q = y².
  if (turning_time < half.engaged_time) {
    turning = std::copysign(std::sqrt(half.form) * std::exp(-dynamics.damping * turning_time),
                            half.common_speed);
  }
  const double start = flight.load_position;
  const double motor_turning = motor_turning_position(dynamics, flight, half);
  return {
      .load = std::max({std::abs(start), std::abs(half.load_position), std::abs(turning)}),
      .motor = std::max({std::abs(start + half_gap), std::abs(motor_turning + half_gap),
                         std::abs(half.load_position - half_gap), std::abs(turning - half_gap)})};
}

/// Mismatch, relative to the state, after the half cycle is run through the engaged flow.
double closing_error(const ServoDynamics& dynamics, const GapFlight& flight,
                     const UnitHalfCycle& half) {
  const EngagedFlow engaged{dynamics.damping, half.load_position, half.common_speed};
  const EngagedFlow::State end = engaged.at(half.engaged_time);
  const double scale = std::max(std::abs(flight.load_position), std::abs(flight.load_speed));
  return std::max(std::abs(end.position + flight.load_position),
                  std::abs(end.speed + flight.load_speed)) /
         scale;
}

}  // namespace

LimitCycle plastic_cycle(const ServoDynamics& dynamics, const UnitHalfCycle& half) {
  const GapFlight flight = unit_flight(dynamics);
  const double gap = -half.gap_displacement;
  const double amplitude = dynamics.backlash / gap;
  const double square = amplitude * amplitude;
  const Amplitudes unit_amplitudes = amplitudes_of(dynamics, flight, half, 0.5 * gap);
  const BasicCycleLosses<double> losses =
      cycle_losses(dynamics, flight, half, motor_friction_in_flight(dynamics, flight, half));
  const double slope = half_map_slope(half);

  LimitCycle cycle;
  cycle.kind = CycleKind::symmetric;
  cycle.multiplier = slope * slope;
  cycle.stable = cycle.multiplier < 1.0;
  cycle.amplitude = amplitude * unit_amplitudes.load;
  cycle.motor_amplitude = amplitude * unit_amplitudes.motor;
  cycle.engaged_time = 2.0 * half.engaged_time;
  cycle.separated_time = 2.0 * half.flight_time;
  cycle.period = cycle.engaged_time + cycle.separated_time;
  cycle.impact_speed = -amplitude * half.gap_speed;
  cycle.mesh_torque = amplitude * largest_mesh_torque(dynamics, half.load_position,
                                                      half.common_speed, half.engaged_time);
  cycle.residual = closing_error(dynamics, flight, half);
  cycle.impacts_per_period = 2;
  cycle.settles = true;
  cycle.energy = {square * losses.motor_friction, square * losses.load_friction,
                  square * losses.impacts};
  const double load_position = amplitude * flight.load_position;
  const double load_speed = amplitude * flight.load_speed;
  cycle.start = {load_position + 0.5 * dynamics.backlash, load_speed, load_position, load_speed};
  return cycle;
}

}  // namespace gearlash
