#include "gearlash/cycle/cycle_bounds.hpp"

#include <algorithm>
#include <boost/numeric/interval.hpp>
#include <cmath>

#include "gearlash/motion/decay_integral.hpp"
#include "gearlash/motion/engaged_flow.hpp"

namespace gearlash {
namespace {

namespace numeric = boost::numeric;

/// Rounding to nearest: the last bits are covered by widened(), once, at the end.
using Rounding = numeric::interval_lib::rounded_transc_exact<double>;
using Policies =
    numeric::interval_lib::policies<numeric::interval_lib::save_state_nothing<Rounding>,
                                    numeric::interval_lib::checking_base<double>>;
using Interval = numeric::interval<double, Policies>;

constexpr double infinity = std::numeric_limits<double>::infinity();

Interval interval_of(const Bounds& bounds) { return {bounds.low, bounds.high}; }

/// More than what is lost to rounding in some hundred operations.
Bounds widened(const Interval& interval) {
  constexpr double share = 1e-12;
  return {interval.lower() - share * std::abs(interval.lower()),
          interval.upper() + share * std::abs(interval.upper())};
}

/// What a flight is made of. All increase with the time and decrease with the rates.
struct FlightParts {
  double way;    ///< t exp[0, −Dt]
  double speed;  ///< t² exp[0, −Dt, −ct]
  double gap;    ///< t³ exp[0, 0, −Dt, −ct]
};

/// The exponent of a decay; nothing decays at the rate 0, however long it takes.
double exponent_of(double rate, double time) { return rate == 0.0 ? 0.0 : rate * time; }

FlightParts flight_parts(double load_rate, double motor_rate, double time) {
  if (std::isinf(time)) {
    return {1.0 / load_rate, 1.0 / (load_rate * motor_rate), infinity};
  }
  const Decay load = decay(load_rate * time);
  const Convolution both = convolution(load, decay(motor_rate * time));
  return {time * load.integral, time * time * both.integral,
          time * time * time * both.double_integral};
}

/// The same of one decay.
struct DecayParts {
  double way;  ///< t exp[0, −rt]
  double gap;  ///< t² exp[0, 0, −rt]
};

DecayParts decay_parts(double rate, double time) {
  if (std::isinf(time)) return {1.0 / rate, infinity};
  const Decay at = decay(rate * time);
  return {time * at.integral, time * time * at.double_integral};
}

/// First zero of x with x(0) = −1: later, the more damping there is and the less x rises at first.
Interval first_zero_from_below(const Interval& damping, const Interval& slope) {
  return {first_zero(damping.lower(), -1.0, slope.upper()),
          first_zero(damping.upper(), -1.0, slope.lower())};
}

/// e^{−ζt}, with t from a closed form to infinity.
Interval decayed(const Interval& damping, const Interval& time) {
  const double least = std::isinf(time.upper()) ? 0.0 : std::exp(-damping.upper() * time.upper());
  return {least, std::exp(-damping.lower() * time.lower())};
}

/// λ₁ = ζ − √(ζ²−1) and λ₂ = 1/λ₁ of overdamped servos.
struct DecayRates {
  Interval slow;
  Interval fast;
};

DecayRates decay_rates(const Interval& damping) {
  const auto fast = [](double zeta) { return zeta + std::sqrt((zeta - 1.0) * (zeta + 1.0)); };
  const Interval rate(fast(damping.lower()), fast(damping.upper()));
  return {1.0 / rate, rate};
}

/// Of an overdamped x with x(0) = −1 and the slope 2ζ − s:
///   t = ln((λ₂ − s)/(λ₁ − s))/(λ₂ − λ₁), infinite for s ≥ λ₁.
/// What is taken the logarithm of increases with ζ and s. Where ζ is large the slope has lost what
/// decides.
Interval overdamped_zero_from_below(const Interval& damping, const Interval& shortfall) {
  const DecayRates rates = decay_rates(damping);
  const auto logarithm = [](double slow, double fast, double short_by) {
    return short_by < slow ? std::log((fast - short_by) / (slow - short_by)) : infinity;
  };
  const double least = logarithm(rates.slow.upper(), rates.fast.lower(), shortfall.lower()) /
                       (rates.fast.upper() - rates.slow.lower());
  const double most = logarithm(rates.slow.lower(), rates.fast.upper(), shortfall.upper()) /
                      (rates.fast.lower() - rates.slow.upper());
  return {least, most};
}

/// Q(y, v) = y² + 2ζyv + v²: a sum of squares, or, overdamped, the product of the two motions that
/// decay by themselves.
Interval form_of(const Interval& position, const Interval& speed, const Interval& damping) {
  if (damping.lower() >= 1.0) {
    const DecayRates rates = decay_rates(damping);
    return (position + rates.slow * speed) * (position + rates.fast * speed);
  }
  return numeric::square(position + damping * speed) +
         (1.0 - damping) * (1.0 + damping) * numeric::square(speed);
}

/// The servos of a box, and a half cycle of all of them that parts at the speed 1; that of a
/// massless load, which parts at rest, at the position 1.
class BoxedHalfCycle {
 public:
  explicit BoxedHalfCycle(const ServoBox& box)
      : massless_motor_(box.motor_inertia.high == 0.0),
        massless_load_(box.load_inertia.high == 0.0),
        damping_(interval_of(box.damping)),
        motor_inertia_(interval_of(box.motor_inertia)),
        load_inertia_(interval_of(box.load_inertia)),
        motor_rate_(interval_of(box.motor_rate)),
        load_rate_(interval_of(box.load_rate)) {
    if (massless_load_) {
      parting_position_ = 1.0;
      torque_ = {1.0, 0.0};
    } else if (massless_motor_) {
      parting_position_ = load_rate_ - 2.0 * damping_;
      torque_ = {-motor_friction(), 1.0};
    } else {
      parting_position_ = load_rate_ - 2.0 * damping_;
      torque_ = {motor_inertia_ * (load_rate_ - motor_rate_), 1.0};
    }
    form_at_parting_ = massless_load_ ? Interval(1.0) : form_of(-load_rate_, 1.0, damping_);
  }

  /// Q at parting; nobody hunts where it is not positive (docs/mathematics.md, One cycle or none).
  const Interval& form_at_parting() const { return form_at_parting_; }

  Interval growth_at_rest() const {
    if (form_at_parting_.upper() <= 0.0) return 0.0;
    const Interval form_of_motor =
        massless_motor_ ? Interval(1.0) : form_of(-motor_rate_, 1.0, damping_);
    if (form_of_motor.upper() <= 0.0) return 0.0;  // by the exchange of motor and load
    if (motor_rate_.upper() == 0.0 || load_rate_.upper() == 0.0) return {infinity, infinity};
    if (motor_rate_.lower() == 0.0 || load_rate_.lower() == 0.0) return {0.0, infinity};
    // μ₀² = Q_c Q_D e^{−2ζt₁}/(cD)²
    const Interval engaged = engaged_at_rest();
    const auto share = [](const Interval& form, const Interval& rate) {
      return not_negative(form) / numeric::square(rate);
    };
    const Interval of_motor = massless_motor_ ? Interval(1.0) : share(form_of_motor, motor_rate_);
    const Interval of_load = massless_load_ ? Interval(1.0) : share(form_at_parting_, load_rate_);
    const Interval square = of_motor * of_load * numeric::square(decayed(damping_, engaged));
    return {std::sqrt(square.lower()), std::sqrt(square.upper())};
  }

  /// After a flight of this time.
  struct End {
    Interval gap;       ///< |u − u₀|
    Interval position;  ///< y at impact
    Interval speed;     ///< P
    Interval form;      ///< Q just after impact
    Interval engaged;   ///< t₁
    Interval growth;    ///< ρ
  };

  /// Precondition: form_at_parting() > 0, time > 0.
  End end(const Interval& time) const {
    End end = massless_load_    ? flight_over_massless_load(time)
              : massless_motor_ ? flight_of_massless_motor(time)
                                : flight_of_two_masses(time);
    end.form = form_of(end.position, end.speed, damping_);
    end.engaged = time_to_parting(end);
    end.form = not_negative(end.form);  // Q/Q at parting is ρ² times a positive number
    end.growth = numeric::sqrt(end.form / form_at_parting_) * decayed(damping_, end.engaged);
    return end;
  }

  /// Half peak-to-peak of the load, for the unit parting: where it parts, where it meets, and where
  /// it turns while engaged.
  Interval size(const End& end) const {
    Interval most = numeric::max(numeric::abs(parting_position_), numeric::abs(end.position));
    const Interval turning = turning_time(end);
    const Interval turned = numeric::sqrt(end.form) * decayed(damping_, turning);
    if (turning.lower() < end.engaged.upper()) {
      most.assign(most.lower(), std::max(most.upper(), turned.upper()));
    }
    if (turning.upper() < end.engaged.lower()) {
      most.assign(std::max(most.lower(), turned.lower()), most.upper());
    }
    return most;
  }

 private:
  /// N = by_speed ẏ − by_position y, but for a positive factor.
  struct Torque {
    Interval by_speed;
    Interval by_position;
  };

  static Interval not_negative(const Interval& x) {
    return {std::max(0.0, x.lower()), std::max(0.0, x.upper())};
  }

  /// F_M of a massless motor, beside J_L = 1.
  Interval motor_friction() const { return not_negative(2.0 * damping_ - load_rate_); }

  End flight_of_two_masses(const Interval& time) const {
    const FlightParts least = flight_parts(load_rate_.upper(), motor_rate_.upper(), time.lower());
    const FlightParts most = flight_parts(load_rate_.lower(), motor_rate_.lower(), time.upper());
    End end;
    end.gap = form_at_parting_ / motor_inertia_ * Interval(least.gap, most.gap);
    end.position = parting_position_ + Interval(least.way, most.way);
    end.speed = load_speed_after(time) - form_at_parting_ * Interval(least.speed, most.speed);
    return end;
  }

  /// ü = −(Q/F_M) e^{−Dt}, and the motor has no part in the common speed.
  End flight_of_massless_motor(const Interval& time) const {
    const DecayParts least = decay_parts(load_rate_.upper(), time.lower());
    const DecayParts most = decay_parts(load_rate_.lower(), time.upper());
    End end;
    end.gap = form_at_parting_ / motor_friction() * Interval(least.gap, most.gap);
    end.position = parting_position_ + Interval(least.way, most.way);
    end.speed = load_speed_after(time);
    return end;
  }

  /// v̇_M = −c v_M − 1 beside a load at rest, which has no part in the common speed.
  End flight_over_massless_load(const Interval& time) const {
    const DecayParts least = decay_parts(motor_rate_.upper(), time.lower());
    const DecayParts most = decay_parts(motor_rate_.lower(), time.upper());
    End end;
    end.gap = {least.gap, most.gap};
    end.position = parting_position_;
    end.speed = {-most.way, -least.way};
    return end;
  }

  Interval load_speed_after(const Interval& time) const {
    return {std::exp(-exponent_of(load_rate_.upper(), time.upper())),
            std::exp(-exponent_of(load_rate_.lower(), time.lower()))};
  }

  /// N as the motor arrives at a load at rest, at y = −1.
  Interval contact_torque(const Interval& arrival) const {
    if (massless_load_) return arrival;
    if (massless_motor_) return 1.0;
    return load_inertia_ + motor_inertia_ * load_rate_ * arrival;
  }

  /// (cD − 1)/(J_M D + J_L c): −Ṅ/N falls short of 2ζ by so much as the motor arrives.
  Interval shortfall_at_rest() const {
    if (massless_load_) return motor_rate_;
    if (massless_motor_) return load_rate_;
    return (motor_rate_ * load_rate_ - 1.0) /
           (motor_inertia_ * load_rate_ + load_inertia_ * motor_rate_);
  }

  /// From the motor's arrival at a load at rest to parting.
  Interval engaged_at_rest() const {
    const Interval arrival = massless_motor_ ? Interval(0.0) : 1.0 / motor_rate_;
    const Interval torque_slope =
        torque_.by_speed * (2.0 * damping_ * arrival - 1.0) + torque_.by_position * arrival;
    return time_to_parting(torque_slope / contact_torque(arrival), shortfall_at_rest());
  }

  /// The impact engages: the mesh torque is negative. Where its bounds say nothing, t₁ > 0.
  Interval time_to_parting(const End& end) const {
    const Interval torque = torque_.by_speed * end.speed - torque_.by_position * end.position;
    if (!(torque.upper() < 0.0)) return {0.0, infinity};
    const Interval slope = -torque_.by_speed * (2.0 * damping_ * end.speed + end.position) -
                           torque_.by_position * end.speed;
    const Interval shortfall =
        (torque_.by_speed + 2.0 * damping_ * torque_.by_position) * end.position +
        torque_.by_position * end.speed;
    return time_to_parting(slope / -torque, shortfall / -torque);
  }

  /// From N′ = −slope N, slope = 2ζ − shortfall, to N = 0: the narrower bounds of two.
  Interval time_to_parting(const Interval& slope, const Interval& shortfall) const {
    const Interval time = first_zero_from_below(damping_, slope);
    if (damping_.lower() <= 1.0) return time;
    const Interval overdamped = overdamped_zero_from_below(damping_, shortfall);
    return numeric::width(overdamped) < numeric::width(time) ? overdamped : time;
  }

  /// The first zero of ẏ while engaged, from (y, P).
  Interval turning_time(const End& end) const {
    const Interval slope = 2.0 * damping_ * end.speed + end.position;
    if (numeric::zero_in(end.speed)) return {0.0, infinity};
    return first_zero_from_below(damping_, slope / end.speed);
  }

  bool massless_motor_;
  bool massless_load_;
  Interval damping_;
  Interval motor_inertia_;
  Interval load_inertia_;
  Interval motor_rate_;
  Interval load_rate_;
  Interval parting_position_;
  Torque torque_;
  Interval form_at_parting_;
};

/// A flight time that is shorter (sign −1), or longer (+1), than that of the cycle of every servo
/// of the box: there ρ is below 1, or above, for all of them. 0, or infinity, where none is found.
double bounding_flight_time(const BoxedHalfCycle& half, double guess, double sign) {
  const auto growth_after = [&](double time) { return half.end(Interval(time)).growth; };
  // How far ρ may be off at the guess, and how fast it grows there, say how far to go.
  constexpr double nearby = 1e-3;
  const Interval here = growth_after(guess);
  const double slope =
      (numeric::median(growth_after(guess * std::exp(nearby))) - numeric::median(here)) / nearby;
  const double off = sign < 0.0 ? here.upper() - 1.0 : 1.0 - here.lower();
  double step = std::clamp(std::isfinite(off / slope) ? off / slope : 0.0, 1e-11, 1.0);
  constexpr double longest_step = 12.0;
  for (step *= 1.1; step < longest_step; step *= 1.6) {
    const double time = guess * std::exp(sign * step);
    const Bounds growth = widened(growth_after(time));
    if (sign < 0.0 ? growth.high < 1.0 : growth.low > 1.0) return time;
  }
  return sign < 0.0 ? 0.0 : infinity;
}

}  // namespace

CycleBounds bound_cycles(const ServoBox& box, double guessed_flight_time) {
  const BoxedHalfCycle half(box);
  CycleBounds bounds;
  bounds.growth_at_rest = widened(half.growth_at_rest());
  if (bounds.none_hunt() || !(guessed_flight_time > 0.0)) return bounds;
  if (!(half.form_at_parting().lower() > 0.0)) return bounds;
  const double shortest = bounding_flight_time(half, guessed_flight_time, -1.0);
  const double longest =
      bounds.all_hunt() ? bounding_flight_time(half, guessed_flight_time, 1.0) : infinity;
  const Interval time(shortest, longest);
  const BoxedHalfCycle::End end = half.end(time);
  bounds.period = widened(2.0 * (time + end.engaged));
  if (end.gap.lower() > 0.0) bounds.size = widened(half.size(end) / end.gap);
  return bounds;
}

}  // namespace gearlash
