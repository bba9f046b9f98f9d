// A sampled controller and rigid faces.
//
// Between events of the computer the plant is that of continuous_loop.cpp with a held torque:
//   z′ = (s + c u)/J,   s′ = τ − F (s + c u)/J + w,   c = Fκ − F_M.
// At tick k the controller reads z + αu and z + βu, hence u(t_k). So the numbers at the ticks obey
// ξ⁺ = Φ ξ + Γ u(t_k) + ∫ K(θ) u, with K(θ) = e^{−fθ} (c/J) (1, −F) from θ before the next tick,
// f = F/J: of one direction. The largest |z| at the ticks that |u| ≤ 1 can cause is
// Σ|e Φᵏ Γ| + ∫e^{−fθ} Σ|e Φᵏ (c/J)(1, −F)|. Between them z bends by at most |z̈|, which decays: it
// exceeds the line between the ends of a segment of length h by at most h²/8 |z̈|.
#include <algorithm>
#include <variant>
#include <vector>

#include "analysis/ceiling/loop_gain.hpp"
#include "closed_form/enclosed_decays.hpp"

namespace gearlash {
namespace {

using drive::LinearController;
using drive::ReducedDrive;

enum : std::size_t { position, momentum, controller_states };

/// What an input at one instant, or spread over a tick, adds.
struct Reading {
  Interval position{0.0};  ///< to the position read
  Interval counted{0.0};   ///< to the position whose differences are the speed
};

/// A number as a linear form of the state at a tick and of what is read there.
struct Form {
  IntervalVector of_state{};
  Reading of_reading{};
};

Form operator+(Form a, const Form& b) {
  for (std::size_t i = 0; i < a.of_state.size(); ++i) a.of_state[i] = a.of_state[i] + b.of_state[i];
  a.of_reading.position = a.of_reading.position + b.of_reading.position;
  a.of_reading.counted = a.of_reading.counted + b.of_reading.counted;
  return a;
}

Form operator*(const Interval& factor, Form form) {
  for (Interval& number : form.of_state) number = factor * number;
  form.of_reading.position = factor * form.of_reading.position;
  form.of_reading.counted = factor * form.of_reading.counted;
  return form;
}

/// The plant over a time: z and s from those at its start and from a held torque.
struct Passage {
  Interval factor;              ///< e^{−fθ}
  Interval decrease;            ///< 1 − e^{−fθ}
  Interval duration;            ///< ∫e^{−fθ}
  Interval position_of_speed;   ///< z per s
  Interval position_of_torque;  ///< z per torque
};

struct Plant {
  Interval inertia;
  Interval friction;

  /// The functions fall as the exponent grows.
  Passage over(const Interval& time) const {
    const Interval exponent = friction * time / inertia;
    const auto least = detail::enclosed_decay(exponent.high);
    const auto most = detail::enclosed_decay(std::max(0.0, exponent.low));
    const Interval integral = hull(least.integral, most.integral);
    const Interval double_integral = hull(least.double_integral, most.double_integral);
    return {.factor = hull(least.factor, most.factor),
            .decrease = exponent * integral,
            .duration = time * integral,
            .position_of_speed = time * integral / inertia,
            .position_of_torque = square(time) * double_integral / inertia};
  }
};

class SampledLoop : public DisturbedLoop {
 public:
  explicit SampledLoop(const ReducedDrive& drive);
  bool prove();
  LoopGain gain(Disturbance disturbance) const override;

 private:
  struct Segment {
    Interval from;  ///< s after the tick
    Interval length;
    Form start;         ///< z
    Form acceleration;  ///< z̈
  };
  Form state(std::size_t index) const {
    Form form{IntervalVector(size_, Interval(0.0)), {}};
    form.of_state[index] = 1.0;
    return form;
  }
  Form nothing() const { return {IntervalVector(size_, Interval(0.0)), {}}; }
  Form reading(const Interval& of_position, const Interval& of_speed) const;
  void plan(int parts);
  void pass(const Interval& from, const Interval& time, const Form& torque, int parts, Form& z,
            Form& s);
  IntervalMatrix changes() const;
  /// A disturbance's way into the loop.
  struct Entry {
    Interval of_position{0.0};
    Interval of_counted{0.0};
    IntervalVector tick{};    ///< what a reading adds to the numbers at the next tick
    IntervalVector steady{};  ///< what acts between the ticks adds per unit of `weight`
    IntervalVector spread{};  ///< how much that varies over a tick
    Interval weight{1.0};
    /// What has acted since the tick adds these times ∫e^{−fθ} and ∫∫e^{−fθ}/J.
    Interval rate{0.0};
    Interval torque{0.0};
    Interval on_load{0.0};
    Interval on_motor{0.0};
  };
  Entry entry(Disturbance disturbance) const;
  Interval largest(const Form& form, const Entry& entry) const;
  /// The largest |z| at the ends of the segments, of which the last is the next tick's first, and
  /// by how much more it may bend between them.
  struct Extent {
    Interval at_ends{0.0};
    Interval bend{0.0};
  };
  Extent extent(const Entry& entry) const;
  IntervalVector tick_input(const Interval& of_position, const Interval& of_counted) const;

  Plant plant_;
  double period_in_doubles_;
  drive::SplitDelay delay_;
  Interval period_;
  Interval share_;  ///< κ
  Interval alpha_;
  Interval beta_;
  Interval lead_;  ///< c
  LinearController controller_;
  bool counts_ = false;  ///< the speed is a difference of positions, and the last one is kept
  std::size_t last_reading_ = 0;
  std::size_t queue_ = 0;  ///< torques that wait, the newest first
  std::size_t waiting_ = 0;
  std::size_t size_ = 0;
  Form asked_;              ///< torque worked out at the tick
  std::vector<Form> next_;  ///< all numbers at the next tick
  std::vector<Segment> segments_;
  std::optional<DecayingMotion> motion_;
};

SampledLoop::SampledLoop(const ReducedDrive& drive)
    : period_in_doubles_(drive.sampling->period),
      delay_(drive::split_delay(*drive.sampling)),
      period_(datum(drive.sampling->period)),
      controller_(drive::sampled_controller(drive.controller, *drive.sampling)),
      counts_(uses_speed(controller_)) {
  const Interval motor_inertia = datum(drive.motor.inertia);
  const Interval motor_friction = datum(drive.motor.friction.viscous);
  plant_ = {motor_inertia + datum(drive.load.inertia),
            motor_friction + datum(drive.load.friction.viscous)};
  share_ = motor_inertia / plant_.inertia;
  alpha_ = 1.0 - datum(drive.sensing.load_share_of_position) - share_;
  beta_ = 1.0 - datum(drive.sensing.load_share_of_speed) - share_;
  lead_ = plant_.friction * share_ - motor_friction;
  plan(1);
}

bool SampledLoop::prove() {
  motion_ = DecayingMotion::of(changes(), TimeKind::stepwise);
  if (!motion_) return false;
  constexpr double unseen = 1e-3;  // share of the gain
  constexpr double most_parts = 32.0;
  const Extent extent = this->extent(entry(Disturbance::gap));
  const double parts = std::sqrt(extent.bend.high / (unseen * extent.at_ends.high));
  if (parts > 1.0) plan(static_cast<int>(std::ceil(std::min(parts, most_parts))));
  return true;
}

/// Σ of what is read: a position and, from the difference to the last one, a speed.
Form SampledLoop::reading(const Interval& of_position, const Interval& of_speed) const {
  Form form = of_position * state(position);
  form.of_reading.position = of_position;
  if (!counts_) return form;
  const Interval per_angle = of_speed / period_;
  form = form + per_angle * state(position);
  form.of_state[last_reading_] = form.of_state[last_reading_] - per_angle;
  form.of_reading.counted = per_angle;
  return form;
}

/// The plant over a time with one torque, as segments of equal length.
void SampledLoop::pass(const Interval& from, const Interval& time, const Form& torque, int parts,
                       Form& z, Form& s) {
  const Interval length = time / Interval(static_cast<double>(parts));
  const Passage over = plant_.over(length);
  const Interval per_inertia = 1.0 / plant_.inertia;
  for (int i = 0; i < parts; ++i) {
    segments_.push_back({from + static_cast<double>(i) * length, length, z,
                         per_inertia * (torque + -(plant_.friction * per_inertia) * s)});
    z = z + over.position_of_speed * s + over.position_of_torque * torque;
    s = over.factor * s + over.duration * torque;
  }
}

/// What happens from one tick to the next, in segments: `parts` for each torque.
void SampledLoop::plan(int parts) {
  segments_.clear();
  waiting_ = delay_.rest > 0.0 ? static_cast<std::size_t>(delay_.whole_periods) + 1 : 0;
  last_reading_ = controller_states + controller_.order();
  queue_ = last_reading_ + (counts_ ? 1 : 0);
  size_ = queue_ + waiting_;

  const std::size_t order = controller_.order();
  asked_ = reading(datum(controller_.direct[1]), datum(controller_.direct[2]));
  for (std::size_t i = 0; i < order; ++i) {
    asked_.of_state[controller_states + i] = datum(controller_.output[i]);
  }
  Form z = state(position);
  Form s = state(momentum);
  const bool changes_within = delay_.rest > 0.0 && delay_.rest < period_in_doubles_;
  const auto waiting = [&](std::size_t ticks) {
    return ticks == 0 ? asked_ : state(queue_ + ticks - 1);
  };
  if (changes_within) {
    const Interval rest = datum(delay_.rest);
    pass(0.0, rest, waiting(waiting_), parts, z, s);
    pass(rest, not_negative(period_ - rest), waiting(waiting_ - 1), parts, z, s);
  } else {
    pass(0.0, period_, waiting(waiting_), parts, z, s);
  }

  next_.assign(size_, nothing());
  next_[position] = z;
  next_[momentum] = s;
  for (std::size_t i = 0; i < order; ++i) {
    Form& next = next_[controller_states + i];
    next = reading(datum(controller_.input_matrix[i][1]), datum(controller_.input_matrix[i][2]));
    for (std::size_t j = 0; j < order; ++j) {
      next.of_state[controller_states + j] = datum(controller_.state_matrix[i][j]);
    }
  }
  if (counts_) {
    next_[last_reading_] = state(position);
    next_[last_reading_].of_reading.counted = 1.0;
  }
  for (std::size_t i = 0; i < waiting_; ++i) next_[queue_ + i] = waiting(i);
}

/// Φ − 1.
IntervalMatrix SampledLoop::changes() const {
  IntervalMatrix changes(size_);
  for (std::size_t i = 0; i < size_; ++i) {
    changes.rows[i] = next_[i].of_state;
    changes.rows[i][i] = changes.rows[i][i] - 1.0;
  }
  return changes;
}

IntervalVector SampledLoop::tick_input(const Interval& of_position,
                                       const Interval& of_counted) const {
  IntervalVector input;
  for (const Form& next : next_) {
    input.push_back(next.of_reading.position * of_position + next.of_reading.counted * of_counted);
  }
  return input;
}

SampledLoop::Entry SampledLoop::entry(Disturbance disturbance) const {
  Entry entry;
  entry.steady.assign(size_, Interval(0.0));
  entry.spread = entry.steady;
  switch (disturbance) {
    case Disturbance::gap: {
      entry.of_position = alpha_;
      entry.of_counted = beta_;
      const Interval rate = lead_ / plant_.inertia;
      entry.weight = plant_.over(period_).duration;
      entry.steady[position] = rate;
      entry.steady[momentum] = -(plant_.friction * rate);
      entry.rate = abs(rate);
      entry.on_load = share_;
      entry.on_motor = 1.0 - share_;
      break;
    }
    case Disturbance::torque_on_motor:
    case Disturbance::torque_on_load: {
      // (1 − e^{−fθ})/F and e^{−fθ} from θ before the tick: monotonic, so that ∫|e·K| exceeds
      // |∫e·K| by at most half a period times the whole change.
      const Passage over = plant_.over(period_);
      entry.steady[position] = over.position_of_torque;
      entry.steady[momentum] = over.duration;
      entry.spread[position] = 0.5 * period_ * over.position_of_speed;
      entry.spread[momentum] = -(0.5 * period_ * over.decrease);
      entry.torque = 1.0;
      break;
    }
    case Disturbance::position_reading:
      entry.of_position = 1.0;
      break;
    case Disturbance::speed_reading:
      entry.of_counted = 1.0;
      break;
    case Disturbance::both_readings:
      entry.of_position = 1.0;
      entry.of_counted = 1.0;
      break;
  }
  entry.tick = tick_input(entry.of_position, entry.of_counted);
  return entry;
}

/// The largest |form| at a tick, but for what acts from then on.
Interval SampledLoop::largest(const Form& form, const Entry& entry) const {
  const Interval straight =
      form.of_reading.position * entry.of_position + form.of_reading.counted * entry.of_counted;
  return abs(straight) + motion_->impulse_norm(entry.tick, form.of_state) +
         entry.weight * motion_->impulse_norm(entry.steady, form.of_state) +
         motion_->impulse_norm(entry.spread, form.of_state);
}

SampledLoop::Extent SampledLoop::extent(const Entry& entry) const {
  Extent extent;
  for (const Segment& segment : segments_) {
    const Passage since_tick = plant_.over(segment.from);
    extent.at_ends =
        max(extent.at_ends, largest(segment.start, entry) + entry.rate * since_tick.duration +
                                entry.torque * since_tick.position_of_torque);
    // ∫e^{−fθ} bends downwards, ∫∫e^{−fθ} upwards.
    const Interval bend =
        largest(segment.acceleration, entry) + entry.rate * plant_.friction / plant_.inertia;
    extent.bend = max(extent.bend, square(segment.length) / 8.0 * bend);
  }
  return extent;
}

LoopGain SampledLoop::gain(Disturbance disturbance) const {
  const Entry entry = this->entry(disturbance);
  const Extent extent = this->extent(entry);
  const Interval of_z = extent.at_ends + extent.bend;
  return {.load = (of_z + abs(entry.on_load)).high,
          .motor = (of_z + abs(entry.on_motor)).high,
          .effort = largest(asked_, entry).high};
}

}  // namespace

bool uses_speed(const LinearController& controller) {
  return controller.direct[2] != 0.0 ||
         std::any_of(controller.input_matrix.begin(), controller.input_matrix.end(),
                     [](const std::vector<double>& row) { return row[2] != 0.0; });
}

std::unique_ptr<DisturbedLoop> sampled_loop(const ReducedDrive& drive) {
  auto loop = std::make_unique<SampledLoop>(drive);
  if (!loop->prove()) return nullptr;
  return loop;
}

}  // namespace gearlash
