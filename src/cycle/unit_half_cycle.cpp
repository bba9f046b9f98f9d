#include "gearlash/cycle/unit_half_cycle.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "gearlash/motion/bracketed_root.hpp"
#include "gearlash/motion/engaged_flow.hpp"

namespace gearlash {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

UnitHalfCycle half_cycle(const ServoDynamics& dynamics, const GapFlight& flight, double time) {
  const FlightPoint point = point_in_flight(flight, time);
  const FlightMotion& motion = point.motion;
  UnitHalfCycle half;
  half.flight_time = time;
  half.gap_displacement = point.gap_displacement;
  half.load_position = motion.load_position;
  half.load_speed = motion.load_speed;
  half.gap_speed = motion.gap_speed;
  half.gap_acceleration = motion.gap_acceleration;
  half.common_speed = motion.load_speed + dynamics.motor_inertia * motion.gap_speed;

  const double start_form =
      decaying_form(dynamics.damping, flight.load_position, flight.load_speed);
  // Q(impact) − Q(start) from the differences of position and speed: for light damping it is far
  // smaller than either.
  const double moved = motion.load_moved;
  const double speeded = -flight.load_rate * moved + dynamics.motor_inertia * motion.gap_speed;
  half.square_change =
      moved * (2.0 * flight.load_position + moved) + speeded * (2.0 * flight.load_speed + speeded);
  const double change = half.square_change + 2.0 * dynamics.damping *
                                                 (flight.load_position * speeded +
                                                  moved * flight.load_speed + moved * speeded);
  half.form = start_form + change;
  half.engaged_time =
      first_zero(dynamics.damping, mesh_torque(dynamics, half.load_position, half.common_speed),
                 mesh_torque_rate(dynamics, half.load_position, half.common_speed));
  half.log_growth = std::isinf(half.engaged_time) ? -infinity
                                                  : 0.5 * std::log1p(change / start_form) -
                                                        dynamics.damping * half.engaged_time;
  half.log_growth_slope =
      -half.gap_speed *
      (dynamics.motor_inertia * half.load_position + dynamics.motor_friction * half.common_speed) /
      half.form;
  return half;
}

/// How the state just after the impact changes with the flight time.
struct ArrivalRates {
  double momentum;  ///< Ṗ
  double form;      ///< Q̇
};

ArrivalRates arrival_rates(const ServoDynamics& dynamics, const UnitHalfCycle& half) {
  const double motor_speed = half.load_speed + half.gap_speed;
  const double momentum = -dynamics.motor_friction * motor_speed -
                          dynamics.load_friction * half.load_speed - half.load_position;
  const double form =
      2.0 *
      (half.load_position * half.load_speed + half.common_speed * momentum +
       dynamics.damping * (half.load_speed * half.common_speed + half.load_position * momentum));
  return {momentum, form};
}

/// d² ln ρ/dt², from the product that makes its slope: with S = J_M y + F_M P,
///   (ln ρ)″/(ln ρ)′ = ü/u̇ + Ṡ/S − Q̇/Q.
double log_growth_curvature(const ServoDynamics& dynamics, const UnitHalfCycle& half) {
  const ArrivalRates rates = arrival_rates(dynamics, half);
  const double drive =
      dynamics.motor_inertia * half.load_position + dynamics.motor_friction * half.common_speed;
  const double drive_rate =
      dynamics.motor_inertia * half.load_speed + dynamics.motor_friction * rates.momentum;
  return half.log_growth_slope *
         (half.gap_acceleration / half.gap_speed + drive_rate / drive - rates.form / half.form);
}

/// The last step of Newton's method, so short that all changes by its rate times the step.
UnitHalfCycle stepped(const ServoDynamics& dynamics, const GapFlight& flight,
                      const UnitHalfCycle& half, double step) {
  const ArrivalRates rates = arrival_rates(dynamics, half);
  const double engaged_time_rate =
      (0.5 * rates.form / half.form - half.log_growth_slope) / dynamics.damping;
  UnitHalfCycle next = half;
  next.flight_time += step;
  next.engaged_time += step * engaged_time_rate;
  next.load_position += step * half.load_speed;
  next.load_speed -= step * flight.load_rate * half.load_speed;
  next.gap_displacement += step * half.gap_speed;
  next.gap_speed += step * half.gap_acceleration;
  next.common_speed += step * rates.momentum;
  next.square_change +=
      step * 2.0 * (half.load_position * half.load_speed + half.common_speed * rates.momentum);
  next.form += step * rates.form;
  next.log_growth += step * half.log_growth_slope;
  next.log_growth_slope += step * log_growth_curvature(dynamics, half);
  return next;
}

constexpr double time_tolerance = 1e-9;  // its square is below rounding

/// The root of ln ρ(t) = 0 where growth at rest > 1, to time_tolerance.
double balanced_flight_time(const ServoDynamics& dynamics, const GapFlight& flight,
                            double growth_at_rest) {
  // Near t = 0, ln ρ = −ζπ/w + κ t³/6 + t⁴/8, κ = c J_L + D J_M being the drag on the gap's motion;
  // in the end it tends to ln μ₀. The guess joins the two and adds what drag does beyond that, by a
  // coefficient that fits; it is within some 10 % as a rule.
  constexpr double fastest_rate = 1e3;
  constexpr double least_frequency_squared = 0.05;
  const double drag = std::min(dynamics.motor_rate, fastest_rate) * dynamics.load_inertia +
                      std::min(dynamics.load_rate, fastest_rate) * dynamics.motor_inertia;
  const double deficit =
      std::numbers::pi * dynamics.damping /
      std::sqrt(std::max(least_frequency_squared, 1.0 - dynamics.damping * dynamics.damping));
  double early = std::sqrt(std::sqrt(8.0 * deficit));
  if (drag * early * early * early > 6.0 * deficit) early = std::cbrt(6.0 * deficit / drag);
  constexpr double further_drag = 0.07;
  const double guess = early * std::sqrt(1.0 + deficit / std::log(growth_at_rest)) *
                       (1.0 + further_drag * drag * early);
  const auto log_growth = [&](double time) {
    const UnitHalfCycle half = half_cycle(dynamics, flight, time);
    return ValueAndSlope{half.log_growth, half.log_growth_slope,
                         log_growth_curvature(dynamics, half)};
  };
  return bracketed_root(log_growth, 0.0, infinity, std::min(guess, 1e3), 1.0, time_tolerance);
}

}  // namespace

GapFlight unit_flight(const ServoDynamics& dynamics) {
  const TorqueFreeLine line = dynamics.torque_free_line;
  return flight_from_separation(dynamics, line.position, line.speed, 0.0);
}

UnitHalfCycle unit_half_cycle(const ServoDynamics& dynamics, double flight_time) {
  return half_cycle(dynamics, unit_flight(dynamics), flight_time);
}

std::optional<UnitHalfCycle> balanced_half_cycle(const ServoDynamics& dynamics,
                                                 double growth_at_rest) {
  constexpr double acceptable = 100.0 * time_tolerance;
  const GapFlight flight = unit_flight(dynamics);
  const UnitHalfCycle nearly =
      half_cycle(dynamics, flight, balanced_flight_time(dynamics, flight, growth_at_rest));
  if (!(std::abs(nearly.log_growth) <= acceptable)) return std::nullopt;
  return stepped(dynamics, flight, nearly, -nearly.log_growth / nearly.log_growth_slope);
}

}  // namespace gearlash
