// The plastic half cycle in a hundred and twenty digits, from exponentials of the raw equations:
// what is enclosed in doubles must hold these numbers. Two masses, friction on both.
#pragma once

#include <algorithm>
#include <boost/math/constants/constants.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <optional>

namespace gearlash {

using Digits = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<120>,
                                             boost::multiprecision::et_off>;

class ExactHalfCycle {
 public:
  ExactHalfCycle(double damping, double inertia_ratio, double friction_ratio)
      : ExactHalfCycle(Digits(damping), Digits(inertia_ratio), Digits(friction_ratio)) {}
  ExactHalfCycle(const Digits& damping, const Digits& inertia_ratio, const Digits& friction_ratio)
      : damping_(damping),
        motor_inertia_(1 / (1 + inertia_ratio)),
        load_inertia_(inertia_ratio / (1 + inertia_ratio)),
        motor_friction_(2 * damping * (1 - friction_ratio)),
        load_friction_(2 * damping * friction_ratio),
        motor_rate_(motor_friction_ / motor_inertia_),
        load_rate_(load_friction_ / load_inertia_),
        split_(sqrt(abs(damping * damping - 1))) {}

  /// μ₀: the load at rest at −1, the motor arriving at 1/F_M.
  Digits growth_at_rest() const {
    const auto parting = next_parting({Digits(-1), motor_inertia_ / motor_friction_});
    if (!parting) return 0;
    return abs(parting->state.position + parting->state.speed / load_rate_);
  }

  /// After a flight that parts at the speed 1.
  struct End {
    Digits gap;       ///< |u − u₀|
    Digits position;  ///< y at impact
    Digits speed;     ///< P
    Digits engaged;   ///< t₁
    Digits growth;    ///< ρ, 0 where the faces do not part again
  };
  End end(const Digits& time) const {
    const Digits start = load_rate_ - 2 * damping_;
    const Digits load_decay = exp(-load_rate_ * time);
    const Digits motor_decay = exp(-motor_rate_ * time);
    // v_M = K e^{−ct} + p + q e^{−Dt}
    const Digits p = -(start + 1 / load_rate_) / motor_friction_;
    const Digits q = 1 / (load_rate_ * motor_inertia_ * (motor_rate_ - load_rate_));
    const Digits k = 1 - p - q;
    const Digits way = (1 - load_decay) / load_rate_;
    const Digits motor_way = k * (1 - motor_decay) / motor_rate_ + p * time + q * way;
    const Digits motor_speed = k * motor_decay + p + q * load_decay;
    End end;
    end.gap = way - motor_way;
    end.position = start + way;
    end.speed = motor_inertia_ * motor_speed + load_inertia_ * load_decay;
    const auto parting = next_parting({end.position, end.speed});
    if (!parting) return end;
    end.engaged = parting->time;
    end.growth = -parting->state.speed;
    return end;
  }

  struct Cycle {
    Digits amplitude_over_backlash;
    Digits period;
    Digits multiplier;
  };
  /// From near its flight time, by the secant method on ln ρ; nothing where that does not converge.
  std::optional<Cycle> cycle(double near) const {
    Digits before = Digits(near) * (1 - Digits(1e-9));
    Digits time = Digits(near) * (1 + Digits(1e-9));
    Digits value_before = log(end(before).growth);
    const Digits precise("1e-60");
    for (int i = 0; i < 30; ++i) {
      const Digits value = log(end(time).growth);
      if (abs(value) < precise) return cycle_at(time);
      const Digits next = time - value * (time - before) / (value - value_before);
      before = time;
      value_before = value;
      time = next;
    }
    return std::nullopt;
  }

 private:
  struct State {
    Digits position, speed;
  };
  struct Parting {
    Digits time;
    State state;
  };

  /// First zero of x = a y + b ẏ while engaged.
  std::optional<Digits> first_zero(const State& at, const Digits& a, const Digits& b) const {
    const Digits value = a * at.position + b * at.speed;
    const Digits slope = a * at.speed - b * (2 * damping_ * at.speed + at.position);
    if (damping_ == 1) {
      const Digits time = -value / (slope + value);
      return time > 0 ? std::optional(time) : std::nullopt;
    }
    if (damping_ < 1) {
      Digits angle = atan2(-value * split_, slope + damping_ * value);
      if (angle <= 0) angle += boost::math::constants::pi<Digits>();
      return angle / split_;
    }
    const Digits slow = (slope + (damping_ + split_) * value) / (2 * split_);
    const Digits quotient = -(value - slow) / slow;
    if (!(quotient > 1)) return std::nullopt;
    return log(quotient) / (2 * split_);
  }

  State engaged_after(const State& start, const Digits& time) const {
    const Digits decay = exp(-damping_ * time);
    const Digits angle = split_ * time;
    const Digits cosine = damping_ < 1 ? Digits(cos(angle)) : Digits(cosh(angle));
    const Digits sine = damping_ == 1  ? time
                        : damping_ < 1 ? Digits(sin(angle) / split_)
                                       : Digits(sinh(angle) / split_);
    return {decay * (start.position * (cosine + damping_ * sine) + start.speed * sine),
            decay * (start.speed * (cosine - damping_ * sine) - start.position * sine)};
  }

  std::optional<Parting> next_parting(const State& impact) const {
    const auto time = first_zero(impact, -load_inertia_,
                                 load_friction_ * motor_inertia_ - motor_friction_ * load_inertia_);
    if (!time) return std::nullopt;
    return Parting{*time, engaged_after(impact, *time)};
  }

  Cycle cycle_at(const Digits& time) const {
    const End here = end(time);
    // Where the load turns: at the ends of the flight, or engaged.
    Digits most = std::max<Digits>(abs(load_rate_ - 2 * damping_), abs(here.position));
    const auto turning = first_zero({here.position, here.speed}, 0, 1);
    if (turning && *turning < here.engaged) {
      most = std::max<Digits>(most,
                              abs(engaged_after({here.position, here.speed}, *turning).position));
    }
    // The map's slope by a difference: amplitudes are σ = b/U, and R = bρ/U.
    const Digits step = time * Digits("1e-40");
    const End later = end(time + step);
    const End sooner = end(time - step);
    const Digits slope =
        (later.growth / later.gap - sooner.growth / sooner.gap) / (1 / later.gap - 1 / sooner.gap);
    return {most / here.gap, 2 * (time + here.engaged), slope * slope};
  }

  Digits damping_, motor_inertia_, load_inertia_, motor_friction_, load_friction_, motor_rate_,
      load_rate_;
  Digits split_;  ///< √|ζ² − 1|
};

}  // namespace gearlash
