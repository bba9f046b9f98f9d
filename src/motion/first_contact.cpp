#include "gearlash/motion/first_contact.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "gearlash/motion/bracketed_root.hpp"

namespace gearlash {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

double sign_of(double value) { return static_cast<double>((value > 0.0) - (value < 0.0)); }

/// The zero of ü on t > 0, or infinity: t φ₁(κt) = −ü₀/G with κ = c − D.
double inflection_time(const GapFlight& flight) {
  if (flight.gap_drive == 0.0) return infinity;
  const double quotient = -flight.gap_acceleration / flight.gap_drive;
  if (!(quotient > 0.0)) return infinity;
  const double rate_difference = flight.motor_rate - flight.load_rate;
  if (rate_difference == 0.0) return quotient;
  const double argument = rate_difference * quotient;
  return argument > -1.0 ? std::log1p(argument) / rate_difference : infinity;
}

/// Sign of u̇ as t → ∞: its limit, or the sign of the term that outgrows the others. With D = 0
/// the load coasts for ever and C t²/2 or C t/c wins; with c = 0 < D the motor is left with the
/// steady acceleration A + C/D.
double final_direction(const GapFlight& flight) {
  const double c = flight.motor_rate;
  const double d = flight.load_rate;
  const bool coupled = flight.coupling != 0.0;
  if (coupled && d == 0.0) return sign_of(flight.coupling);
  double limit = flight.gap_speed;
  if (d > 0.0) limit += flight.load_deceleration / d;
  if (c == 0.0) {
    const double growth = flight.motor_acceleration + (coupled ? flight.coupling / d : 0.0);
    if (growth != 0.0) return sign_of(growth);
    return sign_of(limit - (coupled ? flight.coupling / (d * d) : 0.0));
  }
  limit += flight.motor_acceleration / c;
  if (coupled) limit += flight.coupling / (d * c);
  return sign_of(limit);
}

/// Sign of u̇ just after t = 0.
double initial_direction(const GapFlight& flight) {
  if (flight.gap_speed != 0.0) return sign_of(flight.gap_speed);
  if (flight.gap_acceleration != 0.0) return sign_of(flight.gap_acceleration);
  return sign_of(flight.gap_drive);
}

/// A finite time beyond `from` at which `reached` holds; doubled until it does (1e90 keeps t³ a
/// finite number, and is no time that a servo will see).
template <class Predicate>
double finite_bound(double from, const Predicate& reached) {
  double bound = std::max(2.0 * from, 1.0);
  while (bound < 1e90 && !reached(bound)) bound *= 2.0;
  return bound;
}

/// Exact for a constant acceleration; outside the bracket where that says nothing.
double turning_guess(const GapFlight& flight, double start) {
  return start == 0.0 ? -flight.gap_speed / flight.gap_acceleration : 0.0;
}

/// Zeros of u̇ within (0, horizon), at most two, in order.
struct TurningPoints {
  std::array<double, 2> times{};
  std::size_t count = 0;
};

TurningPoints turning_points(const GapFlight& flight, double horizon) {
  TurningPoints turning;
  const double inflection = inflection_time(flight);
  const std::array<double, 2> ends = {std::min(inflection, horizon), horizon};
  double start = 0.0;
  double direction = initial_direction(flight);
  for (const double end : ends) {
    if (!(end > start) || direction == 0.0) continue;
    double bound = end;
    const double end_direction = std::isinf(end) ? final_direction(flight)
                                                 : sign_of(motion_in_flight(flight, end).gap_speed);
    if (end_direction * direction < 0.0) {
      if (std::isinf(end)) {
        bound = finite_bound(start, [&](double t) {
          return sign_of(motion_in_flight(flight, t).gap_speed) == end_direction;
        });
      }
      const auto speed = [&](double t) {
        const FlightMotion motion = motion_in_flight(flight, t);
        return ValueAndSlope{motion.gap_speed, motion.gap_acceleration};
      };
      turning.times[turning.count++] =
          bracketed_root(speed, start, bound, turning_guess(flight, start), end_direction);
    }
    if (end_direction != 0.0) direction = end_direction;
    start = end;
  }
  return turning;
}

/// Where a monotone piece of u − u₀ reaches `target`, or infinity.
double crossing(const GapFlight& flight, double start, double end, double target,
                double direction) {
  const auto distance = [&](double t) { return gap_displacement_at(flight, t) - target; };
  double bound = end;
  if (std::isinf(end)) {
    bound = finite_bound(start, [&](double t) { return distance(t) * direction >= 0.0; });
  }
  if (distance(bound) * direction < 0.0) return infinity;
  const auto value_and_slope = [&](double t) {
    const FlightMotion motion = motion_in_flight(flight, t);
    return ValueAndSlope{distance(t), motion.gap_speed, motion.gap_acceleration};
  };
  // Exact for a bounce under a constant acceleration, and for a clean parting without friction.
  double guess = 2.0 * start;
  if (start == 0.0 && flight.gap_speed == 0.0 && flight.gap_acceleration == 0.0) {
    guess = std::cbrt(std::abs(6.0 * target / flight.gap_drive));
  }
  return bracketed_root(value_and_slope, start, bound, guess, direction);
}

}  // namespace

FirstContact first_contact(const GapFlight& flight, double backlash, double horizon) {
  const double to_forward = 0.5 * backlash - flight.gap;
  const double to_backward = -0.5 * backlash - flight.gap;
  const TurningPoints turning = turning_points(flight, horizon);
  double start = 0.0;
  double direction = initial_direction(flight);
  for (std::size_t piece = 0; piece <= turning.count; ++piece) {
    const double end = piece < turning.count ? turning.times[piece] : horizon;
    const double target = direction > 0.0 ? to_forward : to_backward;
    if (direction != 0.0) {
      const double time = crossing(flight, start, end, target, direction);
      if (time <= horizon && time < infinity) return {time, direction};
    }
    start = end;
    direction = -direction;
  }
  return {infinity, 0.0};
}

}  // namespace gearlash
