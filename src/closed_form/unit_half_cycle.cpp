#include "closed_form/unit_half_cycle.hpp"

#include <algorithm>
#include <cmath>

#include "base/bracketed_root.hpp"
#include "base/special_numbers.hpp"
#include "closed_form/engaged_flow.hpp"

namespace gearlash {
namespace {

UnitHalfCycle half_cycle(const ServoDynamics& dynamics, const GapFlight& flight, double time) {
  UnitHalfCycle half = impact_at(dynamics, flight, time, point_in_flight(flight, time));
  half.engaged_time =
      first_zero(dynamics.damping, mesh_torque(dynamics, half.load_position, half.common_speed),
                 mesh_torque_rate(dynamics, half.load_position, half.common_speed));
  half.log_growth = std::isinf(half.engaged_time)
                        ? -infinity
                        : 0.5 * std::log1p(half.form_change / start_form(dynamics, flight)) -
                              dynamics.damping * half.engaged_time;
  return half;
}

/// A massless motor's ü goes as e^{−Dt}, and a massless load stands still.
double gap_jerk(const ServoDynamics& dynamics, const GapFlight& flight, const UnitHalfCycle& half) {
  if (dynamics.massless_motor()) return -flight.load_rate * half.gap_acceleration;
  if (flight.load_speed == 0.0) return -flight.motor_rate * half.gap_acceleration;
  return gap_jerk_of_two_masses(flight, half);
}

constexpr double time_tolerance = 1e-9;  // its square is below rounding

/// The root of ln ρ(t) = 0, to time_tolerance: bracketed, so that no guess can mislead it.
double balanced_flight_time(const ServoDynamics& dynamics, const GapFlight& flight, double guess) {
  const auto log_growth = [&](double time) {
    const UnitHalfCycle half = half_cycle(dynamics, flight, time);
    return growth_at(half, arrival_rates(dynamics, flight, half));
  };
  return bracketed_root(log_growth, 0.0, infinity, guess, 1.0, time_tolerance);
}

/// Halley's step from a half cycle towards the balanced one. It is taken if it is so short that
/// what its second order leaves out is below rounding. `taken` has the residual of the step's own
/// order.
struct LastStep {
  double length;
  std::optional<UnitHalfCycle> taken;
};

LastStep last_step(const ServoDynamics& dynamics, const GapFlight& flight,
                   const UnitHalfCycle& half) {
  const ArrivalRates rates = arrival_rates(dynamics, flight, half);
  const ValueAndSlope growth = growth_at(half, rates);
  const double step = newton_step(growth);
  const double fastest =
      std::max({1.0 / half.flight_time, 1.0, flight.load_rate, flight.motor_rate});
  if (!is_near_zero(growth, short_step / fastest)) return {step, std::nullopt};
  return {step, stepped(dynamics, flight, half, rates, gap_jerk(dynamics, flight, half), step)};
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
  const GapFlight flight = unit_flight(dynamics);
  const double guess = guessed_flight_time(dynamics, std::log(growth_at_rest));
  UnitHalfCycle half = half_cycle(dynamics, flight, guess);
  for (int evaluation = 1;; ++evaluation) {
    const LastStep step = last_step(dynamics, flight, half);
    if (step.taken) return step.taken;
    // Far from the root, or converging more slowly than Halley's method near a root: use the
    // bracket.
    constexpr int most_evaluations = 3;
    if (evaluation == most_evaluations || !(std::abs(step.length) < 0.5 * half.flight_time)) break;
    half = half_cycle(dynamics, flight, half.flight_time + step.length);
  }
  constexpr double acceptable = 100.0 * time_tolerance;
  half = half_cycle(dynamics, flight, balanced_flight_time(dynamics, flight, guess));
  if (!(std::abs(half.log_growth) <= acceptable)) return std::nullopt;
  const ArrivalRates rates = arrival_rates(dynamics, flight, half);
  return stepped(dynamics, flight, half, rates, gap_jerk(dynamics, flight, half),
                 newton_step(growth_at(half, rates)));
}

}  // namespace gearlash
