#include "closed_form/first_contact.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/bracketed_root.hpp"
#include "base/special_numbers.hpp"

namespace gearlash {
namespace {

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

/// Sign of u̇ as t → ∞. In the end the loop drives the motor against the side on which the load
/// comes to rest, y∞ = y₀ + v₀/D, or to which it coasts without end. If the load rests at the
/// reference, the motor's speed decays to 0 too, except for a motor without friction, which keeps
/// its speed. (A massless motor, which has no coupling, has friction.)
double final_direction(const GapFlight& flight) {
  const double d = flight.load_rate;
  const double v = flight.load_speed;
  const bool comes_to_rest = d > 0.0 && v != 0.0;
  const double side = comes_to_rest ? d * flight.load_position + v
                      : v != 0.0    ? v
                                    : flight.load_position;
  if (side != 0.0) return -sign_of(side);
  if (flight.motor_rate > 0.0 || (comes_to_rest && flight.coupling == 0.0)) return 0.0;
  const double gained = comes_to_rest ? (flight.load_deceleration - flight.coupling / d) / d : 0.0;
  return sign_of(flight.gap_speed + gained);
}

/// Sign of ü from just after t = 0 to its zero.
double initial_bend(const GapFlight& flight) {
  return sign_of(flight.gap_acceleration != 0.0 ? flight.gap_acceleration : flight.gap_drive);
}

/// Sign of u̇ just after t = 0.
double initial_direction(const GapFlight& flight) {
  return flight.gap_speed != 0.0 ? sign_of(flight.gap_speed) : initial_bend(flight);
}

/// Zeros of u̇ on t > 0, at most two, in order.
struct TurningPoints {
  std::array<double, 2> times{};
  std::size_t count = 0;
};

TurningPoints turning_points(const GapFlight& flight) {
  // The gap is stationary there, so this error of the time does not show in it.
  constexpr double tolerance = 1e-11;
  TurningPoints turning;
  // The rate of ü is G e^{−Dt} − cü.
  const double drive_per_speed =
      flight.load_speed == 0.0 ? 0.0 : flight.gap_drive / flight.load_speed;
  const auto speed = [&](double t) {
    const FlightMotion motion = motion_in_flight(flight, t);
    return ValueAndSlope{
        motion.gap_speed, motion.gap_acceleration,
        drive_per_speed * motion.load_speed - flight.motor_rate * motion.gap_acceleration};
  };
  const std::array<double, 2> ends = {inflection_time(flight), infinity};
  const std::array<double, 2> bends = {initial_bend(flight), sign_of(flight.gap_drive)};
  double start = 0.0;
  // Exact if ü is constant; beyond the zero of ü, if its rate is constant.
  double guess = -flight.gap_speed / flight.gap_acceleration;
  double direction = initial_direction(flight);
  for (std::size_t piece = 0; piece < ends.size() && start < infinity; ++piece) {
    const double end = ends[piece];
    const ValueAndSlope at_end =
        std::isinf(end) ? ValueAndSlope{final_direction(flight), 0.0} : speed(end);
    const double end_direction = sign_of(at_end.value);
    // u̇ cannot change its sign while ü has the same sign.
    if (direction * bends[piece] < 0.0) {
      if (end_direction * direction < 0.0) {
        turning.times[turning.count++] =
            bracketed_root(speed, start, end, guess, end_direction, tolerance);
      }
      if (end_direction != 0.0) direction = end_direction;
    }
    start = end;
    guess = start + std::sqrt(std::abs(2.0 * at_end.value / at_end.curvature));
  }
  return turning;
}

/// A finite time beyond `from` at which `reached` holds, by doubling. The limit of 1e90 keeps t³
/// finite and exceeds the time of any servo.
template <class Predicate>
double finite_bound(double from, const Predicate& reached) {
  double bound = std::max(2.0 * from, 1.0);
  while (bound < 1e90 && !reached(bound)) bound *= 2.0;
  return bound;
}

/// A guess of the crossing. From a turning point it is exact under constant acceleration. From the
/// start it is the least of the times that each of the gap's first three derivatives would take
/// alone; after a clean parting it includes the next order, u = G t³/6 (1 − (c + D) t/4 + …).
double crossing_guess(const GapFlight& flight, double start, double target) {
  if (start > 0.0) {
    const FlightPoint turning = point_in_flight(flight, start);
    const double distance = target - turning.gap_displacement;
    return start + std::sqrt(std::abs(2.0 * distance / turning.motion.gap_acceleration));
  }
  const double cubic = std::cbrt(std::abs(6.0 * target / flight.gap_drive));
  const double drag = (flight.motor_rate + flight.load_rate) * cubic;
  return std::min({std::abs(target / flight.gap_speed),
                   std::sqrt(std::abs(2.0 * target / flight.gap_acceleration)),
                   cubic * (1.0 + drag / (12.0 + drag))});
}

/// Bound of |u − u₀| up to a time: the decays' integrals are at most 1/2 and 1/6.
double farthest(const GapFlight& flight, double time) {
  const double acceleration =
      std::abs(flight.motor_acceleration) + std::abs(flight.load_deceleration);
  return time * (std::abs(flight.gap_speed) +
                 time * (acceleration / 2.0 + time * std::abs(flight.coupling) / 6.0));
}

/// Integrals of the decays, which are factors of a flight's terms.
struct DecayIntegrals {
  double motor;
  double load;
  double coupled;
};

/// Σ|terms| of u − u₀ before they cancel. A is the sum of −c v_M and −y₀/J_M. For a massless motor
/// u̇₀ = −y₀/F_M − v₀ and B = D v₀ − v₀/F_M are differences.
double size_of_terms(const GapFlight& flight, double time, const DecayIntegrals& decays) {
  const double load_speed = std::abs(flight.load_speed);
  const double gap_speed = std::abs(flight.gap_speed);
  const double massless_motor_flight = flight.coupling == 0.0 ? 2.0 * load_speed : 0.0;
  const double acceleration =
      std::abs(flight.motor_acceleration) + 2.0 * flight.motor_rate * (load_speed + gap_speed);
  const double deceleration =
      std::abs(flight.load_deceleration) + flight.load_rate * massless_motor_flight;
  return time * (gap_speed + massless_motor_flight +
                 time * (acceleration * decays.motor + deceleration * decays.load +
                         std::abs(flight.coupling) * time * decays.coupled));
}

/// Whether rounding decides on which side of a face u lies, given its computed distance `excess`
/// beyond the face. The band is 32 epsilons of the gap and of all terms. Sixteen of these cover a
/// decay's integral (decay_integral.hpp), which a relative error of its rate changes by no more
/// than that error. The others cover rates, coefficients and the sum.
bool rounding_decides(const GapFlight& flight, double backlash, double time, double excess) {
  constexpr double share = 32.0 * std::numeric_limits<double>::epsilon();
  const auto may_be = [&](const DecayIntegrals& decays) {
    return std::abs(excess) <= share * (backlash + size_of_terms(flight, time, decays));
  };
  if (!may_be({0.5, 0.5, 1.0 / 6.0})) return false;  // their upper bounds
  const BasicFlightDecays<double> decays = decays_at(flight, time);
  return may_be(
      {decays.motor.double_integral, decays.load.double_integral, decays.coupled.double_integral});
}

/// A stretch of a flight on which u is monotone; `target` is the face that it leads to, from u₀.
struct MonotonePiece {
  double start;
  double end;
  double target;
  double direction;
};

/// Time at which u − u₀ reaches the target, or infinity if it does not by the horizon. Sets `touch`
/// if the piece ends so near the target that rounding decides.
double crossing(const GapFlight& flight, const MonotonePiece& piece, double backlash,
                double horizon, GapTouch& touch) {
  const auto& [start, end, target, direction] = piece;
  const auto distance = [&, target = target](double t) {
    const FlightPoint point = point_in_flight(flight, t);
    return ValueAndSlope{point.gap_displacement - target, point.motion.gap_speed,
                         point.motion.gap_acceleration};
  };
  const auto beyond = [&, direction = direction](double t) {
    return distance(t).value * direction;
  };
  if (horizon < end && farthest(flight, horizon) < (1.0 - 1e-9) * std::abs(target)) {
    return infinity;
  }
  double bound = end;
  // If u̇ does not tend to 0 the gap closes for certain. Otherwise a time must be found at which it
  // is closed.
  if (std::isinf(end) && final_direction(flight) == 0.0) {
    bound = finite_bound(start, [&](double t) { return beyond(t) >= 0.0; });
  }
  double time = infinity;
  const double excess = std::isinf(bound) ? infinity : beyond(bound);
  if (excess >= 0.0) {
    const double guess = crossing_guess(flight, start, target);
    time = bracketed_root(distance, start, bound, guess, direction);
    if (time > horizon) time = infinity;
  }
  const double first = std::min(time, end);
  if (std::isfinite(bound) && first <= horizon &&
      rounding_decides(flight, backlash, bound, excess)) {
    touch = {.time = first, .toward = direction};
  }
  return time;
}

/// Duration of a bounce: a flight from a face with ü towards that face throughout, too low to reach
/// the other face. Infinity for any other flight, or if ü changes its sign first.
double bounce_duration(const GapFlight& flight, double backlash) {
  const double toward = sign_of(flight.gap_acceleration);
  if (std::abs(flight.gap) != 0.5 * backlash || !(toward * flight.gap > 0.0) ||
      !(toward * flight.gap_speed < 0.0)) {
    return infinity;
  }
  const double under_constant_acceleration = -2.0 * flight.gap_speed / flight.gap_acceleration;
  if (!(std::abs(flight.gap_speed) * under_constant_acceleration < backlash)) return infinity;
  const double bend_end = inflection_time(flight);
  // (u − u₀)/t, which is monotone until ü changes its sign.
  const auto mean_speed = [&](double t) {
    const FlightPoint point = point_in_flight(flight, t);
    const double speed = point.gap_displacement / t;
    const double slope = (point.motion.gap_speed - speed) / t;
    return ValueAndSlope{speed, slope, (point.motion.gap_acceleration - 2.0 * slope) / t};
  };
  const bool returns = std::isinf(bend_end) ? final_direction(flight) == toward
                                            : mean_speed(bend_end).value * toward > 0.0;
  if (!returns) return infinity;
  const double duration =
      bracketed_root(mean_speed, 0.0, bend_end, under_constant_acceleration, toward);
  // u stays below its first tangent.
  return std::abs(flight.gap_speed) * duration < backlash ? duration : infinity;
}

}  // namespace

FirstContact first_contact(const GapFlight& flight, double backlash, double horizon) {
  const double bounce = bounce_duration(flight, backlash);
  if (bounce < infinity) {
    return bounce <= horizon ? FirstContact{bounce, sign_of(flight.gap), {}}
                             : FirstContact{infinity, 0.0, {}};
  }
  const double to_forward = 0.5 * backlash - flight.gap;
  const double to_backward = -0.5 * backlash - flight.gap;
  const TurningPoints turning = turning_points(flight);
  GapTouch touch;
  double start = 0.0;
  double direction = initial_direction(flight);
  for (std::size_t piece = 0; piece <= turning.count && start < horizon; ++piece) {
    const double end = piece < turning.count ? turning.times[piece] : infinity;
    const double target = direction > 0.0 ? to_forward : to_backward;
    if (direction != 0.0) {
      const double time =
          crossing(flight, {start, end, target, direction}, backlash, horizon, touch);
      if (time < infinity) return {time, direction, touch};
    }
    start = end;
    direction = -direction;
  }
  return {infinity, 0.0, touch};
}

}  // namespace gearlash
