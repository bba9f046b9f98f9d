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

#include "base/lists.hpp"
#include "model/stepped_drive.hpp"
#include "numeric/decaying_motion.hpp"
#include "question/loop/ceiling/loop_gain.hpp"

namespace gearlash {
namespace {

/// Of the numbers at a tick, and of what is read there.
using Form = LinearForm<Interval>;

/// What acts between the ticks, as it has become by the next: vectors whose norms, times their
/// weights, have the integral as their sum.
struct Spread {
  std::vector<IntervalVector> vectors{};
  std::vector<Interval> weights{};
};

/// A disturbance, and how it acts on the plant all the time; not at all if empty.
struct Entry {
  Disturbance disturbance;
  IntervalVector acting{};
};

/// Φ − 1.
IntervalMatrix changes_of(const LinearSystem<Interval>& step) {
  const IntervalMatrix flow = flow_of(step);
  return flow - IntervalMatrix::Identity(flow.rows(), flow.cols());
}

class SampledLoop : public DisturbedLoop {
 public:
  explicit SampledLoop(const LinearDrive<Interval>& drive)
      : drive_(drive), plant_(drive.plant()), flow_(flow_of(plant_)) {}
  bool prove();
  LoopGain gain(const Disturbance& disturbance) override;
  StartGain start_gain(StartOutput output) override;
  bool reads_gap_speed() const override {
    return drive_.uses_speed() && !drive_.counts &&
           !is_exactly(plant_.speed[LinearInput::gap_speed], 0.0);
  }
  Interval gap_acceleration_per_speed() const override {
    return (*plant_.gap_acceleration)[LinearInput::gap_speed];
  }

 private:
  Form combination(const IntervalVector& row, const std::vector<Form>& states) const {
    return gearlash::combination(row, states, size());
  }
  std::size_t size() const { return at_ticks_.step.size(); }
  IntervalMatrix changes() const { return changes_of(at_ticks_.step); }

  Entry entry(const Disturbance& disturbance) const;
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
  Track track(const Form& output, const Entry& entry) const;
  Extent extent(const Track& track, const Interval* sizes) const;
  double peak(const IntervalVector& start) const;

  LinearDrive<Interval> drive_;
  LinearSystem<Interval> plant_;
  IntervalMatrix flow_;  ///< of the plant
  SteppedDrive<Interval> at_ticks_ = stepped_drive(drive_, TorqueInput::requested);
  int spread_parts_ = 1;
  std::optional<DecayingMotion> motion_;
};

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
  const Entry gap = entry({LinearInput::gap});
  const Track load = track(plant_.load, gap);
  const Extent extent = this->extent(load, largest(load.forms, gap).data());
  const Spread spread = this->spread(gap.acting);
  const Interval curvature = norms(spread.vectors[1], {load.forms.front()}).front();
  spread_parts_ = parts(spread.weights[1] * curvature, extent.at_ends);
  if (const int needed = parts(extent.bend, extent.at_ends); needed > 1) {
    at_ticks_ = stepped_drive(drive_, TorqueInput::requested, needed);
  }
  return true;
}

Entry SampledLoop::entry(const Disturbance& disturbance) const {
  Entry entry{.disturbance = disturbance, .acting = at_once(plant_.slopes, disturbance)};
  const auto is_nothing = [](const Interval& number) { return is_exactly(number, 0.0); };
  if (all_of(entry.acting, is_nothing)) entry.acting.clear();
  return entry;
}

/// ∫Σ|c Φᵏ e^{Aθ} b| over a period: the trapezoidal rule over `spread_parts_` parts of length δ,
/// and δ²/8 ∫Σ|c Φᵏ e^{Aθ} A² b|. Of several parts the latter is bounded state by state.
Spread SampledLoop::spread(const IntervalVector& acting) const {
  Spread spread;
  const Interval length = drive_.period / Interval(static_cast<double>(spread_parts_));
  const Interval weight = square(length) / 8.0 * length;
  const IntervalMatrix over = enclosed_exponential(length * flow_);
  const IntervalMatrix within = enclosed_exponential(Interval(0.0, length.high) * flow_);
  const auto add = [&](IntervalVector vector, const Interval& share) {
    vector.resize(size(), Interval(0.0));
    spread.vectors.push_back(std::move(vector));
    spread.weights.push_back(share);
  };
  IntervalVector here = acting;
  IntervalVector bent = times(flow_, times(flow_, acting));
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
  return motion_->impulse_norms(input, of_each(forms, &Form::of_state));
}

/// The largest |form| of each, but for what acts since the tick.
std::vector<Interval> SampledLoop::largest(const std::vector<Form>& forms,
                                           const Entry& entry) const {
  std::vector<Interval> result = norms(at_once(at_ticks_.step.slopes, entry.disturbance), forms);
  for (std::size_t i = 0; i < forms.size(); ++i) {
    result[i] = result[i] + abs(at_once(forms[i], entry.disturbance));
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
SampledLoop::Track SampledLoop::track(const Form& output, const Entry& entry) const {
  const Interval& of_torque = output[LinearInput::torque];
  Track track;
  std::vector<Form> ends;
  std::vector<Interval> since_tick_at_ends;
  Interval since_tick = 0.0;  // ∫|c e^{Aθ} b| up to the segment's start
  const IntervalVector second = times(output.of_state, flow_);
  for (const HeldPart<Interval>& segment : at_ticks_.parts) {
    const Interval within(0.0, segment.length.high);
    track.forms.push_back(combination(output.of_state, segment.states) +
                          of_torque * segment.torque);
    track.forms.push_back(
        combination(times(second, enclosed_exponential(within * flow_)), segment.slopes));
    Interval slope = 0.0;
    Interval bend = 0.0;
    if (!entry.acting.empty()) {
      const IntervalVector acted =
          times(enclosed_exponential((segment.from + within) * flow_), entry.acting);
      slope = abs(dot(output.of_state, acted));
      bend = abs(dot(second, acted));
    }
    track.since_tick.push_back(since_tick);
    track.bends_since_tick.push_back(bend);
    since_tick = since_tick + segment.length * slope;
    if (is_exactly(of_torque, 0.0) || segment.ends.empty()) continue;
    ends.push_back(combination(output.of_state, segment.ends) + of_torque * segment.torque);
    since_tick_at_ends.push_back(since_tick);
  }
  add_all(track.forms, ends);
  add_all(track.since_tick, since_tick_at_ends);
  return track;
}

/// `sizes`: of the track's forms.
SampledLoop::Extent SampledLoop::extent(const Track& track, const Interval* sizes) const {
  Extent extent;
  const std::vector<HeldPart<Interval>>& segments = at_ticks_.parts;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    extent.at_ends = max(extent.at_ends, sizes[2 * i] + track.since_tick[i]);
    extent.bend = max(extent.bend, square(segments[i].length) / 8.0 *
                                       (sizes[2 * i + 1] + track.bends_since_tick[i]));
  }
  for (std::size_t i = segments.size(); i < track.since_tick.size(); ++i) {
    extent.at_ends = max(extent.at_ends, sizes[segments.size() + i] + track.since_tick[i]);
  }
  return extent;
}

LoopGain SampledLoop::gain(const Disturbance& disturbance) {
  const Entry entry = this->entry(disturbance);
  std::vector<const Form*> outputs{&plant_.load};
  // Rigid faces: both shafts are one state, from which the gap parts them at once.
  const bool is_rigid = plant_.gap_acceleration.has_value();
  if (!is_rigid) outputs.push_back(&plant_.motor);
  if (reads_gap_speed()) outputs.push_back(&*plant_.gap_acceleration);
  std::vector<Form> forms{at_ticks_.step.effort};
  std::vector<Track> tracks;
  for (const Form* output : outputs) {
    tracks.push_back(track(*output, entry));
    add_all(forms, tracks.back().forms);
  }
  const std::vector<Interval> sizes = largest(forms, entry);
  // The gap's speed acts on its acceleration by a slope of its own.
  const bool has_slope_of_its_own = disturbance.front() == LinearInput::gap_speed;
  const auto bound = [&](std::size_t which, const Form& output) {
    std::size_t before = 1;  // forms, of the effort and of the tracks before
    for (std::size_t i = 0; i < which; ++i) before += tracks[i].forms.size();
    const Extent extent = this->extent(tracks[which], &sizes[before]);
    const Interval now = has_slope_of_its_own ? Interval(0.0) : at_once(output, disturbance);
    return (extent.at_ends + extent.bend + abs(now)).high;
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
  const Interval twice = abs(dot(at_ticks_.step.effort.of_state, start)) +
                         motion_->impulse_norm(change, at_ticks_.step.effort.of_state);
  return (0.5 * twice).high;
}

/// At a tick, as if all had been at rest, or had moved evenly, before it.
StartGain SampledLoop::start_gain(StartOutput output) {
  if (output != StartOutput::effort) return {};
  const auto extended = [&](IntervalVector start) {
    const Interval counted = dot(plant_.counted.of_state, start);
    start.resize(size(), Interval(0.0));
    if (drive_.counts) start[at_ticks_.last_counted] = counted;
    return start;
  };
  IntervalVector moving = extended(plant_.start_of_speed);
  if (drive_.counts) moving[at_ticks_.last_counted] = -drive_.period;
  IntervalVector gap = extended(plant_.start_of_gap);
  if (drive_.counts)
    gap[at_ticks_.last_counted] = gap[at_ticks_.last_counted] + plant_.counted[LinearInput::gap];
  return {.of_position = peak(extended(plant_.start_of_position)),
          .of_speed = peak(moving),
          .of_gap = peak(gap)};
}

}  // namespace

std::unique_ptr<DisturbedLoop> sampled_loop(const LinearDrive<Interval>& drive) {
  auto loop = std::make_unique<SampledLoop>(drive);
  if (!loop->prove()) return nullptr;
  return loop;
}

std::unique_ptr<DisturbedLoop> disturbed_loop(const LinearDrive<Interval>& drive) {
  return drive.holds.empty() ? continuous_loop(drive) : sampled_loop(drive);
}

bool loop_decays(const LinearDrive<Interval>& drive) {
  const auto motion =
      drive.holds.empty()
          ? DecayingMotion::of(flow_of(drive.loop()), TimeKind::continuous)
          : DecayingMotion::of(changes_of(stepped_drive(drive, TorqueInput::requested).step),
                               TimeKind::stepwise);
  return motion.has_value();
}

}  // namespace gearlash
