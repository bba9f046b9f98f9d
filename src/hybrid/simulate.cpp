#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "base/range_check.hpp"
#include "hybrid/first_exit.hpp"
#include "hybrid/hybrid_trajectory.hpp"
#include "hybrid/preparation.hpp"

namespace gearlash::hybrid {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double epsilon = std::numeric_limits<double>::epsilon();

std::vector<Violation> faults_of(const HybridSystem& system, const State& start,
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
  return check.violations();
}

}  // namespace

class Simulation {
 public:
  Simulation(std::shared_ptr<const Preparation> preparation, const State& start,
             const SimulationOptions& options)
      : preparation_(*preparation),
        system_(preparation_.system()),
        options_(options),
        state_(start),
        time_(options.from) {
    trajectory_.preparation_ = std::move(preparation);
    constexpr std::size_t some = 8;
    trajectory_.events_.reserve(some);
    trajectory_.steps_.reserve(2 * some);
    trajectory_.starts_.reserve(2 * some * static_cast<std::size_t>(system_.size()));
    for (const Clock& clock : system_.clocks) ticks_.push_back(first_tick(clock, options.from));
    trajectory_.start_time_ = options.from;
    trajectory_.end_time_ = options.from;
    noise_ = sum_rounding * state_.numbers.cwiseAbs();
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
    Tick tick{clock.period > 0.0 ? clock.first : clock.times.front()};
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
      const std::vector<TimedTransition>& timed = mode_->mode().timed;
      for (std::size_t k = 0; k < timed.size(); ++k) {
        if (timed[k].clock != i) continue;
        change(EventKind::timed, k, timed[k].reset, mode_->timed[k], timed[k].target, addition);
        break;
      }
      return true;
    }
    return false;
  }

  // ---- guards -----------------------------------------------------------------------------------

  /// As a share of the step.
  struct StepExit : FirstExit {
    double within = 0.0;  ///< how far from `at` it may be
  };

  /// When a guard leaves its side within the step, by its leading terms alone where `roughly` and
  /// they tell.
  StepExit exit_of(std::size_t index, bool roughly) {
    const SparseForm& form = mode_->guards[index];
    const GuardTable& table = flow_->guards[index];
    double& sign = signs_[index];
    const double value = form.at(state_.numbers.data());
    const double unknown = form.noise_at(state_.numbers.data(), noise_.data());
    const double farthest =
        table.reach(velocity_, table_share_) + unknown + table.weight() * remainder_;
    if (sign * value > farthest) return {};
    if (sign == 0.0 && std::abs(value) > farthest) {  // the side that it is on first is its own
      sign = std::copysign(1.0, value);
      return {};
    }
    if (roughly && table.few_orders() < order_) {
      if (const auto exit = exit_by(table, value, unknown, sign, table.few_orders())) return *exit;
    }
    return exit_by(table, value, unknown, sign, order_).value_or(StepExit{});
  }

  /// By the terms up to an order. Nothing where it takes more of them to tell; and where there are
  /// none that count, as the motion goes on on the guard.
  std::optional<StepExit> exit_by(const GuardTable& table, double value, double unknown,
                                  double& sign, int last) {
    coefficients_.resize(static_cast<std::size_t>(order_) + 4);
    table.coefficients(velocity_, table_share_, last, coefficients_.data());
    coefficients_[0] = value;
    const int first = first_that_counts(table, unknown, last);
    if (first > last) return std::nullopt;
    const bool is_positive = coefficients_[static_cast<std::size_t>(first)] > 0.0;
    if (sign == 0.0) sign = is_positive ? 1.0 : -1.0;
    if (is_positive != (sign > 0.0)) return StepExit{{0.0, std::nullopt}};
    const auto series =
        std::span(coefficients_)
            .subspan(static_cast<std::size_t>(first), static_cast<std::size_t>(last - first + 1));
    if (sign < 0.0) {
      for (double& coefficient : series) coefficient = -coefficient;
    }
    const bool is_whole = last == order_;
    const int from = std::max(first, 1);
    const double uncertainty =
        (is_whole ? table.uncertainty(velocity_, table_share_, from, order_)
                  : table.bound_of_uncertainty(velocity_, table_share_, from)) +
        table.weight() * remainder_ + (first == 0 ? unknown : 0.0);
    if (is_whole) {
      touch_within_ = (1.0 + negligible_share) * uncertainty;
      return StepExit{first_exit(series, uncertainty)};
    }
    const double rest = uncertainty + table.beyond_few(velocity_, table_share_);
    const auto rough = rough_exit(series, rest, order_);
    if (!rough) return std::nullopt;
    // How soon a motion that begins on the guard comes back is told by all terms better than by
    // the state there.
    if (rough->at && first > 0) return std::nullopt;
    return StepExit{{rough->at, std::nullopt}, rough->within};
  }

  /// The order of the first derivative that is not 0, as far as can be told; beyond the last
  /// where there is none. A start on the guard's zero is divided out by it.
  int first_that_counts(const GuardTable& table, double unknown, int last) const {
    if (std::abs(coefficients_[0]) > unknown) return 0;
    for (int order = 1; order <= last; ++order) {
      const double size = std::abs(coefficients_[static_cast<std::size_t>(order)]);
      if (size > table.uncertainty_of(velocity_, table_share_, order)) return order;
    }
    return last + 1;
  }

  // ---- steps and events -------------------------------------------------------------------------

  void step() {
    choose_flow();
    const LinearFlow& flow = flow_->flow;
    const double limit = std::min(options_.until, next_tick());
    flow.velocity_at(state_.numbers.data(), noise_.data(), velocity_);
    const double length = std::min(longest_step(), limit - time_);
    expand(length);
    zero_at_start_.swap(zero_at_end_);
    const StepEnd next = next_exit(length);
    const double share = std::min(next.share, 1.0);
    if (share > 0.0) {
      record_step();
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
    }
    for (const Touch& touch : touches_) {
      if (touch.time < time_) trajectory_.touches_.push_back(touch);
    }
    if (!(state_.numbers.cwiseAbs().maxCoeff() <= largest_number))
      return stop(StopReason::diverged);
    if (next.share <= 1.0) fire(next.guard);
  }

  struct StepEnd {
    double share = infinity;  ///< of the step
    std::size_t guard = 0;
    double within = 0.0;
  };

  /// The first exit of all. One that is known roughly is enough where there is no other beside it.
  StepEnd next_exit(double length) {
    for (const bool roughly : {true, false}) {
      touches_.clear();
      zero_at_end_.clear();
      StepEnd next;
      std::size_t exits = 0;
      bool is_rough = false;
      for (std::size_t i = 0; i < mode_->guards.size(); ++i) {
        const StepExit exit = exit_of(i, roughly);
        if (exit.touch || !zero_at_start_.empty()) note_touch(i, exit, length);
        if (!exit.at) continue;
        ++exits;
        is_rough = is_rough || exit.within > 0.0;
        if (*exit.at < next.share) next = {*exit.at, i, exit.within};
      }
      if (exits <= 1 || !is_rough) return next;
    }
    return {};
  }

  /// Of a guard that comes down to 0 as the step ends the next one says whether it leaves it on its
  /// own side. Seldom called, and so kept out of the loop that steps.
  [[gnu::noinline]] void note_touch(std::size_t guard, const StepExit& exit, double length) {
    if (exit.touch == 1.0) {
      zero_at_end_.push_back(guard);
    } else if (exit.touch) {
      touches_.push_back({time_ + *exit.touch * length, state_.mode, guard, touch_within_});
    }
    const double value = std::abs(mode_->guards[guard].at(state_.numbers.data()));
    const double unknown = mode_->guards[guard].noise_at(state_.numbers.data(), noise_.data());
    const auto came_down = std::count(zero_at_start_.begin(), zero_at_start_.end(), guard);
    if (came_down == 0 || exit.at == 0.0 || value > unknown) return;
    touches_.push_back({time_, state_.mode, guard, unknown});
  }

  /// Fast decays are looked for once they have cost some steps.
  void choose_flow() {
    constexpr int patience = 8;
    if (slow_ != nullptr || ++steps_in_mode_ <= patience) return;
    const PreparedMode::Slow* slow = mode_->slow();
    if (slow == nullptr || !slow->decays.are_over(state_.numbers, largest_in_mode())) return;
    slow_ = slow;
    flow_ = &slow->flow;
  }

  /// Each number's largest size since the mode was entered, at the starts of steps.
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

  /// The series of the step.
  void expand(double length) {
    const LinearFlow& flow = flow_->flow;
    order_ = flow.count() == 0 ? 0 : flow.order(length);
    table_share_ = flow.polynomial_order() > 0 ? length : length / flow.longest_step();
    remainder_ = flow.remainder(velocity_, length);
  }

  void record_step() {
    trajectory_.steps_.push_back({time_, state_.mode, slow_ != nullptr});
    const double* numbers = state_.numbers.data();
    trajectory_.starts_.insert(trajectory_.starts_.end(), numbers, numbers + state_.numbers.size());
  }

  /// Over what is left of the step where an event cuts it short. What is unknown then is a share of
  /// the whole step's terms: a state on a guard is no better known than the time that it came
  /// there.
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

  /// The state, from where its velocity is known.
  void follow(double length) {
    double* numbers = state_.numbers.data();
    if (flow_->longest) {
      flow_->longest->advance(flow_->flow, velocity_, length, numbers);
    } else {
      flow_->flow.advance(velocity_, length, numbers, scratch_);
    }
  }

  /// Where the state is farther beside the guard than its numbers make necessary: a little along
  /// the motion, until it is there, by Newton's method. Each event takes the guard for 0 as its
  /// mode begins, so that else what is left would be there for ever.
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
    change(EventKind::transition, which, transition.reset, mode_->transitions[which],
           transition.target);
    if (!stopped_) follow_sequence();
  }

  void change(EventKind kind, std::size_t transition, const Reset& reset, const PreparedJump& jump,
              std::size_t otherwise, const Vector* addition = nullptr) {
    std::vector<Event>& events = trajectory_.events_;
    Event& event = events.emplace_back(
        Event{time_, kind, state_.mode, transition, otherwise, state_.numbers, state_.numbers});
    jump.reset.apply(reset, event.before, event.after, noise_, noise_before_);
    if (addition != nullptr) event.after += *addition;
    state_.numbers = event.after;
    noise_ += sum_rounding * state_.numbers.cwiseAbs();
    event.mode_after = target_among(jump.alternatives, otherwise);
    state_.mode = event.mode_after;
    count_at_instant();
    note_recurrences();
    enter_mode();
    if (events.size() >= options_.event_limit) stop(StopReason::event_limit);
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
    const std::vector<Transition>& transitions = mode_->mode().transitions;
    signs_.resize(transitions.size());
    zero_at_start_.clear();
    zero_at_end_.clear();
    for (std::size_t i = 0; i < transitions.size(); ++i) {
      const Direction direction = transitions[i].direction;
      signs_[i] = direction == Direction::either   ? 0.0
                  : direction == Direction::rising ? -1.0
                                                   : 1.0;
    }
  }

  void count_at_instant() {
    const std::vector<Event>& events = trajectory_.events_;
    const bool same = events.size() > 1 && events[events.size() - 2].time == time_;
    at_instant_ = same ? at_instant_ + 1 : 1;
    if (at_instant_ > 8 + 4 * (system_.mode_count() + system_.clocks.size())) {
      stop(has_come_ever_faster() ? StopReason::zeno : StopReason::chattering);
    }
  }

  /// Of an event that is none of a clock.
  const Transition& transition_of(const Event& event) const {
    return preparation_.mode(event.mode).mode().transitions[event.transition];
  }

  // ---- events that come ever faster -------------------------------------------------------------

  /// In how many events in a row each was that of so many events before.
  void note_recurrences() {
    const std::vector<Event>& events = trajectory_.events_;
    for (std::size_t turn = 1; turn <= longest_turn; ++turn) {
      std::size_t& count = recurrences_[turn - 1];
      const bool recurs = events.size() > turn && events.back().kind == EventKind::transition &&
                          is_same(events.back(), events[events.size() - 1 - turn]);
      count = recurs ? count + 1 : 0;
    }
  }

  static bool is_same(const Event& a, const Event& b) {
    return a.mode == b.mode && a.transition == b.transition && a.kind == b.kind &&
           a.mode_after == b.mode_after;
  }

  /// How long the turn took that ended so many turns ago.
  double duration(std::size_t turn, std::size_t ago) const {
    const std::vector<Event>& events = trajectory_.events_;
    const std::size_t last = events.size() - 1 - ago * turn;
    return events[last].time - events[last - turn].time;
  }

  /// How many whole turns of the sequence the last one follows. Precondition: it has recurred.
  std::size_t turns_before(std::size_t turn) const { return (recurrences_[turn - 1] - 1) / turn; }

  /// The shortest turn of events that has recurred often enough, or 0.
  std::size_t recurring_turn(std::size_t enough) const {
    for (std::size_t turn = 1; turn <= longest_turn; ++turn) {
      if (recurrences_[turn - 1] >= (enough - 1) * turn) return turn;
    }
    return 0;
  }

  void follow_sequence() {
    if (is_over_at_once()) return settle();
    const std::size_t turn = recurring_turn(8);
    if (turn == 0) return;
    const double interval = duration(turn, 0);
    const double before = duration(turn, 1);
    const double ratio = interval / before;
    if (!(ratio < 1.0)) return;
    const double left = interval * ratio / (1.0 - ratio);
    const Event& last = trajectory_.events_.back();
    const Transition& transition = transition_of(last);
    if (!transition.settling) {
      if (left <= 8.0 * epsilon * time_) stop(StopReason::zeno);
      return;
    }
    constexpr double little = 1e-10;
    constexpr double steady = 1e-3;
    const double last_ratio = before / duration(turn, 2);
    const bool is_steady = std::abs(ratio - last_ratio) < steady * (1.0 - ratio);
    const bool is_little = left < little * own_time(last.mode, turn);
    if (is_little && (is_steady || interval <= 8.0 * epsilon * time_)) settle();
  }

  /// Firings that settle and come so fast that times tell no more of them apart: of faces that
  /// hardly rebound there are too few to see a ratio.
  bool is_over_at_once() const {
    const std::size_t turn = recurring_turn(3);
    if (turn == 0 || duration(turn, 0) > 8.0 * epsilon * time_) return false;
    const Event& last = trajectory_.events_.back();
    return transition_of(last).settling.has_value();
  }

  /// What is short beside it is short: the mode's own time, or how long the first turn took.
  double own_time(std::size_t mode, std::size_t turn) const {
    const double rate = preparation_.mode(mode).whole.flow.rate();
    const double first = duration(turn, turns_before(turn));
    return rate > 0.0 ? std::max(first, 1.0 / rate) : first;
  }

  /// Whether the turns before this instant, where there is no end of events, were each shorter than
  /// the one before.
  bool has_come_ever_faster() const {
    const std::size_t turn = recurring_turn(4);
    if (turn == 0) return false;
    const std::size_t turns = turns_before(turn);
    std::size_t shorter = 0;
    for (std::size_t ago = 0; ago < turns; ++ago) {
      if (duration(turn, ago) == 0.0) continue;
      if (!(duration(turn, ago) < duration(turn, ago + 1))) break;
      ++shorter;
    }
    return shorter >= 3;
  }

  void settle() {
    const Event last = trajectory_.events_.back();
    const Settling& settling = *transition_of(last).settling;
    change(EventKind::settling, last.transition, settling.reset,
           *preparation_.mode(last.mode).settlings[last.transition], settling.target);
  }

  void stop(StopReason reason) {
    stopped_ = true;
    trajectory_.stop_reason_ = reason;
    const std::vector<Event>& events = trajectory_.events_;
    if (events.empty() || reason == StopReason::diverged) return;
    const Event& last = events.back();
    const Mode& mode = preparation_.mode(last.mode).mode();
    trajectory_.culprit_ = mode.name + ": " +
                           (last.kind == EventKind::timed ? mode.timed[last.transition].name
                                                          : mode.transitions[last.transition].name);
  }

  static constexpr double largest_number = 1e150;

  static constexpr std::size_t longest_turn = 4;

  const Preparation& preparation_;
  const HybridSystem& system_;
  const SimulationOptions& options_;
  const PreparedMode* mode_ = nullptr;
  const PreparedFlow* flow_ = nullptr;        ///< of the step
  const PreparedMode::Slow* slow_ = nullptr;  ///< where that is the slow one
  int steps_in_mode_ = 0;
  int steps_in_largest_ = 0;
  State state_;
  double time_;
  Vector noise_;               ///< what rounding has left unknown of each number, on the last step
  Vector largest_;             ///< each number's size since the mode was entered
  std::vector<double> signs_;  ///< of the sides that guards are to leave, 0 while unknown
  double touch_within_ = 0.0;  ///< how well the guard is known of which the last terms were asked
  std::vector<std::size_t> zero_at_start_;  ///< guards that the step before brought down to 0
  std::vector<std::size_t> zero_at_end_;    ///< and those that this one does
  std::vector<Tick> ticks_;
  Velocity velocity_;  ///< at the start of the step
  int order_ = 0;
  double table_share_ = 1.0;    ///< of the step in that of the tables
  double remainder_ = 0.0;      ///< of the step's series
  std::vector<Touch> touches_;  ///< within the step, or beyond its end
  std::vector<double> coefficients_;
  std::vector<double> scratch_;
  Vector noise_before_;
  bool stopped_ = false;
  std::size_t at_instant_ = 0;
  std::array<std::size_t, longest_turn> recurrences_{};  ///< by the length of a turn, from 1 on
  Trajectory trajectory_;
};

Trajectory simulate(const HybridSystem& system, const State& start,
                    const SimulationOptions& options) {
  RangeCheck check;
  check.include(faults(system)).include(faults_of(system, start, options));
  require_none(check.violations());
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

}  // namespace gearlash::hybrid
