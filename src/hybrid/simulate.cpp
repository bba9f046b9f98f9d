#include <algorithm>
#include <cmath>
#include <limits>

#include "base/range_check.hpp"
#include "hybrid/clock_ticks.hpp"
#include "hybrid/guard_watch.hpp"
#include "hybrid/hybrid_trajectory.hpp"
#include "hybrid/preparation.hpp"
#include "hybrid/recurring_events.hpp"

namespace gearlash::hybrid {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

std::vector<Fault> faults_of(const HybridSystem& system, const State& start,
                             const SimulationOptions& options) {
  RangeCheck check;
  if (start.mode >= system.mode_count()) {
    check.refuse("start.mode", std::to_string(start.mode),
                 "must be one of " + std::to_string(system.mode_count()) + " modes, from 0 on");
  }
  if (start.numbers.size() != system.size() || !start.numbers.allFinite()) {
    check.refuse("start.numbers",
                 start.numbers.allFinite() ? std::to_string(start.numbers.size()) + " numbers"
                                           : std::string("not finite"),
                 "must be " + std::to_string(system.size()) + " finite numbers");
  }
  check.finite("options.from", options.from);
  if (!std::isfinite(options.until) || options.until < options.from) {
    check.refuse("options.until", exact_text(options.until),
                 "must be finite and at least options.from");
  }
  return check.faults();
}

}  // namespace

class Simulation {
 public:
  Simulation(std::shared_ptr<const Preparation> preparation, const State& start,
             const SimulationOptions& options, MotionObserver* observer = nullptr)
      : preparation_(*preparation),
        system_(preparation_.system()),
        options_(options),
        observer_(observer),
        state_(start),
        time_(options.from),
        ticks_(system_.clocks, options.from) {
    trajectory_.preparation_ = std::move(preparation);
    constexpr std::size_t some = 8;
    trajectory_.events_.reserve(some);
    trajectory_.steps_.reserve(2 * some);
    trajectory_.starts_.reserve(2 * some * static_cast<std::size_t>(system_.size()));
    trajectory_.start_time_ = options.from;
    trajectory_.end_time_ = options.from;
    noise_ = sum_rounding * state_.numbers.cwiseAbs();
    enter_mode();
  }

  Trajectory run() {
    if (options_.event_limit == 0) stop(StopReason::event_limit);
    while (!stopped_) {
      if (fire_due_clocks()) continue;
      if (observer_ != nullptr) stand();
      if (time_ >= options_.until) break;
      step();
    }
    trajectory_.end_time_ = time_;
    trajectory_.end_ = state_;
    return std::move(trajectory_);
  }

  /// Of a motion that an observer has received.
  Observed observed() {
    Trajectory rest = run();
    return {rest.end_time_, std::move(rest.end_), rest.stop_reason_, std::move(rest.culprit_),
            rest.events_.size() + forgotten_};
  }

 private:
  // ---- standing ---------------------------------------------------------------------------------

  /// Repeats the ticks of a mode in which nothing moves, while they lead back to it and leave its
  /// guards clear. The clocks fire before the next step, so none is due here.
  void stand() {
    if (ticks_.count() == 0 || !ticks_.are_regular()) return;
    const double period = ticks_.common_period();
    Rounds rounds;
    double round_ends = time_;
    std::size_t unchanged = 0;
    while (ticks_.next() < options_.until && stands_clear()) {
      standing_ = state_.numbers;
      if (!repeat_ticks(ticks_.next())) {
        state_.numbers = standing_;
        return;
      }
      unchanged = state_.numbers == standing_ ? unchanged + 1 : 0;
      // Each clock has ticked at least once in this many instants.
      if (unchanged > 2 * ticks_.count()) ticks_.pass_before(options_.until);
      if (period == 0.0 || time_ < round_ends) continue;
      round_ends = time_ + (1.0 - 1e-6) * period;
      rounds.add(state_.numbers);
      if (rounds.are_alike()) pass_over_rounds(rounds, period);
    }
  }

  /// Rounds of all clocks that each change the numbers in the same way.
  struct Rounds {
    Vector last;
    Vector change;          ///< in the last round
    Vector begin;           ///< before the first of those alike
    std::size_t alike = 0;  ///< rounds with the same change, within rounding

    void add(const Vector& numbers) {
      if (last.size() == 0) {
        begin = last = numbers;
        change = Vector::Zero(numbers.size());
        return;
      }
      constexpr double rounding = 8.0 * epsilon;
      bool is_alike = true;
      for (Eigen::Index i = 0; i < numbers.size(); ++i) {
        const double step = numbers[i] - last[i];
        const double size = std::abs(numbers[i]) + std::abs(last[i]);
        is_alike = is_alike && std::abs(step - change[i]) <= rounding * size;
        change[i] = step;
      }
      if (!is_alike) begin = last;
      alike = is_alike ? alike + 1 : 1;
      last = numbers;
    }
    /// The mean of many has less rounding than one.
    bool are_alike() const { return alike > 16; }
    Vector mean_change() const { return (last - begin) / static_cast<double>(alike); }
  };

  /// Passes over rounds that change the numbers alike, up to some before a guard or an alternative
  /// comes near 0. The ticks are affine and nothing that is read moves, so a change that has
  /// repeated goes on repeating.
  void pass_over_rounds(Rounds& rounds, double period) {
    // In rounds. Between the ticks of one the numbers differ from those at its end.
    constexpr double margin = 8.0;
    const Vector change = rounds.mean_change();
    const Vector next = state_.numbers + change;
    double most = (options_.until - time_) / period;
    const auto keep = [&](const SparseForm& form) {
      const double value = form.at(state_.numbers.data());
      const double rate = form.at(next.data()) - value;
      if (rate * value < 0.0) most = std::min(most, -value / rate);
    };
    for (const SparseForm& guard : mode_->guards) keep(guard);
    for (const PreparedJump& jump : mode_->timed) {
      for (const PreparedAlternative& alternative : jump.alternatives) {
        for (const SparseForm& form : alternative.positive) keep(form);
      }
    }
    if (!(most > 2.0 * margin)) return;
    const double passed = std::floor(most - margin);
    standing_ = state_.numbers;
    state_.numbers += passed * change;
    const double now = time_ + passed * period;
    ticks_.pass_over(static_cast<std::size_t>(passed));
    observer_->moved(time_, now, standing_, state_.numbers);
    time_ = now;
    noise_ = sum_rounding * state_.numbers.cwiseAbs();
    rounds = {};
  }

  /// Whether nothing moves, and no guard leaves its side.
  bool stands_clear() {
    flow_->flow.velocity_at(state_.numbers.data(), velocity_);
    if (quiet_mode_ != state_.mode) quiet_.resize(0);
    return is_standing() && guards_.are_clear(*mode_, state_.numbers.data(), noise_.data(), quiet_);
  }

  /// By the velocity at the state.
  bool is_standing() const {
    return std::all_of(velocity_.values.begin(), velocity_.values.end(),
                       [](double value) { return value == 0.0; });
  }

  /// Applies the ticks at an instant. False, with the state spoilt, if they do not lead back to the
  /// mode or to a guard's side.
  bool repeat_ticks(double now) {
    const std::vector<TimedTransition>& timed = mode_->mode().timed;
    for (std::size_t i = 0; i < ticks_.count(); ++i) {
      if (!ticks_.is_due(i, now)) continue;
      for (std::size_t k = 0; k < timed.size(); ++k) {
        if (timed[k].clock != i) continue;
        ticked_ = state_.numbers;
        mode_->timed[k].reset.apply(timed[k].reset, ticked_, state_.numbers, noise_, noise_before_);
        if (target_among(mode_->timed[k].alternatives, timed[k].target) != state_.mode)
          return false;
        break;
      }
    }
    noise_ = sum_rounding * state_.numbers.cwiseAbs();
    if (!stands_clear()) return false;
    for (std::size_t i = 0; i < ticks_.count(); ++i) {
      if (ticks_.is_due(i, now)) ticks_.pass(i);
    }
    observer_->moved(time_, now, standing_, state_.numbers);
    time_ = now;
    return true;
  }

  // ---- clocks -----------------------------------------------------------------------------------

  /// Fires one clock that is due. False if none is.
  bool fire_due_clocks() {
    const double now = std::min(time_, options_.until);
    for (std::size_t i = 0; i < ticks_.count(); ++i) {
      if (!ticks_.is_due(i, now)) continue;
      const Vector* addition = ticks_.pass(i);
      const std::vector<TimedTransition>& timed = mode_->mode().timed;
      for (std::size_t k = 0; k < timed.size(); ++k) {
        if (timed[k].clock != i) continue;
        change(EventKind::timed, state_.mode, k, timed[k].reset, mode_->timed[k], timed[k].target,
               addition);
        break;
      }
      return true;
    }
    return false;
  }

  // ---- steps and events -------------------------------------------------------------------------

  void step() {
    choose_flow();
    const LinearFlow& flow = flow_->flow;
    const double limit = std::min(options_.until, ticks_.next());
    flow.velocity_at(state_.numbers.data(), noise_.data(), velocity_);
    const double length = std::min(longest_step(), limit - time_);
    const StepEnd next = guards_.next_exit(series_of(length));
    if (observer_ != nullptr && next.share > 1.0 && is_standing()) {
      quiet_mode_ = state_.mode;
      quiet_ = state_.numbers;
    }
    const double share = std::min(next.share, 1.0);
    if (share > 0.0) {
      record_step();
      const double from = time_;
      if (observer_ != nullptr) standing_ = state_.numbers;
      advance(share * length, length);
      const double end = share < 1.0 || length < limit - time_ ? time_ + share * length : limit;
      if (!(end > time_) && next.share > 1.0) return stop(StopReason::zeno);
      time_ = end;
      if (next.share <= 1.0) {
        if (next.within > 0.0) {
          put_on_guard(next.guard, next.within * length, product_rounding);
        } else {
          put_on_guard(next.guard, 0x1p-20 * share * length, sum_rounding);
        }
      }
      if (observer_ != nullptr) observer_->moved(from, time_, standing_, state_.numbers);
    }
    for (const Touch& touch : guards_.touches()) {
      if (touch.time < time_) trajectory_.touches_.push_back(touch);
    }
    if (!(state_.numbers.cwiseAbs().maxCoeff() <= largest_number))
      return stop(StopReason::diverged);
    if (next.share <= 1.0) fire(next.guard);
  }

  /// Switches to the flow without fast decays when these are over. Looks for them only after a few
  /// steps, because finding them costs time.
  void choose_flow() {
    constexpr int patience = 8;
    if (slow_ != nullptr || ++steps_in_mode_ <= patience) return;
    const PreparedMode::Slow* slow = mode_->slow();
    if (slow == nullptr || !slow->decays.are_over(state_.numbers, largest_in_mode())) return;
    slow_ = slow;
    flow_ = &slow->flow;
  }

  /// Each number's largest magnitude at the starts of steps since the mode was entered.
  const Vector& largest_in_mode() {
    if (steps_in_largest_ == 0) largest_ = Vector::Zero(state_.numbers.size());
    const std::vector<double>& starts = trajectory_.starts_;
    const auto size = static_cast<std::size_t>(state_.numbers.size());
    for (; steps_in_largest_ + 1 < steps_in_mode_; ++steps_in_largest_) {
      const auto ago = static_cast<std::size_t>(steps_in_mode_ - 1 - steps_in_largest_);
      if (ago * size > starts.size()) continue;
      const Eigen::Map<const Vector> start(starts.data() + starts.size() - ago * size,
                                           state_.numbers.size());
      largest_ = largest_.cwiseMax(start.cwiseAbs());
    }
    largest_ = largest_.cwiseMax(state_.numbers.cwiseAbs());
    return largest_;
  }

  double longest_step() {
    const LinearFlow& flow = flow_->flow;
    if (flow.polynomial_order() == 0) return flow.longest_step();
    return flow.natural_step(state_.numbers.data(), velocity_, scratch_);
  }

  StepSeries series_of(double length) const {
    const LinearFlow& flow = flow_->flow;
    return {.mode = *mode_,
            .flow = *flow_,
            .state = state_,
            .noise = noise_,
            .velocity = velocity_,
            .time = time_,
            .length = length,
            .table_share = flow.polynomial_order() > 0 ? length : length / flow.longest_step(),
            .remainder = flow.remainder(velocity_, length),
            .order = flow.count() == 0 ? 0 : flow.order(length)};
  }

  void record_step() {
    trajectory_.steps_.push_back({time_, state_.mode, slow_ != nullptr});
    const double* numbers = state_.numbers.data();
    trajectory_.starts_.insert(trajectory_.starts_.end(), numbers, numbers + state_.numbers.size());
  }

  /// Advances by `length`, at most the whole step; an event may cut it short. The uncertainty is a
  /// share of the whole step's terms even then: a state on a guard is known no better than the time
  /// at which it got there.
  void advance(double length, double whole) {
    const LinearFlow& flow = flow_->flow;
    noise_ = state_.numbers.cwiseAbs();
    if (flow_->longest) {
      flow_->longest->add_sizes(flow, velocity_, noise_.data());
    } else {
      flow.add_sizes(velocity_, whole, noise_.data(), scratch_);
    }
    noise_ *= sum_rounding;
    follow(length);
    if (slow_ != nullptr) slow_->decays.put_at_rest(state_.numbers);
  }

  /// Moves the state by a time from where velocity_ was taken.
  void follow(double length) {
    double* numbers = state_.numbers.data();
    if (flow_->longest) {
      flow_->longest->advance(flow_->flow, velocity_, length, numbers);
    } else {
      flow_->flow.advance(velocity_, length, numbers, scratch_);
    }
  }

  /// Moves a state that misses the guard by more than rounding onto it, a little along the motion,
  /// by Newton's method. Each event takes the guard as 0 when the next mode begins, so the misfit
  /// would otherwise remain for ever.
  void put_on_guard(std::size_t which, double farthest, double rounding) {
    const SparseForm& guard = mode_->guards[which];
    const LinearFlow& flow = flow_->flow;
    double* numbers = state_.numbers.data();
    constexpr int most = 4;
    for (int i = 0; i < most; ++i) {
      const double value = guard.at(numbers);
      if (std::abs(value) <= guard.size_at(numbers) * rounding) return;
      flow.velocity_at(numbers, velocity_);
      const double later = flow_->guards[which].time_to_zero(value, velocity_);
      if (!(std::abs(later) <= farthest)) return;
      follow(later);
      time_ += later;
    }
  }

  void fire(std::size_t which) {
    const Transition& transition = mode_->mode().transitions[which];
    change(EventKind::transition, state_.mode, which, transition.reset, mode_->transitions[which],
           transition.target);
    if (!stopped_) follow_sequence();
  }

  /// `mode` has the transition: the present one or, of a settling, that of the last firing.
  void change(EventKind kind, std::size_t mode, std::size_t transition, const AffineReset& reset,
              const PreparedJump& jump, std::size_t otherwise, const Vector* addition = nullptr) {
    std::vector<Event>& events = trajectory_.events_;
    Event& event = events.emplace_back(
        Event{time_, kind, mode, transition, otherwise, state_.numbers, state_.numbers});
    jump.reset.apply(reset, event.before, event.after, noise_, noise_before_);
    if (addition != nullptr) event.after += *addition;
    state_.numbers = event.after;
    noise_ += sum_rounding * state_.numbers.cwiseAbs();
    event.mode_after = target_among(jump.alternatives, otherwise);
    state_.mode = event.mode_after;
    count_at_instant();
    recurring_.note();
    enter_mode();
    if (events.size() + forgotten_ >= options_.event_limit) stop(StopReason::event_limit);
    if (observer_ != nullptr) forget();
  }

  /// Of a motion that is observed only the last events are kept, which show what recurs at an
  /// instant or ever faster.
  void forget() {
    trajectory_.steps_.clear();
    trajectory_.starts_.clear();
    trajectory_.touches_.clear();
    constexpr std::size_t kept = 256;
    std::vector<Event>& events = trajectory_.events_;
    if (events.size() < 2 * kept) return;
    forgotten_ += events.size() - kept;
    events.erase(events.begin(), events.end() - kept);
    recurring_.limit(kept);
  }

  std::size_t target_among(const std::vector<PreparedAlternative>& alternatives,
                           std::size_t otherwise) const {
    for (const PreparedAlternative& alternative : alternatives) {
      const bool is_taken =
          std::all_of(alternative.positive.begin(), alternative.positive.end(),
                      [&](const SparseForm& form) { return form.at(state_.numbers.data()) > 0.0; });
      if (is_taken) return alternative.target;
    }
    return otherwise;
  }

  void enter_mode() {
    mode_ = &preparation_.mode(state_.mode);
    flow_ = &mode_->whole;
    slow_ = nullptr;
    steps_in_mode_ = 0;
    steps_in_largest_ = 0;
    guards_.enter(mode_->mode());
  }

  void count_at_instant() {
    const std::vector<Event>& events = trajectory_.events_;
    const bool same = events.size() > 1 && events[events.size() - 2].time == time_;
    at_instant_ = same ? at_instant_ + 1 : 1;
    if (at_instant_ > 8 + 4 * (system_.mode_count() + system_.clocks.size())) {
      stop(recurring_.have_come_ever_faster() ? StopReason::zeno : StopReason::chattering);
    }
  }

  /// Precondition: the event is not timed.
  const Transition& transition_of(const Event& event) const {
    return preparation_.mode(event.mode).mode().transitions[event.transition];
  }

  // ---- events that come ever faster -------------------------------------------------------------

  void follow_sequence() {
    if (is_over_at_once()) return settle();
    const std::size_t turn = recurring_.recurring_turn(8);
    if (turn == 0) return;
    const double interval = recurring_.duration(turn, 0);
    const double before = recurring_.duration(turn, 1);
    const double ratio = interval / before;
    if (!(ratio < 1.0)) return;
    const double left = interval * ratio / (1.0 - ratio);
    const Event& last = trajectory_.events_.back();
    const Transition& transition = transition_of(last);
    if (!transition.settling) {
      // A single pair of events at one instant is no sequence.
      constexpr double tiny = 1e-8;
      if (left <= 8.0 * epsilon * time_ && before <= tiny * time_) settle_by_one_of(turn);
      return;
    }
    constexpr double little = 1e-10;
    constexpr double steady = 1e-3;
    const double last_ratio = before / recurring_.duration(turn, 2);
    const bool is_steady = std::abs(ratio - last_ratio) < steady * (1.0 - ratio);
    const bool is_little = left < little * own_time(last.mode, turn);
    if (is_little && (is_steady || interval <= 8.0 * epsilon * time_)) settle();
  }

  /// Whether firings with a Settling come so fast that doubles no longer separate their times.
  /// Faces that hardly rebound give too few firings for a ratio of intervals.
  bool is_over_at_once() const {
    const std::size_t turn = recurring_.recurring_turn(3);
    if (turn == 0 || recurring_.duration(turn, 0) > 8.0 * epsilon * time_) return false;
    const Event& last = trajectory_.events_.back();
    return transition_of(last).settling.has_value();
  }

  /// The time against which an interval counts as short: the mode's own, or the first turn's if
  /// longer.
  double own_time(std::size_t mode, std::size_t turn) const {
    const double rate = preparation_.mode(mode).whole.flow.rate();
    const double first = recurring_.duration(turn, recurring_.turns_before(turn));
    return rate > 0.0 ? std::max(first, 1.0 / rate) : first;
  }

  /// Ends a sequence whose times doubles no longer separate, by the last firing of its turn that
  /// has a Settling.
  void settle_by_one_of(std::size_t turn) {
    for (std::size_t ago = 0; ago < turn; ++ago) {
      if (transition_of(event_before(ago)).settling) return settle(ago);
    }
    stop(StopReason::zeno);
  }

  const Event& event_before(std::size_t ago) const {
    return trajectory_.events_[trajectory_.events_.size() - 1 - ago];
  }

  void settle(std::size_t ago = 0) {
    const Event last = event_before(ago);
    const Settling& settling = *transition_of(last).settling;
    change(EventKind::settling, last.mode, last.transition, settling.reset,
           *preparation_.mode(last.mode).settlings[last.transition], settling.target);
  }

  void stop(StopReason reason) {
    stopped_ = true;
    trajectory_.stop_reason_ = reason;
    const std::vector<Event>& events = trajectory_.events_;
    if (events.empty() || reason == StopReason::diverged) return;
    const Event& last = events.back();
    const AffineMode& mode = preparation_.mode(last.mode).mode();
    trajectory_.culprit_ = mode.name + ": " +
                           (last.kind == EventKind::timed ? mode.timed[last.transition].name
                                                          : mode.transitions[last.transition].name);
  }

  static constexpr double largest_number = 1e150;

  const Preparation& preparation_;
  const HybridSystem& system_;
  const SimulationOptions& options_;
  MotionObserver* observer_;
  const PreparedMode* mode_ = nullptr;
  const PreparedFlow* flow_ = nullptr;        ///< of the step
  const PreparedMode::Slow* slow_ = nullptr;  ///< set if flow_ is the slow one
  int steps_in_mode_ = 0;
  int steps_in_largest_ = 0;
  State state_;
  double time_;
  Vector noise_;    ///< uncertainty of each number by rounding, from the last step
  Vector largest_;  ///< each number's largest magnitude since the mode was entered
  ClockTicks ticks_;
  GuardWatch guards_;
  Velocity velocity_;  ///< at the start of the step
  std::vector<double> scratch_;
  Vector noise_before_;
  Vector standing_;  ///< numbers at the start of a piece that is observed
  Vector ticked_;
  Vector quiet_;  ///< numbers at which nothing moved and no guard left its side; or empty
  std::size_t quiet_mode_ = 0;
  bool stopped_ = false;
  std::size_t at_instant_ = 0;
  std::size_t forgotten_ = 0;  ///< events no longer kept
  Trajectory trajectory_;
  RecurringEvents recurring_{trajectory_.events_};
};

Trajectory simulate(const HybridSystem& system, const State& start,
                    const SimulationOptions& options) {
  RangeCheck check;
  check.include(faults(system)).include(faults_of(system, start, options));
  require_none(check.faults());
  return Simulation(std::make_shared<const Preparation>(system), start, options).run();
}

PreparedSystem::PreparedSystem(HybridSystem system) {
  require_none(faults(system));
  preparation_ = std::make_shared<const Preparation>(std::move(system));
}

Trajectory simulate(const PreparedSystem& system, const State& start,
                    const SimulationOptions& options) {
  require_none(faults_of(system.system(), start, options));
  return Simulation(system.preparation_, start, options).run();
}

Observed observe(const PreparedSystem& system, const State& start, const SimulationOptions& options,
                 MotionObserver& observer) {
  require_none(faults_of(system.system(), start, options));
  return Simulation(system.preparation_, start, options, &observer).observed();
}

}  // namespace gearlash::hybrid
