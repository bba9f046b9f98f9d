#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "gearlash/hybrid/first_exit.hpp"
#include "gearlash/hybrid/hybrid_trajectory.hpp"
#include "prepared_flow.hpp"

namespace gearlash::hybrid {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double epsilon = std::numeric_limits<double>::epsilon();
/// Rounding of a sum of products, as a share of the sum of their sizes.
constexpr double rounding = 16.0 * epsilon;

/// A guard as a sum over those numbers of the state that are in it, positive on its side.
struct PreparedGuard {
  struct Term {
    int number;
    double factor;
  };
  std::vector<Term> terms;
  double offset = 0.0;
  Direction direction = Direction::falling;

  explicit PreparedGuard(const Transition& transition) : direction(transition.direction) {
    const double sign = direction == Direction::rising ? -1.0 : 1.0;
    const AffineForm& guard = transition.guard;
    for (int i = 0; i < static_cast<int>(guard.normal.size()); ++i) {
      if (guard.normal[i] != 0.0) terms.push_back({i, sign * guard.normal[i]});
    }
    offset = sign * guard.offset;
  }
};

struct PreparedMode {
  PreparedFlow flow;
  std::vector<PreparedGuard> guards;

  explicit PreparedMode(const Mode& mode) : flow(mode.flow) {
    for (const Transition& transition : mode.transitions) guards.emplace_back(transition);
  }
};

/// A guard over a step, and what rounding and the remainder may add to it.
struct GuardSeries {
  std::vector<double> coefficients;
  std::vector<double> uncertainties;  ///< of each, by rounding
  double remainder = 0.0;
};

/// Where a guard is as a step begins.
enum class Side { inside, outside, on_it };

/// A guard's side at the start, and the series that is left when a start on its zero is divided
/// out.
struct Start {
  Side side = Side::inside;
  std::size_t order = 0;  ///< of the first derivative that is not 0
};

void require(const std::vector<std::string>& all) {
  if (all.empty()) return;
  std::string message;
  for (const std::string& one : all) message += (message.empty() ? "" : "\n") + one;
  throw std::invalid_argument(message);
}

std::vector<std::string> faults_of(const HybridSystem& system, const State& start,
                                   const SimulationOptions& options) {
  std::vector<std::string> all = faults(system);
  if (start.mode >= system.modes.size()) {
    all.push_back("start.mode: is " + std::to_string(start.mode) + ", must be one of " +
                  std::to_string(system.modes.size()) + " modes, from 0 on");
  }
  if (start.numbers.size() != system.size() || !start.numbers.allFinite()) {
    all.push_back("start.numbers: must be " + std::to_string(system.size()) + " finite numbers");
  }
  if (!std::isfinite(options.from) || !std::isfinite(options.until) ||
      options.until < options.from) {
    all.emplace_back("options.until: must be finite and at least options.from, which is too");
  }
  return all;
}

}  // namespace

class Simulation {
 public:
  Simulation(const HybridSystem& system, const State& start, const SimulationOptions& options)
      : system_(system), options_(options), state_(start), time_(options.from) {
    for (const Mode& mode : system.modes) {
      modes_.emplace_back(mode);
      trajectory_.flows_.push_back(mode.flow);
    }
    for (const Clock& clock : system.clocks) ticks_.push_back(first_tick(clock, options.from));
    trajectory_.start_time_ = options.from;
    trajectory_.end_time_ = options.from;
    noise_ = rounding * state_.numbers.cwiseAbs();
    enter_mode();
  }

  Trajectory run() {
    if (options_.event_limit == 0) stop(StopReason::event_limit);
    while (!stopped_) {
      if (fire_due_clocks()) continue;
      if (time_ >= options_.until) break;
      step();
    }
    trajectory_.end_time_ = time_;
    trajectory_.end_ = state_;
    return std::move(trajectory_);
  }

 private:
  // ---- clocks -----------------------------------------------------------------------------------

  struct Tick {
    double time;
    std::size_t count = 0;
  };

  /// The first one not before a time.
  static Tick first_tick(const Clock& clock, double from) {
    Tick tick{clock.period > 0.0    ? clock.first
              : clock.times.empty() ? (clock.first > 0.0 ? clock.first : infinity)
                                    : clock.times.front()};
    if (clock.period > 0.0 && tick.time < from) {
      tick.count = static_cast<std::size_t>((from - clock.first) / clock.period);
      tick.time = clock.first + static_cast<double>(tick.count) * clock.period;
    }
    while (tick.time < from) advance(clock, tick);
    return tick;
  }

  static void advance(const Clock& clock, Tick& tick) {
    ++tick.count;
    const auto count = static_cast<double>(tick.count);
    if (clock.period > 0.0) {
      tick.time = clock.first + count * clock.period;
    } else {
      tick.time = tick.count < clock.times.size() ? clock.times[tick.count] : infinity;
    }
  }

  double next_tick() const {
    double next = infinity;
    for (const Tick& tick : ticks_) next = std::min(next, tick.time);
    return next;
  }

  /// One clock that is due, if there is one.
  bool fire_due_clocks() {
    for (std::size_t i = 0; i < ticks_.size(); ++i) {
      if (ticks_[i].time > time_ || ticks_[i].time > options_.until) continue;
      const Clock& clock = system_.clocks[i];
      const std::size_t count = ticks_[i].count;
      const Vector* addition = count < clock.additions.size() ? &clock.additions[count] : nullptr;
      advance(clock, ticks_[i]);
      const std::vector<TimedTransition>& timed = system_.modes[state_.mode].timed;
      for (std::size_t k = 0; k < timed.size(); ++k) {
        if (timed[k].clock != i) continue;
        change(EventKind::timed, k, timed[k].reset, timed[k].target, timed[k].alternatives,
               addition);
        break;
      }
      return true;
    }
    return false;
  }

  // ---- guards -----------------------------------------------------------------------------------

  const PreparedMode& mode() const { return modes_[state_.mode]; }

  GuardSeries series_of(const PreparedGuard& guard, double sign) const {
    GuardSeries result;
    const auto count = static_cast<std::size_t>(series_.order()) + 1;
    result.coefficients.resize(count);
    result.uncertainties.resize(count);
    for (std::size_t k = 0; k < count; ++k) {
      const double* term = series_.term(static_cast<int>(k));
      double sum = k == 0 ? guard.offset : 0.0;
      const double* term_rounding = series_.rounding(static_cast<int>(k));
      double uncertainty = rounding * std::abs(sum);
      for (const auto& [number, factor] : guard.terms) {
        sum += factor * term[number];
        uncertainty +=
            std::abs(factor) * (rounding * std::abs(term[number]) + term_rounding[number]);
      }
      result.coefficients[k] = sign * sum;
      result.uncertainties[k] = uncertainty;
    }
    for (const auto& [number, factor] : guard.terms) {
      result.remainder += std::abs(factor) * series_.remainder() * flow_->weight(number);
    }
    return result;
  }

  static Start start_of(const GuardSeries& series) {
    for (std::size_t k = 0; k < series.coefficients.size(); ++k) {
      if (std::abs(series.coefficients[k]) <= series.uncertainties[k]) continue;
      return {series.coefficients[k] > 0.0 ? Side::inside : Side::outside, k};
    }
    return {Side::on_it, 0};
  }

  /// When a guard leaves its side within the step, as a share of it.
  FirstExit exit_of(std::size_t index) {
    const PreparedGuard& guard = mode().guards[index];
    double& sign = signs_[index];
    GuardSeries series = series_of(guard, sign == 0.0 ? 1.0 : sign);
    const Start start = start_of(series);
    if (start.side == Side::on_it) return {};
    if (sign == 0.0) {  // either side: the one that it is on first is its own
      sign = start.side == Side::inside ? 1.0 : -1.0;
      if (sign < 0.0) series = series_of(guard, sign);
    } else if (start.side == Side::outside) {
      return {0.0, std::nullopt};
    }
    series.coefficients.erase(
        series.coefficients.begin(),
        series.coefficients.begin() + static_cast<std::ptrdiff_t>(start.order));
    double uncertainty = series.remainder;
    for (std::size_t k = start.order; k < series.uncertainties.size(); ++k) {
      uncertainty += series.uncertainties[k];
    }
    return first_exit(series.coefficients, uncertainty);
  }

  // ---- steps and events -------------------------------------------------------------------------

  void step() {
    flow_ = &mode().flow.from(state_.numbers);
    const double limit = std::min(options_.until, next_tick());
    const double length = std::min(flow_->longest_step(), limit - time_);
    flow_->expand(state_.numbers, noise_, length, series_);
    double earliest = infinity;
    std::size_t which = 0;
    std::vector<Touch> touches;
    for (std::size_t i = 0; i < mode().guards.size(); ++i) {
      const FirstExit exit = exit_of(i);
      if (exit.touch) touches.push_back({time_ + *exit.touch * length, state_.mode, i});
      if (!exit.at || !(*exit.at < earliest)) continue;
      earliest = *exit.at;
      which = i;
    }
    const double share = std::min(earliest, 1.0);
    if (share > 0.0) {
      trajectory_.steps_.push_back({time_, state_});
      state_.numbers = mode().flow.corrected(*flow_, series_.at(share));
      noise_ = rounding * series_.magnitude();
      const double end = share < 1.0 || length < limit - time_ ? time_ + share * length : limit;
      if (!(end > time_) && earliest > 1.0) return stop(StopReason::zeno);
      time_ = end;
    }
    for (const Touch& touch : touches) {
      if (touch.time < time_) trajectory_.touches_.push_back(touch);
    }
    if (!(state_.numbers.cwiseAbs().maxCoeff() <= largest_number))
      return stop(StopReason::diverged);
    if (earliest <= 1.0) fire(which);
  }

  void fire(std::size_t which) {
    const Transition& transition = system_.modes[state_.mode].transitions[which];
    const std::size_t mode_before = state_.mode;
    change(EventKind::transition, which, transition.reset, transition.target,
           transition.alternatives);
    if (stopped_) return;
    follow_sequence(mode_before, which, transition);
  }

  void change(EventKind kind, std::size_t transition, const Reset& reset, std::size_t otherwise,
              const std::vector<Alternative>& alternatives, const Vector* addition = nullptr) {
    Event event{time_, kind, state_.mode, transition, otherwise, state_.numbers, {}};
    state_.numbers = reset.after(state_.numbers);
    if (addition != nullptr) state_.numbers += *addition;
    if (reset.matrix.size() != 0) noise_ = reset.matrix.cwiseAbs() * noise_;
    noise_ += rounding * state_.numbers.cwiseAbs();
    event.mode_after = target_among(alternatives, otherwise);
    state_.mode = event.mode_after;
    event.after = state_.numbers;
    trajectory_.events_.push_back(std::move(event));
    count_at_instant();
    enter_mode();
    if (trajectory_.events_.size() >= options_.event_limit) stop(StopReason::event_limit);
  }

  std::size_t target_among(const std::vector<Alternative>& alternatives,
                           std::size_t otherwise) const {
    for (const Alternative& alternative : alternatives) {
      const bool is_taken =
          std::all_of(alternative.positive.begin(), alternative.positive.end(),
                      [&](const AffineForm& form) { return form.at(state_.numbers) > 0.0; });
      if (is_taken) return alternative.target;
    }
    return otherwise;
  }

  void enter_mode() {
    signs_.clear();
    for (const PreparedGuard& guard : mode().guards) {
      signs_.push_back(guard.direction == Direction::either ? 0.0 : 1.0);
    }
  }

  void count_at_instant() {
    const std::vector<Event>& events = trajectory_.events_;
    const bool same = events.size() > 1 && events[events.size() - 2].time == time_;
    at_instant_ = same ? at_instant_ + 1 : 1;
    if (at_instant_ > 8 + 4 * (system_.modes.size() + system_.clocks.size())) {
      stop(StopReason::chattering);
    }
  }

  /// Firings of one transition alone that come ever faster.
  void follow_sequence(std::size_t mode, std::size_t which, const Transition& transition) {
    const bool goes_on = mode == sequence_mode_ && which == sequence_transition_ && count_ > 0 &&
                         trajectory_.events_.size() == sequence_event_ + 1;
    const double interval = time_ - sequence_time_;
    const double ratio = interval / sequence_interval_;
    count_ = goes_on ? count_ + 1 : 1;
    const double last_ratio = sequence_ratio_;
    sequence_ratio_ = goes_on ? ratio : 0.0;
    sequence_interval_ = interval;
    sequence_mode_ = mode;
    sequence_transition_ = which;
    sequence_time_ = time_;
    sequence_event_ = trajectory_.events_.size();
    constexpr int enough = 8;
    if (count_ < enough || !(ratio < 1.0)) return;
    const double left = interval * ratio / (1.0 - ratio);
    if (transition.settling) {
      constexpr double little = 1e-10;
      constexpr double steady = 1e-3;
      const bool is_steady = std::abs(ratio - last_ratio) < steady * (1.0 - ratio);
      const bool is_little = left * modes_[mode].flow.whole().rate() < little;
      if (is_little && (is_steady || interval <= 8.0 * epsilon * time_)) settle(which, transition);
    } else if (left <= 8.0 * epsilon * time_) {
      stop(StopReason::zeno);
    }
  }

  void settle(std::size_t which, const Transition& transition) {
    count_ = 0;
    const Settling& settling = *transition.settling;
    change(EventKind::settling, which, settling.reset, settling.target, settling.alternatives);
  }

  void stop(StopReason reason) {
    stopped_ = true;
    trajectory_.stop_reason_ = reason;
    const std::vector<Event>& events = trajectory_.events_;
    if (events.empty() || reason == StopReason::diverged) return;
    const Event& last = events.back();
    const Mode& mode = system_.modes[last.mode];
    trajectory_.culprit_ = mode.name + ": " +
                           (last.kind == EventKind::timed ? mode.timed[last.transition].name
                                                          : mode.transitions[last.transition].name);
  }

  static constexpr double largest_number = 1e150;

  const HybridSystem& system_;
  const SimulationOptions& options_;
  std::vector<PreparedMode> modes_;
  State state_;
  double time_;
  Vector noise_;               ///< what rounding has left unknown of each number, on the last step
  std::vector<double> signs_;  ///< of guards of either direction: the side of each, 0 while unknown
  std::vector<Tick> ticks_;
  const LinearFlow* flow_ = nullptr;  ///< of the step
  Series series_;
  bool stopped_ = false;
  std::size_t at_instant_ = 0;
  int count_ = 0;  ///< of the sequence of firings of one transition
  std::size_t sequence_mode_ = 0;
  std::size_t sequence_transition_ = 0;
  std::size_t sequence_event_ = 0;
  double sequence_time_ = 0.0;
  double sequence_interval_ = 0.0;
  double sequence_ratio_ = 0.0;
  Trajectory trajectory_;
};

Trajectory simulate(const HybridSystem& system, const State& start,
                    const SimulationOptions& options) {
  require(faults_of(system, start, options));
  return Simulation(system, start, options).run();
}

State Trajectory::at(double time) const {
  if (steps_.empty() || time >= end_time_) return end_;
  const auto after =
      std::upper_bound(steps_.begin(), steps_.end(), time,
                       [](double wanted, const Step& step) { return wanted < step.time; });
  const Step& step = after == steps_.begin() ? *after : *(after - 1);
  const PreparedFlow flow(flows_[step.start.mode]);
  Series series;
  const LinearFlow& here = flow.from(step.start.numbers);
  const Vector exact = Vector::Zero(step.start.numbers.size());
  here.expand(step.start.numbers, exact, std::max(0.0, time - step.time), series);
  return {step.start.mode, flow.corrected(here, series.at(1.0))};
}

}  // namespace gearlash::hybrid
