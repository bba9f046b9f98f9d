// A sampled controller, connected to the plant.
//
// Between events of the computer the plant moves with a held torque. At tick k the controller reads
// the gap u(t_k). So the numbers at the ticks obey ξ⁺ = Φ ξ + Γ u(t_k) + ∫ K(θ) u, with
// K(θ) = e^{Aθ} b from θ before the next tick. The largest |c ξ| at the ticks that |u| ≤ 1 can
// cause is Σ|c Φᵏ Γ| + ∫Σ|c Φᵏ K(θ)| dθ. The integral of each |f| exceeds that of the chord by at
// most δ²/8 ∫|f″| over a part of length δ. Between ticks an output bends by at most its second
// derivative: it exceeds the line between the ends of a segment of length h by at most h²/8 of
// that.
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "analysis/ceiling/held_torques.hpp"
#include "analysis/ceiling/loop_gain.hpp"
#include "analysis/ceiling/plant.hpp"
#include "numeric/decaying_motion.hpp"

namespace gearlash {
namespace {

using drive::LinearController;
using drive::ReducedDrive;

/// What is read at a tick.
struct SensedReading {
  Interval position{0.0};
  Interval counted{0.0};     ///< the position whose differences are the speed
  Interval tachometer{0.0};  ///< the speed
  Interval reference{0.0};   ///< that the position follows
};

/// A number as a linear form of the state at a tick and of what is read there.
struct Form {
  IntervalVector of_state{};
  SensedReading of_reading{};
};

Form operator+(Form a, const Form& b) {
  a.of_state = added(std::move(a.of_state), b.of_state);
  a.of_reading.position = a.of_reading.position + b.of_reading.position;
  a.of_reading.counted = a.of_reading.counted + b.of_reading.counted;
  a.of_reading.tachometer = a.of_reading.tachometer + b.of_reading.tachometer;
  a.of_reading.reference = a.of_reading.reference + b.of_reading.reference;
  return a;
}

Form operator*(const Interval& factor, Form form) {
  form.of_state = scaled(factor, std::move(form.of_state));
  form.of_reading.position = factor * form.of_reading.position;
  form.of_reading.counted = factor * form.of_reading.counted;
  form.of_reading.tachometer = factor * form.of_reading.tachometer;
  form.of_reading.reference = factor * form.of_reading.reference;
  return form;
}

Interval product(const SensedReading& form, const SensedReading& read) {
  return form.position * read.position + form.counted * read.counted +
         form.tachometer * read.tachometer + form.reference * read.reference;
}

/// The times of a tick in which one torque is held.
struct Hold {
  Interval from;  ///< s after the tick
  Interval time;
  Form torque;
};

/// A part of a hold over which outputs bend little.
struct Segment {
  Interval from;
  Interval length;
  std::vector<Form> states;  ///< of the plant, at its start
  std::vector<Form> slopes;  ///< x′ at its start
  std::vector<Form> ends;    ///< of the plant, at its end, where the torque jumps; else none
  Form torque;
};

/// A disturbance's way into the loop.
struct Entry {
  SensedReading read{};
  IntervalVector acting{};  ///< on the plant, all the time; none if empty
  Disturbance disturbance;
};

/// What acts between the ticks, as it has become by the next: vectors whose norms, times their
/// weights, have the integral as their sum.
struct Spread {
  std::vector<IntervalVector> vectors{};
  std::vector<Interval> weights{};
};

class SampledLoop : public DisturbedLoop {
 public:
  explicit SampledLoop(const EnclosedDrive& drive);
  bool decays() const { return DecayingMotion::of(changes(), TimeKind::stepwise).has_value(); }
  bool prove();
  LoopGain gain(Disturbance disturbance) override;
  StartGain start_gain(StartOutput output) override;
  bool reads_gap_speed() const override {
    const Interval& share = plant_.speed.of_gap_speed;
    return uses_speed_ && !counts_ && (share.low != 0.0 || share.high != 0.0);
  }
  Interval gap_acceleration_per_speed() const override {
    return plant_.gap_acceleration->of_gap_speed;
  }

 private:
  Form state(std::size_t index) const {
    Form form = nothing();
    form.of_state[index] = 1.0;
    return form;
  }
  Form nothing() const { return {IntervalVector(size_, Interval(0.0)), {}}; }
  Form combination(const IntervalVector& row, const std::vector<Form>& states) const;
  Form reading(const Interval& of_position, const Interval& of_speed) const;
  std::vector<Hold> holds() const;
  void plan(int parts);
  void pass(const Hold& hold, int parts, std::vector<Form>& states);
  IntervalMatrix changes() const;

  Entry entry(Disturbance disturbance) const;
  IntervalVector tick_input(const SensedReading& read) const;
  Spread spread(const IntervalVector& acting) const;
  std::vector<Interval> norms(const IntervalVector& input, const std::vector<Form>& forms) const;
  std::vector<Interval> largest(const std::vector<Form>& forms, const Entry& entry) const;
  struct Extent {
    Interval at_ends{0.0};  ///< the largest at the ends of the segments
    Interval bend{0.0};     ///< by how much more it may bend between them
  };
  struct Track {
    std::vector<Form> forms;           ///< by segments two, then the ends of holds
    std::vector<Interval> since_tick;  ///< what has acted since, by segments and ends
    std::vector<Interval> bends_since_tick;
  };
  Track track(const PlantOutput& output, const Entry& entry) const;
  Extent extent(const Track& track, const Interval* sizes) const;
  double peak(const IntervalVector& start) const;

  Plant plant_;
  std::vector<HeldTorque> held_;
  Interval period_;
  EnclosedController controller_;
  bool uses_speed_ = false;
  bool counts_ = false;  ///< the speed is a difference of positions, and the last one is kept
  std::size_t first_controller_state_ = 0;
  std::size_t last_reading_ = 0;
  std::size_t queue_ = 0;  ///< torques that wait, the newest first
  std::size_t waiting_ = 0;
  std::size_t size_ = 0;
  Form asked_;              ///< torque worked out at the tick
  std::vector<Form> next_;  ///< all numbers at the next tick
  std::vector<Segment> segments_;
  int spread_parts_ = 1;
  std::optional<DecayingMotion> motion_;
};

SampledLoop::SampledLoop(const EnclosedDrive& drive)
    : plant_(plant_of(drive)),
      held_(held_torques(*drive.form().sampling)),
      period_(datum(drive.form().sampling->period)),
      controller_(drive.made([](const ReducedDrive& d) {
        return drive::sampled_controller(d.controller, *d.sampling);
      })),
      uses_speed_(controller_.any_of(&uses_speed)),
      counts_(uses_speed_ && drive.form().sampling->speed_by_differences),
      first_controller_state_(plant_.size()) {
  plan(1);
}

/// Chooses how finely ticks are divided, so that what is not seen is a small share of the gain.
bool SampledLoop::prove() {
  motion_ = DecayingMotion::of(changes(), TimeKind::stepwise);
  if (!motion_) return false;
  constexpr double unseen = 2e-3;  // share of the gain
  constexpr double most_parts = 24.0;
  const auto parts = [&](const Interval& unseen_now, const Interval& whole) {
    const double needed = std::sqrt(unseen_now.high / (unseen * whole.high));
    return needed > 1.0 ? static_cast<int>(std::ceil(std::min(needed, most_parts))) : 1;
  };
  const Entry gap = entry(Disturbance::gap);
  const Track load = track(plant_.load, gap);
  const Extent extent = this->extent(load, largest(load.forms, gap).data());
  const Spread spread = this->spread(gap.acting);
  const Interval curvature = norms(spread.vectors[1], {load.forms.front()}).front();
  spread_parts_ = parts(spread.weights[1] * curvature, extent.at_ends);
  if (const int needed = parts(extent.bend, extent.at_ends); needed > 1) plan(needed);
  return true;
}

Form SampledLoop::combination(const IntervalVector& row, const std::vector<Form>& states) const {
  Form form = nothing();
  for (std::size_t i = 0; i < row.size(); ++i) form = std::move(form) + row[i] * states[i];
  return form;
}

/// Σ of what is read: a position and a speed, from a tachometer or from the difference to the last
/// position.
Form SampledLoop::reading(const Interval& of_position, const Interval& of_speed) const {
  Form form = nothing();
  const auto add = [&](const Interval& weight, const PlantOutput& output) {
    for (std::size_t i = 0; i < plant_.size(); ++i) {
      form.of_state[i] = form.of_state[i] + weight * output.of_state[i];
    }
  };
  add(of_position, plant_.position);
  form.of_reading.position = of_position;
  if (counts_) {
    const Interval per_angle = of_speed / period_;
    add(per_angle, plant_.counted);
    form.of_state[last_reading_] = form.of_state[last_reading_] - per_angle;
    form.of_reading.counted = per_angle;
  } else {
    add(of_speed, plant_.speed);
    form.of_reading.tachometer = of_speed;
  }
  return form;
}

std::vector<Hold> SampledLoop::holds() const {
  std::vector<Hold> holds;
  for (const HeldTorque& held : held_) {
    const Interval from = datum(held.from);
    const Interval until = datum(held.until);
    holds.push_back({from, held.from == 0.0 ? until : not_negative(until - from),
                     held.age == 0 ? asked_ : state(queue_ + held.age - 1)});
  }
  return holds;
}

/// The plant over a time with one torque, as segments of equal length.
void SampledLoop::pass(const Hold& hold, int parts, std::vector<Form>& states) {
  const Interval length = hold.time / Interval(static_cast<double>(parts));
  const LinearPassage over = passage(plant_.flow, {plant_.torque}, length);
  for (int i = 0; i < parts; ++i) {
    std::vector<Form> slopes;
    std::vector<Form> next;
    for (std::size_t k = 0; k < plant_.size(); ++k) {
      slopes.push_back(combination(plant_.flow.rows[k], states) + plant_.torque[k] * hold.torque);
      next.push_back(combination(over.flow.rows[k], states) + over.of_inputs[0][k] * hold.torque);
    }
    segments_.push_back({.from = hold.from + static_cast<double>(i) * length,
                         .length = length,
                         .states = std::move(states),
                         .slopes = std::move(slopes),
                         .ends = {},
                         .torque = hold.torque});
    states = std::move(next);
  }
  segments_.back().ends = states;
}

/// What happens from one tick to the next, in segments: `parts` for each torque.
void SampledLoop::plan(int parts) {
  segments_.clear();
  waiting_ = held_.front().age;
  last_reading_ = first_controller_state_ + controller_.form().order();
  queue_ = last_reading_ + (counts_ ? 1 : 0);
  size_ = queue_ + waiting_;

  const std::size_t order = controller_.form().order();
  const auto direct = [&](std::size_t i) {
    return controller_.number([i](const LinearController& c) { return c.direct[i]; });
  };
  const auto input = [&](std::size_t i, std::size_t j) {
    return controller_.number([i, j](const LinearController& c) { return c.input_matrix[i][j]; });
  };
  asked_ = reading(direct(1), direct(2));
  asked_.of_reading.reference =
      of_both(controller_, [](const LinearController& c) -> auto& { return c.direct; });
  for (std::size_t i = 0; i < order; ++i) {
    asked_.of_state[first_controller_state_ + i] =
        controller_.number([i](const LinearController& c) { return c.output[i]; });
  }
  std::vector<Form> states;
  for (std::size_t i = 0; i < plant_.size(); ++i) states.push_back(state(i));
  for (const Hold& hold : holds()) pass(hold, parts, states);

  next_ = std::move(states);
  for (std::size_t i = 0; i < order; ++i) {
    Form next = reading(input(i, 1), input(i, 2));
    next.of_reading.reference =
        of_both(controller_, [i](const LinearController& c) -> auto& { return c.input_matrix[i]; });
    for (std::size_t j = 0; j < order; ++j) {
      next.of_state[first_controller_state_ + j] =
          controller_.number([i, j](const LinearController& c) { return c.state_matrix[i][j]; });
    }
    next_.push_back(std::move(next));
  }
  if (counts_) {
    Form last = nothing();
    std::copy(plant_.counted.of_state.begin(), plant_.counted.of_state.end(),
              last.of_state.begin());
    last.of_reading.counted = 1.0;
    next_.push_back(std::move(last));
  }
  for (std::size_t i = 0; i < waiting_; ++i) {
    next_.push_back(i == 0 ? asked_ : state(queue_ + i - 1));
  }
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

/// What a reading adds to the numbers at the next tick.
IntervalVector SampledLoop::tick_input(const SensedReading& read) const {
  IntervalVector input;
  for (const Form& next : next_) input.push_back(gearlash::product(next.of_reading, read));
  return input;
}

Entry SampledLoop::entry(Disturbance disturbance) const {
  Entry entry{.disturbance = disturbance};
  switch (disturbance) {
    case Disturbance::gap:
      entry.read = {plant_.position.of_gap, plant_.counted.of_gap, plant_.speed.of_gap};
      entry.acting = plant_.gap;
      break;
    case Disturbance::torque_on_motor:
      entry.acting = plant_.torque_on_motor;
      break;
    case Disturbance::torque_on_load:
      entry.acting = plant_.torque_on_load;
      break;
    case Disturbance::position_reading:
      entry.read.position = 1.0;
      break;
    case Disturbance::speed_reading:
      entry.read.counted = 1.0;
      break;
    case Disturbance::both_readings:
      entry.read.position = 1.0;
      entry.read.counted = 1.0;
      break;
    case Disturbance::gap_speed:
      entry.read.tachometer = plant_.speed.of_gap_speed;
      break;
    case Disturbance::reference:
      entry.read.reference = 1.0;
      break;
  }
  return entry;
}

/// ∫Σ|c Φᵏ e^{Aθ} b| over a period: the trapezoidal rule over `spread_parts_` parts of length δ,
/// and δ²/8 ∫Σ|c Φᵏ e^{Aθ} A² b|. Of several parts the latter is bounded state by state.
Spread SampledLoop::spread(const IntervalVector& acting) const {
  Spread spread;
  const Interval length = period_ / Interval(static_cast<double>(spread_parts_));
  const Interval weight = square(length) / 8.0 * length;
  const IntervalMatrix over = passage(plant_.flow, {}, length).flow;
  const IntervalMatrix within = passage(plant_.flow, {}, Interval(0.0, length.high)).flow;
  const auto add = [&](IntervalVector vector, const Interval& share) {
    vector.resize(size_, Interval(0.0));
    spread.vectors.push_back(std::move(vector));
    spread.weights.push_back(share);
  };
  IntervalVector here = acting;
  IntervalVector bent = times(plant_.flow, times(plant_.flow, acting));
  IntervalVector bends(plant_.size(), Interval(0.0));
  add(here, 0.5 * length);
  for (int i = 1; i <= spread_parts_; ++i) {
    const IntervalVector bend = times(within, bent);
    for (std::size_t k = 0; k < bends.size(); ++k) bends[k] = bends[k] + weight * abs(bend[k]);
    if (spread_parts_ == 1) add(bend, weight);
    here = times(over, here);
    bent = times(over, bent);
    add(here, i == spread_parts_ ? 0.5 * length : length);
  }
  if (spread_parts_ == 1) return spread;
  for (std::size_t k = 0; k < bends.size(); ++k) {
    IntervalVector unit(plant_.size(), Interval(0.0));
    unit[k] = 1.0;
    add(unit, bends[k]);
  }
  return spread;
}

std::vector<Interval> SampledLoop::norms(const IntervalVector& input,
                                         const std::vector<Form>& forms) const {
  std::vector<IntervalVector> rows;
  for (const Form& form : forms) rows.push_back(form.of_state);
  return motion_->impulse_norms(input, rows);
}

/// The largest |form| of each, but for what acts since the tick.
std::vector<Interval> SampledLoop::largest(const std::vector<Form>& forms,
                                           const Entry& entry) const {
  std::vector<Interval> result = norms(tick_input(entry.read), forms);
  for (std::size_t i = 0; i < forms.size(); ++i) {
    result[i] = result[i] + abs(gearlash::product(forms[i].of_reading, entry.read));
  }
  if (entry.acting.empty()) return result;
  const Spread spread = this->spread(entry.acting);
  for (std::size_t k = 0; k < spread.vectors.size(); ++k) {
    const std::vector<Interval> part = norms(spread.vectors[k], forms);
    for (std::size_t i = 0; i < forms.size(); ++i) {
      result[i] = result[i] + spread.weights[k] * part[i];
    }
  }
  return result;
}

/// An output followed over a tick: two forms for each segment, its start and its bend. One that the
/// torque moves at once jumps with it: then also the end of each hold, before the torque changes.
SampledLoop::Track SampledLoop::track(const PlantOutput& output, const Entry& entry) const {
  Track track;
  std::vector<Form> ends;
  std::vector<Interval> since_tick_at_ends;
  Interval since_tick = 0.0;  // ∫|c e^{Aθ} b| up to the segment's start
  const IntervalVector second = times(output.of_state, plant_.flow);
  for (const Segment& segment : segments_) {
    const Interval within(0.0, segment.length.high);
    track.forms.push_back(combination(output.of_state, segment.states) +
                          output.of_torque * segment.torque);
    track.forms.push_back(
        combination(times(second, passage(plant_.flow, {}, within).flow), segment.slopes));
    Interval slope = 0.0;
    Interval bend = 0.0;
    if (!entry.acting.empty()) {
      const IntervalVector acted =
          times(passage(plant_.flow, {}, segment.from + within).flow, entry.acting);
      slope = abs(dot(output.of_state, acted));
      bend = abs(dot(second, acted));
    }
    track.since_tick.push_back(since_tick);
    track.bends_since_tick.push_back(bend);
    since_tick = since_tick + segment.length * slope;
    if (output.of_torque.low == 0.0 && output.of_torque.high == 0.0) continue;
    if (segment.ends.empty()) continue;
    ends.push_back(combination(output.of_state, segment.ends) + output.of_torque * segment.torque);
    since_tick_at_ends.push_back(since_tick);
  }
  track.forms.insert(track.forms.end(), ends.begin(), ends.end());
  track.since_tick.insert(track.since_tick.end(), since_tick_at_ends.begin(),
                          since_tick_at_ends.end());
  return track;
}

/// `sizes`: of the track's forms.
SampledLoop::Extent SampledLoop::extent(const Track& track, const Interval* sizes) const {
  Extent extent;
  for (std::size_t i = 0; i < segments_.size(); ++i) {
    extent.at_ends = max(extent.at_ends, sizes[2 * i] + track.since_tick[i]);
    extent.bend = max(extent.bend, square(segments_[i].length) / 8.0 *
                                       (sizes[2 * i + 1] + track.bends_since_tick[i]));
  }
  for (std::size_t i = segments_.size(); i < track.since_tick.size(); ++i) {
    extent.at_ends = max(extent.at_ends, sizes[segments_.size() + i] + track.since_tick[i]);
  }
  return extent;
}

LoopGain SampledLoop::gain(Disturbance disturbance) {
  const Entry entry = this->entry(disturbance);
  std::vector<const PlantOutput*> outputs{&plant_.load};
  // Rigid faces: both shafts are one state, from which the gap parts them at once.
  const bool is_rigid = plant_.gap_acceleration.has_value();
  if (!is_rigid) outputs.push_back(&plant_.motor);
  if (reads_gap_speed()) outputs.push_back(&*plant_.gap_acceleration);
  std::vector<Form> forms{asked_};
  std::vector<Track> tracks;
  for (const PlantOutput* output : outputs) {
    tracks.push_back(track(*output, entry));
    forms.insert(forms.end(), tracks.back().forms.begin(), tracks.back().forms.end());
  }
  const std::vector<Interval> sizes = largest(forms, entry);
  const auto bound = [&](std::size_t which, const PlantOutput& output) {
    std::size_t before = 1;  // forms, of the effort and of the tracks before
    for (std::size_t i = 0; i < which; ++i) before += tracks[i].forms.size();
    const Extent extent = this->extent(tracks[which], &sizes[before]);
    Interval at_once = 0.0;
    if (disturbance == Disturbance::gap) at_once = output.of_gap;
    if (disturbance == Disturbance::torque_on_motor) at_once = output.of_torque_on_motor;
    if (disturbance == Disturbance::torque_on_load) at_once = output.of_torque_on_load;
    return (extent.at_ends + extent.bend + abs(at_once)).high;
  };
  LoopGain gain{.load = bound(0, plant_.load),
                .motor = bound(is_rigid ? 0 : 1, plant_.motor),
                .effort = sizes[0].high};
  if (reads_gap_speed()) gain.gap_acceleration = bound(1, *plant_.gap_acceleration);
  return gain;
}

/// |h| ≤ (|h(0)| + Σ|h(k + 1) − h(k)|)/2 for every h that tends to 0.
double SampledLoop::peak(const IntervalVector& start) const {
  IntervalVector change = times(changes(), start);
  const Interval twice =
      abs(dot(asked_.of_state, start)) + motion_->impulse_norm(change, asked_.of_state);
  return (0.5 * twice).high;
}

/// At a tick, as if all had been at rest, or had moved evenly, before it.
StartGain SampledLoop::start_gain(StartOutput output) {
  if (output != StartOutput::effort) return {};
  const auto extended = [&](IntervalVector start) {
    const Interval counted = dot(plant_.counted.of_state, start);
    start.resize(size_, Interval(0.0));
    if (counts_) start[last_reading_] = counted;
    return start;
  };
  IntervalVector moving = extended(plant_.start_of_speed);
  if (counts_) moving[last_reading_] = -period_;
  IntervalVector gap = extended(plant_.start_of_gap);
  if (counts_) gap[last_reading_] = gap[last_reading_] + plant_.counted.of_gap;
  return {.of_position = peak(extended(plant_.start_of_position)),
          .of_speed = peak(moving),
          .of_gap = peak(gap)};
}

}  // namespace

bool uses_speed(const LinearController& controller) {
  return controller.direct[2] != 0.0 ||
         std::any_of(controller.input_matrix.begin(), controller.input_matrix.end(),
                     [](const std::vector<double>& row) { return row[2] != 0.0; });
}

bool sampled_loop_decays(const ReducedDrive& drive) { return SampledLoop(drive).decays(); }

std::unique_ptr<DisturbedLoop> sampled_loop(const EnclosedDrive& drive) {
  auto loop = std::make_unique<SampledLoop>(drive);
  if (!loop->prove()) return nullptr;
  return loop;
}

}  // namespace gearlash
