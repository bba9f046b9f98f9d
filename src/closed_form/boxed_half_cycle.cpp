#include "closed_form/boxed_half_cycle.hpp"

#include <algorithm>
#include <cmath>

#include "base/special_numbers.hpp"
#include "closed_form/enclosed_decays.hpp"
#include "closed_form/half_cycle_algebra.hpp"

namespace gearlash::detail {
namespace {

// ---- flights ------------------------------------------------------------------------------------

/// The terms of a flight. All increase with the time and decrease with the rates.
struct FlightParts {
  Interval way;    ///< t exp[0, −Dt]
  Interval speed;  ///< t² exp[0, −Dt, −ct]
  Interval gap;    ///< t³ exp[0, 0, −Dt, −ct]
};

/// The terms at two exponents and a time.
FlightParts parts_at(double load_exponent, double motor_exponent, double time) {
  const BasicDecay<Interval> load = enclosed_decay(load_exponent);
  const BasicConvolution<Interval> both =
      enclosed_convolution(load, enclosed_decay(motor_exponent));
  const Interval t = time;
  return {t * load.integral, t * (t * both.integral), t * (t * (t * both.double_integral))};
}

/// The terms at a time that may be infinite, with the slowest rates.
FlightParts parts_at_most(const Interval& load_rate, const Interval& motor_rate, double time) {
  if (std::isinf(time)) {
    const Interval load = load_rate.low;
    const Interval motor = motor_rate.low;
    return {1.0 / load, 1.0 / (load * motor), {0.0, infinity}};
  }
  return parts_at((load_rate.low * Interval(time)).low, (motor_rate.low * Interval(time)).low,
                  time);
}

/// Bounds of the terms, from the shortest time and the fastest rates to the longest time and the
/// slowest rates.
FlightParts flight_parts(const Interval& load_rate, const Interval& motor_rate,
                         const Interval& time) {
  const FlightParts least = parts_at((load_rate.high * Interval(time.low)).high,
                                     (motor_rate.high * Interval(time.low)).high, time.low);
  const FlightParts most = parts_at_most(load_rate, motor_rate, time.high);
  return {{least.way.low, most.way.high},
          {least.speed.low, most.speed.high},
          {least.gap.low, most.gap.high}};
}

/// The terms of a flight with one decay.
struct DecayParts {
  Interval way;  ///< t exp[0, −rt]
  Interval gap;  ///< t² exp[0, 0, −rt]
};

DecayParts decay_parts(const Interval& rate, const Interval& time) {
  const auto at = [](double exponent, double t) -> DecayParts {
    const BasicDecay<Interval> decay = enclosed_decay(exponent);
    return {Interval(t) * decay.integral, Interval(t) * (Interval(t) * decay.double_integral)};
  };
  const DecayParts least = at((rate.high * Interval(time.low)).high, time.low);
  const DecayParts most = std::isinf(time.high)
                              ? DecayParts{1.0 / Interval(rate.low), {0.0, infinity}}
                              : at((rate.low * Interval(time.high)).low, time.high);
  return {{least.way.low, most.way.high}, {least.gap.low, most.gap.high}};
}

/// e^{−rate·time}; 1 at the rate 0, even for an infinite time.
Interval decayed(const Interval& rate, const Interval& time) { return exp(-(rate * time)); }

// ---- first zeros --------------------------------------------------------------------------------

/// First zero of x, ẍ + 2ζẋ + x = 0, x(0) = −1, ẋ(0) + ζx(0) = rising, of one servo.
Interval zero_of(double damping, double rising) {
  const Interval zeta = damping;
  if (damping < 1.0) {
    const Interval frequency = sqrt((1.0 - zeta) * (1.0 + zeta));
    return atan2(frequency, rising) / frequency;
  }
  if (damping == 1.0) return rising > 0.0 ? 1.0 / Interval(rising) : Interval(infinity);
  const Interval half_split = sqrt((zeta - 1.0) * (zeta + 1.0));
  const Interval excess = rising - half_split;
  if (excess.high <= 0.0) return infinity;
  const Interval time = log1p(2.0 * half_split / not_negative(excess)) / (2.0 * half_split);
  return {time.low, excess.low > 0.0 ? time.high : infinity};
}

/// The same for a box. With x = e^{−ζt}z: z̈ + (1 − ζ²)z = 0, z(0) = −1, ż(0) = rising. The zero
/// comes later for more damping, which weakens the pull, and for a smaller initial slope of z
/// (Sturm's comparison theorem).
Interval first_zero_from_below(const Interval& damping, const Interval& rising) {
  return {zero_of(damping.low, rising.high).low, zero_of(damping.high, rising.low).high};
}

/// ln(fast_part/slow_part)/(λ₂ − λ₁), for a quotient of at least 1. Both parts are positive if the
/// zero exists. Infinite if the divisor is not positive.
Interval time_of_quotient(const Interval& fast_part, const Interval& slow_part,
                          const Interval& rate_split) {
  if (!(slow_part.high > 0.0)) return infinity;
  if (!(fast_part.low > 0.0)) return {0.0, infinity};
  const Interval quotient = fast_part / not_negative(slow_part);
  return not_negative(log(quotient)) / rate_split;
}

Interval narrower(const Interval& x, const Interval& y) {
  if (std::isinf(x.high) != std::isinf(y.high)) return common_part(x, y);
  return x.high - x.low <= y.high - y.low ? x : y;
}

}  // namespace

// ---- the box ------------------------------------------------------------------------------------

BoxedHalfCycle::BoxedHalfCycle(const ServoBox& box)
    : massless_motor_(box.motor_inertia.high == 0.0),
      massless_load_(box.load_inertia.high == 0.0),
      damping_(box.damping),
      motor_inertia_(box.motor_inertia),
      load_inertia_(box.load_inertia),
      motor_rate_(box.motor_rate),
      load_rate_(box.load_rate) {
  if (is_overdamped()) {
    // λ₂ increases with ζ, and λ₁ = 1/λ₂.
    const auto fast = [](const Interval& zeta) { return zeta + sqrt((zeta - 1.0) * (zeta + 1.0)); };
    fast_rate_ = {fast(damping_.low).low, fast(damping_.high).high};
    slow_rate_ = 1.0 / fast_rate_;
    rate_split_ = 2.0 * sqrt((damping_ - 1.0) * (damping_ + 1.0));
  }
  if (massless_load_) {
    parting_position_ = 1.0;
    form_at_parting_ = 1.0;
    return;
  }
  parting_position_ = load_rate_ - 2.0 * damping_;
  if (!massless_motor_) {
    parting_position_ = common_part(parting_position_, motor_inertia_ * (load_rate_ - motor_rate_));
  }
  form_at_parting_ = form_of(-load_rate_, 1.0);
}

/// Q(y, v) = y² + 2ζyv + v²: a sum of squares or, if overdamped, a product of the two decaying
/// modes.
Interval BoxedHalfCycle::form_of(const Interval& position, const Interval& speed) const {
  if (is_overdamped()) {
    return (position + slow_rate_ * speed) * (position + fast_rate_ * speed);
  }
  return square(position + damping_ * speed) + (1.0 - damping_) * (1.0 + damping_) * square(speed);
}

// ---- growth at rest -----------------------------------------------------------------------------

/// As in growth_at_rest(): with p = (1 − λ₁/c)(1 − λ₁/D), μ₀ = −p e^{−λ₁t₁}. The faces part again
/// only if p < 0, that is if λ₁ lies between c and D.
Interval BoxedHalfCycle::overdamped_growth_at_rest(const Interval& motor_time,
                                                   const Interval& load_time,
                                                   const Interval& rising) const {
  const Interval fall = -((1.0 - slow_rate_ * motor_time) * (1.0 - slow_rate_ * load_time));
  if (!(fall.high > 0.0)) return 0.0;
  const Interval quotient =
      (motor_inertia_ * motor_time + load_inertia_ * load_time) / not_negative(fall);
  const Interval engaged = narrower(log1p(rate_split_ * quotient) / rate_split_,
                                    first_zero_from_below(damping_, rising));
  return not_negative(fall) * decayed(slow_rate_, engaged);
}

Interval BoxedHalfCycle::growth_at_rest() const {
  if (form_at_parting_.high <= 0.0) return 0.0;
  if (motor_rate_.high == 0.0 || load_rate_.high == 0.0) return infinity;
  if (motor_rate_.low == 0.0 || load_rate_.low == 0.0) return {0.0, infinity};
  const Interval motor_time = massless_motor_ ? Interval(0.0) : 1.0 / motor_rate_;
  const Interval load_time = massless_load_ ? Interval(0.0) : 1.0 / load_rate_;
  const Interval rising =
      rising_at_rest(damping_, motor_inertia_, load_inertia_, motor_time, load_time);
  if (is_overdamped()) return overdamped_growth_at_rest(motor_time, load_time, rising);
  // (r² − 2ζr + 1)/r² for a rate r. Not below 0, although next to overdamped servos its bounds may
  // be.
  const auto form_of = [&](const Interval& time) {
    return not_negative(square(1.0 - damping_ * time) +
                        (1.0 - damping_) * (1.0 + damping_) * square(time));
  };
  return sqrt(form_of(motor_time) * form_of(load_time)) *
         decayed(damping_, first_zero_from_below(damping_, rising));
}

// ---- the half cycle -----------------------------------------------------------------------------

BoxedEnd BoxedHalfCycle::flight_of_two_masses(const Interval& time) const {
  const FlightParts parts = flight_parts(load_rate_, motor_rate_, time);
  BoxedEnd end;
  end.moved = parts.way;
  end.kick = form_at_parting_ * parts.speed;
  end.crossed = form_at_parting_ * parts.gap;
  end.gap = end.crossed / motor_inertia_;
  end.position = parting_position_ + end.moved;
  end.speed = common_part(decayed(load_rate_, time) - end.kick, 1.0 + speed_change(end));
  return end;
}

/// ü = −(Q/F_M) e^{−Dt}, and the motor does not contribute to the common speed.
BoxedEnd BoxedHalfCycle::flight_of_massless_motor(const Interval& time) const {
  const DecayParts parts = decay_parts(load_rate_, time);
  BoxedEnd end;
  end.moved = parts.way;
  end.kick = 0.0;
  end.crossed = form_at_parting_ * parts.gap;
  end.gap = end.crossed / not_negative(-parting_position_);  // F_M = 2ζ − D beside J_L = 1
  end.position = parting_position_ + end.moved;
  end.speed = common_part(decayed(load_rate_, time), 1.0 + speed_change(end));
  return end;
}

/// v̇_M = −c v_M − 1 beside a load at rest, which does not contribute to the common speed.
BoxedEnd BoxedHalfCycle::flight_over_massless_load(const Interval& time) const {
  const DecayParts parts = decay_parts(motor_rate_, time);
  BoxedEnd end;
  end.moved = 0.0;
  end.kick = parts.way;
  end.crossed = parts.gap;
  end.gap = parts.gap;
  end.position = 1.0;
  end.speed = -parts.way;
  return end;
}

/// P at impact minus the speed at parting.
Interval BoxedHalfCycle::speed_change(const BoxedEnd& end) const {
  return massless_load_ ? -end.kick : -(load_rate_ * end.moved) - end.kick;
}

/// Q just after impact minus Q at parting, from the changes of position and speed. For light
/// damping it is far smaller than either Q.
Interval BoxedHalfCycle::form_change(const BoxedEnd& end) const {
  const Interval slowed = speed_change(end);
  if (massless_load_) return slowed * (slowed + 2.0 * damping_);
  return end.moved * (2.0 * parting_position_ + end.moved) + slowed * (2.0 + slowed) +
         2.0 * damping_ * (parting_position_ * slowed + end.moved * (1.0 + slowed));
}

/// y + λ₁P, which has the sign of λ₂ − D if the faces part again.
Interval BoxedHalfCycle::slow_part(const BoxedEnd& end) const {
  return end.position + slow_rate_ * end.speed;
}

/// t₁ = ln((λ₂ − D)(y + λ₂P)/((λ₁ − D)(y + λ₁P)))/(λ₂ − λ₁).
Interval BoxedHalfCycle::overdamped_engaged_time(const BoxedEnd& end) const {
  const auto side = [&](const Interval& rate) {
    return massless_load_ ? Interval(-1.0) : rate - load_rate_;
  };
  return time_of_quotient(side(fast_rate_) * (end.position + fast_rate_ * end.speed),
                          side(slow_rate_) * slow_part(end), rate_split_);
}

/// The impact engages the faces: n = N/J_L = y₀P − y < 0. If the bounds of n contain 0, only t₁ > 0
/// is known.
Interval BoxedHalfCycle::engaged_time(const BoxedEnd& end) const {
  const Interval load =
      massless_load_ ? end.speed : parting_position_ * speed_change(end) - end.moved;
  if (!(load.high < 0.0)) return {0.0, infinity};
  const Interval engaged_acceleration = -(2.0 * damping_ * end.speed + end.position);
  const Interval load_rate =
      massless_load_ ? engaged_acceleration : parting_position_ * engaged_acceleration - end.speed;
  const Interval time = first_zero_from_below(damping_, load_rate / -load - damping_);
  return is_overdamped() ? narrower(overdamped_engaged_time(end), time) : time;
}

/// ln ρ = ½ ln(Q/Q at parting) − ζt₁; if overdamped, also ln((y + λ₁P)/(λ₂ − D)) − λ₁t₁.
void BoxedHalfCycle::set_growth(BoxedEnd& end) const {
  const Interval change = form_change(end);
  end.form = not_negative(common_part(form_of(end.position, end.speed), form_at_parting_ + change));
  end.engaged = engaged_time(end);
  const Interval by_form =
      common_part(log1p(change / form_at_parting_), log(end.form / form_at_parting_));
  end.log_growth = 0.5 * by_form - damping_ * end.engaged;
  if (!is_overdamped()) return;
  const Interval share =
      slow_part(end) / (massless_load_ ? Interval(-1.0) : fast_rate_ - load_rate_);
  end.log_growth = common_part(end.log_growth, log(not_negative(share)) - slow_rate_ * end.engaged);
}

BoxedEnd BoxedHalfCycle::end(const Interval& time) const {
  BoxedEnd end = massless_load_    ? flight_over_massless_load(time)
                 : massless_motor_ ? flight_of_massless_motor(time)
                                   : flight_of_two_masses(time);
  set_growth(end);
  return end;
}

Interval BoxedHalfCycle::amplitude(const BoxedEnd& end) const {
  Interval most = max(abs(parting_position_), abs(end.position));
  // At the turning point ẏ = 0, so Q = y².
  const bool may_turn_at_once = end.speed.contains(0.0);
  const Interval rising = (end.position + damping_ * end.speed) / end.speed;
  const Interval turning =
      may_turn_at_once ? Interval(0.0, infinity) : first_zero_from_below(damping_, rising);
  Interval turned = sqrt(end.form) * decayed(damping_, turning);
  // If overdamped, y = (y + λ₁P) e^{−λ₁t} where ẏ = 0.
  if (is_overdamped())
    turned = common_part(turned, abs(slow_part(end)) * decayed(slow_rate_, turning));
  if (turning.low < end.engaged.high) most.high = std::max(most.high, turned.high);
  if (turning.high < end.engaged.low) most.low = std::max(most.low, turned.low);
  return most;
}

Interval BoxedHalfCycle::thrust(const Interval& time, const BoxedEnd& end) const {
  if (massless_load_) return end.crossed * decayed(motor_rate_, time);  // y + cP = e^{−ct}
  if (massless_motor_) return end.crossed * end.speed;  // cJ_M → F_M, which `crossed` contains
  const Interval plain = end.position + motor_rate_ * end.speed;
  // (DJ_M + cJ_L) e^{−ct} + (1 + cJ_L(c − D)) t exp[−Dt, −ct]
  const auto convolved = [&](double load_exponent, double motor_exponent) {
    return enclosed_convolution(enclosed_decay(load_exponent), enclosed_decay(motor_exponent))
        .value;
  };
  const Interval value{convolved((load_rate_ * time).high, (motor_rate_ * time).high).low,
                       convolved((load_rate_ * time).low, (motor_rate_ * time).low).high};
  const Interval drag = motor_inertia_ * load_rate_ + load_inertia_ * motor_rate_;
  const Interval bend = 1.0 + motor_rate_ * load_inertia_ * (motor_rate_ - load_rate_);
  const Interval without_cancellation = drag * decayed(motor_rate_, time) + bend * (time * value);
  return end.crossed * not_negative(common_part(plain, without_cancellation));
}

// ---- flight times of the cycles -----------------------------------------------------------------

namespace {

/// d ln ρ/d ln t near a flight time, accurate enough for a step.
double slope_of_growth(const BoxedHalfCycle& half, double time, const BoxedEnd& here) {
  constexpr double nearby = 1e-3;
  const double drive = middle(here.position + half.motor_rate() * here.speed);
  const double slope = time * middle(here.kick) * drive / middle(here.form);
  if (half.has_two_masses() && slope > 0.0 && std::isfinite(slope)) return slope;
  const Interval there = half.end(time * (1.0 + nearby)).log_growth;
  return (middle(there) - middle(here.log_growth)) / nearby;
}

/// A flight time shorter (sign −1) or longer (+1) than that of the cycle of every servo in the box.
/// 0 or infinity if none is found. `off_by` is the bound of ln ρ at the guess, divided by its
/// slope.
double bounding_flight_time(const BoxedHalfCycle& half, double guess, double off_by, double sign) {
  constexpr double shortest_step = 0x1p-51;
  constexpr double longest_step = 12.0;
  const double first = off_by > 0.0 && std::isfinite(off_by) ? 1.25 * off_by : 0.0;
  for (double step = std::clamp(first, shortest_step, 1.0); step < longest_step; step *= 2.0) {
    const double time = guess * std::exp(sign * step);
    const Interval growth = half.end(time).log_growth;
    if (sign < 0.0 ? growth.high < 0.0 : growth.low > 0.0) return time;
  }
  return sign < 0.0 ? 0.0 : infinity;
}

}  // namespace

FlightTimes bounding_flight_times(const BoxedHalfCycle& half, double guess, bool all_hunt) {
  const BoxedEnd here = half.end(guess);
  const double slope = slope_of_growth(half, guess, here);
  return {
      bounding_flight_time(half, guess, here.log_growth.high / slope, -1.0),
      all_hunt ? bounding_flight_time(half, guess, -here.log_growth.low / slope, 1.0) : infinity};
}

}  // namespace gearlash::detail
