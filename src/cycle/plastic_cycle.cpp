#include "gearlash/cycle/plastic_cycle.hpp"

#include <algorithm>
#include <cmath>

#include "gearlash/motion/bracketed_root.hpp"
#include "gearlash/motion/decay_integral.hpp"
#include "gearlash/motion/engaged_flow.hpp"
#include "gearlash/motion/panel_quadrature.hpp"

namespace gearlash {
namespace {

/// F_M ∫ v_M² dt over a unit flight. Where the motor's decay is slight, from the definition, which
/// keeps its relative accuracy as F_M → 0. Else from the balance of the motor's energy,
///   F_M ∫ v_M² = −½J_M Δ(v_M²) − ∫ y v_M, and by parts ∫ v_L v_M = −(½Δ(y²) + J_M Δ(v_L v_M))/
///   (J_M D + F_M), with either y = y∞ − v_L/D (divides by D), or, for a load that coasts,
///   F_M ∫ y v_M = J_M ∫ v_L v_M − J_M Δ(y v_M) − ∫ y².
double motor_friction_in_flight(const ServoDynamics& dynamics, const GapFlight& flight,
                                const UnitHalfCycle& half, double motor_moved) {
  constexpr double slight = 0.1;
  const double time = half.flight_time;
  const double motor_inertia = dynamics.motor_inertia;
  const double motor_speed = half.load_speed + half.gap_speed;
  const double start_speed = flight.load_speed;
  const auto motion = [&](double t) { return motion_in_flight(flight, t); };
  if (dynamics.motor_rate * time <= slight) {
    return dynamics.motor_friction *
           panel_integral(
               [&](double t) { return std::pow(motion(t).load_speed + motion(t).gap_speed, 2); },
               time, flight.load_rate);
  }
  const double kinetic_loss =
      0.5 * motor_inertia * (start_speed * start_speed - motor_speed * motor_speed);
  if (start_speed == 0.0) return kinetic_loss - flight.load_position * motor_moved;
  const double square_change =
      half.load_position * half.load_position - flight.load_position * flight.load_position;
  const double speed_product =
      -(0.5 * square_change +
        motor_inertia * (half.load_speed * motor_speed - start_speed * start_speed)) /
      (motor_inertia * dynamics.load_rate + dynamics.motor_friction);
  if (dynamics.load_rate * time > slight) {
    const double rest = flight.load_position + start_speed / dynamics.load_rate;
    return kinetic_loss - rest * motor_moved + speed_product / dynamics.load_rate;
  }
  // ∫ y², from ∫ (t φ(Dt))² = 2 t³ exp[0, 0, −Dt, −2Dt].
  const Decay once = decay(dynamics.load_rate * time);
  const Convolution twice = convolution(once, decay(2.0 * dynamics.load_rate * time));
  const double position = flight.load_position;
  const double way = start_speed * time;
  const double position_square =
      time * (position * position +
              2.0 * way * (position * once.double_integral + way * twice.double_integral));
  const double edge = half.load_position * motor_speed - flight.load_position * start_speed;
  return kinetic_loss -
         (motor_inertia * (speed_product - edge) - position_square) / dynamics.motor_friction;
}

/// The motor's speed at one time of the flight and its derivatives: v̈ = −c v̇ − a, ȧ = −D a, where
/// a = v_L/J_M (and for a massless motor, whose v_M = −y/F_M, c = 0 and a = −D v_L/F_M).
struct MotorSpeed {
  ValueAndSlope speed;
  double jerk_rate;
};

MotorSpeed motor_speed(const ServoDynamics& dynamics, const GapFlight& flight, double load_speed,
                       double gap_speed, double gap_acceleration) {
  const double drive = dynamics.massless_motor()
                           ? -flight.load_rate * load_speed / dynamics.motor_friction
                           : load_speed / dynamics.motor_inertia;
  const double acceleration = gap_acceleration - flight.load_rate * load_speed;
  const double jerk = -flight.motor_rate * acceleration - drive;
  return {{load_speed + gap_speed, acceleration, jerk},
          flight.load_rate * drive - flight.motor_rate * jerk};
}

/// Root of the quintic through value, slope and curvature at 0 and at `end`, values of opposite
/// sign, to some 1e-4 of `end`: Halley's step from the root of a parabola.
double quintic_root(const ValueAndSlope& at_start, const ValueAndSlope& at_end, double end) {
  const double value = at_start.value;
  const double slope = at_start.slope * end;
  const double square = 0.5 * at_start.curvature * end * end;
  const double rise = at_end.value - value;
  const double parabola_root =
      2.0 * value / (std::sqrt(slope * slope - 4.0 * (rise - slope) * value) - slope);
  const double value_left = rise - slope - square;
  const double slope_left = at_end.slope * end - slope - 2.0 * square;
  const double curvature_left = 0.5 * at_end.curvature * end * end - square;
  const double cubic = 10.0 * value_left - 4.0 * slope_left + curvature_left;
  const double quartic = -15.0 * value_left + 7.0 * slope_left - 2.0 * curvature_left;
  const double quintic = 6.0 * value_left - 3.0 * slope_left + curvature_left;
  const double x = parabola_root;
  const ValueAndSlope at_x = {
      value + x * (slope + x * (square + x * (cubic + x * (quartic + x * quintic)))),
      slope + x * (2.0 * square + x * (3.0 * cubic + x * (4.0 * quartic + x * 5.0 * quintic))),
      2.0 * square + x * (6.0 * cubic + x * (12.0 * quartic + x * 20.0 * quintic))};
  return (x + newton_step(at_x)) * end;
}

/// Where the motor turns within the flight, from the gap's middle line; e^{ct} v_M has the slope
/// −y e^{ct}/J_M and y changes sign at most once, from below, so v_M, positive at the start, has at
/// most one zero. The start's position when it does not turn.
double motor_turning_position(const ServoDynamics& dynamics, const GapFlight& flight,
                              const UnitHalfCycle& half) {
  const MotorSpeed at_start =
      motor_speed(dynamics, flight, flight.load_speed, 0.0, flight.gap_acceleration);
  const MotorSpeed at_end =
      motor_speed(dynamics, flight, half.load_speed, half.gap_speed, half.gap_acceleration);
  if (!(at_end.speed.value < 0.0) || !(at_start.speed.value > 0.0)) return flight.load_position;
  const auto at = [&](const FlightMotion& motion) {
    return motor_speed(dynamics, flight, motion.load_speed, motion.gap_speed,
                       motion.gap_acceleration);
  };
  const double time = half.flight_time;
  // From so near Taylor's series leads to the turn: the position is stationary there, and its next
  // term is below rounding.
  const double tolerance = 0.01 / (1.0 + flight.motor_rate * time);
  double near = quintic_root(at_start.speed, at_end.speed, time);
  if (!(near > 0.0 && near < time)) near = 0.5 * time;
  FlightPoint point = point_in_flight(flight, near);
  if (!(std::abs(newton_step(at(point.motion).speed)) <= tolerance * time)) {
    near = bracketed_root([&](double t) { return at(motion_in_flight(flight, t)).speed; }, 0.0,
                          time, near, -1.0, tolerance);
    point = point_in_flight(flight, near);
  }
  const MotorSpeed here = at(point.motion);
  const double step = newton_step(here.speed);
  return point.motion.load_position + point.gap_displacement +
         step * (here.speed.value +
                 step * (here.speed.slope / 2.0 +
                         step * (here.speed.curvature / 6.0 + step * here.jerk_rate / 24.0)));
}

/// Sizes of both shafts for a unit amplitude; half_gap is b/2 in the same unit. The load turns at
/// the impact or in the engaged motion after it, the motor in the flight or likewise.
struct Sizes {
  double load;
  double motor;
};

Sizes sizes(const ServoDynamics& dynamics, const GapFlight& flight, const UnitHalfCycle& half,
            double half_gap) {
  double turning = half.load_position;
  const double turning_time =
      first_zero(dynamics.damping, half.common_speed,
                 -2.0 * dynamics.damping * half.common_speed - half.load_position);
  // There ẏ = 0, so that Q = y².
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

/// Losses of a whole period for a unit amplitude.
CycleEnergy losses(const ServoDynamics& dynamics, const GapFlight& flight,
                   const UnitHalfCycle& half, double motor_moved) {
  const double load_in_flight = -0.5 * dynamics.load_inertia * flight.load_speed *
                                flight.load_speed *
                                std::expm1(-2.0 * flight.load_rate * half.flight_time);
  const double motor_in_flight = motor_friction_in_flight(dynamics, flight, half, motor_moved);
  // What the engaged motion loses, the flight and the impact have added.
  const double engaged = 0.5 * half.square_change;
  const double load_share =
      dynamics.load_friction / (dynamics.load_friction + dynamics.motor_friction);
  return {
      .motor_friction = 2.0 * (motor_in_flight + (1.0 - load_share) * engaged),
      .load_friction = 2.0 * (load_in_flight + load_share * engaged),
      .impacts = dynamics.motor_inertia * dynamics.load_inertia * half.gap_speed * half.gap_speed};
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
  const Sizes unit_sizes = sizes(dynamics, flight, half, 0.5 * gap);
  const CycleEnergy unit_losses =
      losses(dynamics, flight, half, half.load_position - flight.load_position - gap);
  const double half_map_slope =
      1.0 + gap * half.log_growth_slope / half.gap_speed;  // 1 − |Δu| (J_M y + F_M P)/Q

  LimitCycle cycle;
  cycle.kind = CycleKind::symmetric;
  cycle.multiplier = half_map_slope * half_map_slope;
  cycle.stable = cycle.multiplier < 1.0;
  cycle.size = amplitude * unit_sizes.load;
  cycle.motor_size = amplitude * unit_sizes.motor;
  cycle.engaged_time = 2.0 * half.engaged_time;
  cycle.separated_time = 2.0 * half.flight_time;
  cycle.period = cycle.engaged_time + cycle.separated_time;
  cycle.impact_speed = -amplitude * half.gap_speed;
  cycle.residual = closing_error(dynamics, flight, half);
  cycle.impacts_per_period = 2;
  cycle.settles = true;
  cycle.energy = {square * unit_losses.motor_friction, square * unit_losses.load_friction,
                  square * unit_losses.impacts};
  const double load_position = amplitude * flight.load_position;
  const double load_speed = amplitude * flight.load_speed;
  cycle.start = {load_position + 0.5 * dynamics.backlash, load_speed, load_position, load_speed};
  return cycle;
}

}  // namespace gearlash
