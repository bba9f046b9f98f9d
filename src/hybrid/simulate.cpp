#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "base/range_check.hpp"
#include "hybrid/clock_ticks.hpp"
#include "hybrid/guard_watch.hpp"
#include "hybrid/hybrid_trajectory.hpp"
#include "hybrid/preparation.hpp"
#include "hybrid/recurring_events.hpp"
#include "hybrid/repeating.hpp"
#include "hybrid/standing.hpp"

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
        now_{.state = start, .time = options.from},
        ticks_(system_.clocks, options.from),
        observer_(observer) {
    if (observer != nullptr) {
      standing_.emplace(now_, ticks_, guards_, *observer, options.until);
      repeating_.emplace(now_, ticks_, trajectory_.events_, *observer, options.until);
    }
    trajectory_.begin(std::move(preparation), options.from);
    now_.noise = sum_rounding * now_.state.numbers.cwiseAbs();
    enter_mode();
  }

  Trajectory run() {
    if (options_.event_limit == 0) stop(StopReason::event_limit);
    while (!stopped_) {
      if (is_to_stop()) {
        stop(StopReason::stopped);
        break;
      }
      if (fire_due_clocks()) continue;
      if (observer_ != nullptr && pass_ticks_over()) continue;
      if (now_.time >= options_.until) break;
      if (trajectory_.steps_.size() >= options_.step_limit) {
        stop(StopReason::step_limit);
        break;
      }
      step();
    }
    trajectory_.end_time_ = now_.time;
    trajectory_.end_ = now_.state;
    return std::move(trajectory_);
  }

  /// Of a motion that an observer has received.
  Observed observed() {
    Trajectory rest = run();
    return {rest.end_time_, std::move(rest.end_), rest.stop_reason_, std::move(rest.culprit_),
            rest.events_.size() + forgotten_ + stood_ / ticks_of_event};
  }

 private:
  /// So many ticks of a drive that stands, repeated one by one, count as an event.
  static constexpr std::size_t ticks_of_event = 10;

  [[nodiscard]] std::size_t count() const {
    return trajectory_.events_.size() + forgotten_ + stood_ / ticks_of_event;
  }

  /// Asks now and then.
  bool is_to_stop() {
    constexpr std::size_t between = 64;  // a round may stand for thousands of ticks
    if (options_.progress == nullptr || ++rounds_ % between != 0) return false;
    return !options_.progress->go_on((now_.time - options_.from) /
                                     (options_.until - options_.from));
  }

  // ---- clocks -----------------------------------------------------------------------------------

  /// Fires one clock that is due. False if none is.
  bool fire_due_clocks() {
    const double now = std::min(now_.time, options_.until);
    for (std::size_t i = 0; i < ticks_.count(); ++i) {
      if (!ticks_.is_due(i, now)) continue;
      const Vector* addition = ticks_.pass(i);
      const std::vector<TimedTransition>& timed = now_.mode->mode().timed;
      for (std::size_t k = 0; k < timed.size(); ++k) {
        if (timed[k].clock != i) continue;
        change(EventKind::timed, now_.state.mode, k, timed[k].reset, now_.mode->timed[k],
               timed[k].target, addition);
        break;
      }
      return true;
    }
    return false;
  }

  /// Of a motion that is observed. True if the motion is at a new tick.
  bool pass_ticks_over() {
    if (now_.time >= options_.until) return false;
    const bool stands = standing_->stands_clear();
    if (repeating_->pass_over(stands)) return true;
    if (stands && !repeating_->is_young()) stood_ += standing_->stand();
    return false;
  }

  // ---- steps and events -------------------------------------------------------------------------

  void step() {
    choose_flow();
    const LinearFlow& flow = now_.flow->flow;
    const double limit = std::min(options_.until, ticks_.next());
    flow.velocity_at(now_.state.numbers.data(), now_.noise.data(), now_.velocity);
    const double length = std::min(longest_step(), limit - now_.time);
    const StepEnd next = guards_.next_exit(series_of(length));
    if (standing_ && next.share > 1.0 && now_.is_standing()) standing_->note_quiet();
    const double share = std::min(next.share, 1.0);
    if (share > 0.0) {
      record_step();
      const double from = now_.time;
      if (observer_ != nullptr) before_ = now_.state.numbers;
      advance(share * length, length);
      const double end =
          share < 1.0 || length < limit - now_.time ? now_.time + share * length : limit;
      if (!(end > now_.time) && next.share > 1.0) return stop(StopReason::zeno);
      now_.time = end;
      if (next.share <= 1.0) {
        if (next.within > 0.0) {
          put_on_guard(next.guard, next.within * length, product_rounding);
        } else {
          put_on_guard(next.guard, 0x1p-20 * share * length, sum_rounding);
        }
      }
      if (observer_ != nullptr) observer_->moved(from, now_.time, before_, now_.state.numbers);
    }
    for (const Touch& touch : guards_.touches()) {
      if (touch.time < now_.time) trajectory_.touches_.push_back(touch);
    }
    if (!(now_.state.numbers.cwiseAbs().maxCoeff() <= largest_number))
      return stop(StopReason::diverged);
    if (next.share <= 1.0) fire(next.guard);
  }

  /// Switches to the flow without fast decays when these are over. Looks for them only after a few
  /// steps, because finding them costs time, and then ever less often.
  void choose_flow() {
    constexpr int patience = 8;
    if (++steps_in_mode_ < next_look_) return;
    next_look_ = steps_in_mode_ + std::max(1, steps_in_mode_ / patience);
    const std::vector<PreparedMode::Slow>& all = now_.mode->slow();
    if (over_ == all.size()) return;
    if (!all[over_].decays.are_over(now_.state.numbers, largest_in_mode())) return;
    slow_ = &all[over_++];
    now_.flow = &slow_->flow;
    next_look_ = steps_in_mode_ + first_look;
  }

  /// Each number's largest magnitude at the starts of steps since the mode was entered.
  const Vector& largest_in_mode() {
    if (steps_in_largest_ == 0) largest_ = Vector::Zero(now_.state.numbers.size());
    const std::vector<double>& starts = trajectory_.starts_;
    const auto size = static_cast<std::size_t>(now_.state.numbers.size());
    for (; steps_in_largest_ + 1 < steps_in_mode_; ++steps_in_largest_) {
      const auto ago = static_cast<std::size_t>(steps_in_mode_ - 1 - steps_in_largest_);
      if (ago * size > starts.size()) continue;
      const Eigen::Map<const Vector> start(starts.data() + starts.size() - ago * size,
                                           now_.state.numbers.size());
      largest_ = largest_.cwiseMax(start.cwiseAbs());
    }
    largest_ = largest_.cwiseMax(now_.state.numbers.cwiseAbs());
    return largest_;
  }

  double longest_step() {
    const LinearFlow& flow = now_.flow->flow;
    if (flow.polynomial_order() == 0) return flow.longest_step();
    return flow.natural_step(now_.state.numbers.data(), now_.velocity, scratch_);
  }

  StepSeries series_of(double length) const {
    const LinearFlow& flow = now_.flow->flow;
    return {.mode = *now_.mode,
            .flow = *now_.flow,
            .state = now_.state,
            .noise = now_.noise,
            .velocity = now_.velocity,
            .time = now_.time,
            .length = length,
            .table_share = flow.polynomial_order() > 0 ? length : length / flow.longest_step(),
            .order = flow.count() == 0 ? 0 : flow.order(length)};
  }

  void record_step() {
    constexpr std::size_t most_observed = 1024;  // of a flight without an event
    if (observer_ != nullptr && trajectory_.steps_.size() >= most_observed) {
      largest_in_mode();  // while the starts are known
      forget_steps();
    }
    trajectory_.steps_.push_back({now_.time, now_.state.mode, over_});
    const double* numbers = now_.state.numbers.data();
    trajectory_.starts_.insert(trajectory_.starts_.end(), numbers,
                               numbers + now_.state.numbers.size());
  }

  /// Advances by `length`, at most the whole step; an event may cut it short. The uncertainty is a
  /// share of the whole step's terms even then: a state on a guard is known no better than the time
  /// at which it got there.
  void advance(double length, double whole) {
    const LinearFlow& flow = now_.flow->flow;
    now_.noise = now_.state.numbers.cwiseAbs();
    if (now_.flow->longest) {
      now_.flow->longest->add_sizes(flow, now_.velocity, now_.noise.data());
    } else {
      flow.add_sizes(now_.velocity, whole, now_.noise.data(), scratch_);
    }
    now_.noise *= sum_rounding;
    follow(length);
    if (slow_ != nullptr) slow_->decays.put_at_rest(now_.state.numbers);
  }

  /// Moves the state by a time from where now_.velocity was taken.
  void follow(double length) {
    double* numbers = now_.state.numbers.data();
    if (now_.flow->longest) {
      now_.flow->longest->advance(now_.flow->flow, now_.velocity, length, numbers);
    } else {
      now_.flow->flow.advance(now_.velocity, length, numbers, scratch_);
    }
  }

  /// Moves a state that misses the guard by more than rounding onto it, a little along the motion,
  /// by Newton's method. Each event takes the guard as 0 when the next mode begins, so the misfit
  /// would otherwise remain for ever.
  void put_on_guard(std::size_t which, double farthest, double rounding) {
    const SparseForm& guard = now_.mode->guards[which];
    const LinearFlow& flow = now_.flow->flow;
    double* numbers = now_.state.numbers.data();
    constexpr int most = 4;
    for (int i = 0; i < most; ++i) {
      const double value = guard.at(numbers);
      if (std::abs(value) <= guard.size_at(numbers) * rounding) return;
      flow.velocity_at(numbers, now_.velocity);
      const double later = now_.flow->guards[which].time_to_zero(value, now_.velocity);
      if (!(std::abs(later) <= farthest)) return;
      follow(later);
      now_.time += later;
    }
  }

  void fire(std::size_t which) {
    const Transition& transition = now_.mode->mode().transitions[which];
    change(EventKind::transition, now_.state.mode, which, transition.reset,
           now_.mode->transitions[which], transition.target);
    if (!stopped_) follow_sequence();
  }

  /// `mode` has the transition: the present one or, of a settling, that of the last firing.
  void change(EventKind kind, std::size_t mode, std::size_t transition, const AffineReset& reset,
              const PreparedJump& jump, std::size_t otherwise, const Vector* addition = nullptr) {
    std::vector<Event>& events = trajectory_.events_;
    Event& event = events.emplace_back(forgotten_event());
    event.time = now_.time;
    event.kind = kind;
    event.mode = mode;
    event.transition = transition;
    event.before = event.after = now_.state.numbers;
    jump.reset.apply(reset, event.before, event.after, now_.noise, noise_before_);
    if (addition != nullptr) event.after += *addition;
    now_.state.numbers = event.after;
    now_.noise += sum_rounding * now_.state.numbers.cwiseAbs();
    event.mode_after = now_.target_among(jump.alternatives, otherwise);
    now_.state.mode = event.mode_after;
    count_at_instant();
    recurring_.note();
    if (repeating_) repeating_->note();
    enter_mode();
    if (count() >= options_.event_limit) stop(StopReason::event_limit);
    if (observer_ != nullptr) forget();
  }

  void forget_steps() {
    trajectory_.steps_.clear();
    trajectory_.starts_.clear();
    trajectory_.touches_.clear();
  }

  /// Of a motion that is observed only the last events are kept, which show what recurs at an
  /// instant or ever faster.
  void forget() {
    forget_steps();
    constexpr std::size_t kept = 256;
    std::vector<Event>& events = trajectory_.events_;
    if (events.size() < 2 * kept) return;
    forgotten_ += events.size() - kept;
    const auto first_kept = events.end() - kept;
    spare_.insert(spare_.end(), std::make_move_iterator(events.begin()),
                  std::make_move_iterator(first_kept));
    events.erase(events.begin(), first_kept);
    recurring_.limit(kept);
  }

  /// One whose numbers need no new memory, if there is one.
  Event forgotten_event() {
    if (spare_.empty()) return {};
    Event event = std::move(spare_.back());
    spare_.pop_back();
    return event;
  }

  void enter_mode() {
    now_.mode = &preparation_.mode(now_.state.mode);
    now_.flow = &now_.mode->whole;
    slow_ = nullptr;
    over_ = 0;
    steps_in_mode_ = 0;
    steps_in_largest_ = 0;
    next_look_ = first_look;
    guards_.enter(now_.mode->mode());
  }

  void count_at_instant() {
    const std::vector<Event>& events = trajectory_.events_;
    const bool same = events.size() > 1 && events[events.size() - 2].time == now_.time;
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
      if (left <= 8.0 * epsilon * now_.time && before <= tiny * now_.time) settle_by_one_of(turn);
      return;
    }
    constexpr double little = 1e-10;
    constexpr double steady = 1e-3;
    const double last_ratio = before / recurring_.duration(turn, 2);
    const bool is_steady = std::abs(ratio - last_ratio) < steady * (1.0 - ratio);
    const bool is_little = left < little * own_time(last.mode, turn);
    if (is_little && (is_steady || interval <= 8.0 * epsilon * now_.time)) settle();
  }

  /// Whether firings with a Settling come so fast that doubles no longer separate their times.
  /// Faces that hardly rebound give too few firings for a ratio of intervals.
  bool is_over_at_once() const {
    const std::size_t turn = recurring_.recurring_turn(3);
    if (turn == 0 || recurring_.duration(turn, 0) > 8.0 * epsilon * now_.time) return false;
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
    const bool is_limit = reason == StopReason::event_limit || reason == StopReason::step_limit ||
                          reason == StopReason::stopped;
    if (events.empty() || is_limit || reason == StopReason::diverged) return;
    const Event& last = events.back();
    trajectory_.culprit_ = system_.mode(last.mode).name + ": " + last.name(system_);
  }

  static constexpr double largest_number = 1e150;

  const Preparation& preparation_;
  const HybridSystem& system_;
  const SimulationOptions& options_;
  Present now_;
  ClockTicks ticks_;
  GuardWatch guards_;
  std::size_t rounds_ = 0;  ///< of run()
  MotionObserver* observer_;
  std::optional<Standing> standing_{};        ///< of a motion that is observed
  std::optional<Repeating> repeating_{};      ///< likewise
  const PreparedMode::Slow* slow_ = nullptr;  ///< set if now_.flow is a slow one
  std::size_t over_ = 0;                      ///< how many of the mode's fast decays are over
  static constexpr int first_look = 9;        ///< steps before fast decays are looked for
  int steps_in_mode_ = 0;
  int next_look_ = first_look;
  int steps_in_largest_ = 0;
  Vector largest_;  ///< each number's largest magnitude since the mode was entered
  std::vector<double> scratch_;
  Vector noise_before_;
  Vector before_;  ///< numbers at the start of a piece that is observed
  bool stopped_ = false;
  std::size_t at_instant_ = 0;
  std::size_t stood_ = 0;       ///< ticks that were repeated
  std::size_t forgotten_ = 0;   ///< events no longer kept
  std::vector<Event> spare_{};  ///< some of them
  Trajectory trajectory_;
  RecurringEvents recurring_{trajectory_.events_};
};

Trajectory simulate(const HybridSystem& system, const State& start,
                    const SimulationOptions& options) {
  require_none(faults(system), faults_of(system, start, options));
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
