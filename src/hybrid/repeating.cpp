#include "hybrid/repeating.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "numeric/linear_algebra.hpp"

namespace gearlash::hybrid {
namespace {

/// Rounds that are worth a jump, and those of the longest one, as powers of 2.
constexpr std::size_t least_level = 3;
constexpr std::size_t most_level = 12;

/// Calls visit(form) for the guards of a mode and what an observer watches.
template <class Visit>
void for_each_guard(const AffineMode& mode, const MotionObserver& observer, Visit&& visit) {
  for (const Transition& transition : mode.transitions) visit(transition.guard);
  for (const AffineForm& form : observer.watched()) visit(form);
}

/// Bound of the rounding in a form's value.
double rounding_of(const AffineForm& form, const Vector& state) {
  return sum_rounding * form.size_at(state);
}

/// How far the forms of a tick's alternatives are from another choice. All of the one that is taken
/// stay positive; of each before it one that is not positive stays so, that with the widest margin.
void add_margins_of(const std::vector<Alternative>& alternatives, const Vector& state,
                    Vector& margins, Eigen::Index& next) {
  bool is_taken = false;
  for (const Alternative& alternative : alternatives) {
    const Eigen::Index first = next;
    Eigen::Index widest = -1;
    for (const AffineForm& form : alternative.positive) {
      const double value = form.at(state);
      margins[next] = std::abs(value) - rounding_of(form, state);
      if (!(value > 0.0) && (widest < 0 || margins[next] > margins[widest])) widest = next;
      ++next;
    }
    for (Eigen::Index i = first; i < next; ++i) {
      if (is_taken || (widest >= 0 && i != widest)) margins[i] = infinity;
    }
    is_taken = is_taken || widest < 0;
  }
}

/// How far a measured number is from another reading.
double margin_of(const Quantizer& quantizer, const Vector& state) {
  const double steps = quantizer.measured.at(state) / quantizer.step;
  return quantizer.step * (0.5 - std::abs(steps - std::round(steps))) -
         rounding_of(quantizer.measured, state);
}

}  // namespace

void Repeating::note() {
  const Event& last = events_.back();
  const bool repeats = last.kind == EventKind::timed && last.mode == last.mode_after;
  run_ = repeats ? run_ + 1 : 0;
  if (!repeats) next_try_ = first_try;
}

bool Repeating::pass_over(bool stands) {
  const bool is_first = stands && next_try_ == first_try;
  if (run_ < (is_first ? first_try_standing : next_try_)) return false;
  if (events_.back().time != now_.time) return false;
  next_try_ = run_ + run_ / 2 + 1;  // unless this succeeds
  const auto length = length_of_round();
  Round* round = length ? round_of(*length) : nullptr;
  if (round == nullptr) return false;
  if (!find_margins(*round)) return false;
  const Vector& here = events_.back().after;
  change_ = here - events_[events_.size() - 1 - *length].after;
  moved_ = change_.cwiseAbs() + sum_rounding * here.cwiseAbs();
  const double period = ticks_.common_period();
  for (std::size_t i = std::min(level_ + 1, most_level); i >= least_level; --i) {
    const std::size_t rounds = std::size_t{1} << i;
    if (!(now_.time + (static_cast<double>(rounds) + 1.0) * period < until_)) continue;
    const Level& by = level(*round, i);
    product_.noalias() = by.sizes * moved_;
    round->by_a_jump.noalias() = round->deviations * product_;
    // A NaN does not compare.
    if (!(round->by_a_jump.array() < round->margins.array()).all()) continue;
    level_ = i;
    jump(by, rounds, round->map);
    // The next jump needs a round of its own.
    run_ = 0;
    next_try_ = *length + 1;
    return true;
  }
  level_ = least_level;
  return false;
}

/// The number of ticks within the last period, if a tick was there a period ago.
std::optional<std::size_t> Repeating::length_of_round() const {
  if (!ticks_.are_regular()) return std::nullopt;
  const double period = ticks_.common_period();
  if (period == 0.0 || events_.empty()) return std::nullopt;
  const double close = 1e-6 * period;
  const double since = events_.back().time - period;
  for (std::size_t length = 1; length <= run_ && length < events_.size(); ++length) {
    const Event& event = events_[events_.size() - 1 - length];
    if (event.time > since + close) continue;
    const bool is_one = event.time > since - close && event.mode_after == now_.state.mode &&
                        event.transition == events_.back().transition;
    return is_one ? std::optional(length) : std::nullopt;
  }
  return std::nullopt;
}

/// The prepared round of the last ticks; null if the mode's ends with another tick.
Repeating::Round* Repeating::round_of(std::size_t length) {
  transitions_.clear();
  for (auto event = events_.end() - static_cast<std::ptrdiff_t>(length); event != events_.end();
       ++event) {
    transitions_.push_back(event->transition);
  }
  const auto found = rounds_.find(now_.state.mode);
  if (found == rounds_.end()) {
    return &rounds_.emplace(now_.state.mode, made(transitions_)).first->second;
  }
  if (found->second.transitions != transitions_) {
    next_try_ = run_ + 1;  // the right one comes soon
    return nullptr;
  }
  return &found->second;
}

/// Of the last round. From the clocks, because differences of large times are rounded.
std::vector<double> Repeating::lengths_of(const std::vector<std::size_t>& transitions) const {
  const double period = ticks_.shared_period();
  std::vector<double> lengths;
  double sum = 0.0;
  for (std::size_t i = 1; i < transitions.size(); ++i) {
    const std::vector<TimedTransition>& timed = now_.mode->mode().timed;
    const double between =
        ticks_.first(timed[transitions[i]].clock) - ticks_.first(timed[transitions[i - 1]].clock);
    const std::size_t event = events_.size() - transitions.size() + i;
    const double seen = events_[event].time - events_[event - 1].time;
    lengths.push_back(between + period * std::round((seen - between) / period));
    sum += lengths.back();
  }
  lengths.insert(lengths.begin(), ticks_.common_period() - sum);
  return lengths;
}

Repeating::Round Repeating::made(const std::vector<std::size_t>& transitions) const {
  const AffineMode& mode = now_.mode->mode();
  const Matrix& flow = mode.flow.matrix;
  const Eigen::Index size = flow.rows();
  Round round{.transitions = transitions};
  const std::vector<double> lengths = lengths_of(transitions);
  std::vector<Vector> deviations;
  std::vector<Vector> reaches;
  const Vector none = Vector::Zero(size);
  Matrix so_far = Matrix::Identity(size, size);
  for (std::size_t i = 0; i < transitions.size(); ++i) {
    const double length = lengths[i];
    const Matrix growth = exponential(flow.cwiseAbs() * length);
    const Matrix sizes = growth * so_far.cwiseAbs();
    const Matrix reach = length * growth;  // the growth rises with time
    for_each_guard(mode, observer_, [&](const AffineForm& form) {
      const Vector normal = form.normal.cwiseAbs();
      deviations.emplace_back(sizes.transpose() * normal);
      reaches.emplace_back(reach.transpose() * normal);
    });
    const TimedTransition& tick = mode.timed[transitions[i]];
    so_far = exponential(flow * length) * so_far;
    for (const Quantizer& quantizer : tick.reset.quantizers) {
      deviations.emplace_back((so_far.transpose() * quantizer.measured.normal).cwiseAbs());
      reaches.push_back(none);
    }
    so_far = tick.reset.slope(size) * so_far;
    for (const Alternative& alternative : tick.alternatives) {
      for (const AffineForm& form : alternative.positive) {
        deviations.emplace_back((so_far.transpose() * form.normal).cwiseAbs());
        reaches.push_back(none);
      }
    }
  }
  round.map = so_far;
  round.deviations.resize(static_cast<Eigen::Index>(deviations.size()), size);
  round.reaches.resize(round.deviations.rows(), size);
  for (Eigen::Index i = 0; i < round.deviations.rows(); ++i) {
    round.deviations.row(i) = deviations[static_cast<std::size_t>(i)].transpose();
    round.reaches.row(i) = reaches[static_cast<std::size_t>(i)].transpose();
  }
  const Matrix one = Matrix::Identity(size, size);
  round.levels.push_back({round.map, one, one});
  return round;
}

/// By how much each form may change before it matters, seen in the last round. False if one is too
/// near already.
bool Repeating::find_margins(Round& round) {
  const AffineMode& mode = now_.mode->mode();
  Vector& margins = round.margins;
  margins.resize(round.deviations.rows());
  Eigen::Index next = 0;
  const std::size_t before = events_.size() - 1 - round.transitions.size();
  for (std::size_t i = 0; i < round.transitions.size(); ++i) {
    const Vector& start = events_[before + i].after;
    product_.noalias() = mode.flow.matrix * start;
    speed_ = (product_ + mode.flow.offset).cwiseAbs();
    for_each_guard(mode, observer_, [&](const AffineForm& form) {
      const double reach = round.reaches.row(next).dot(speed_);
      const double margin = std::abs(form.at(start)) - reach - rounding_of(form, start);
      // A form that is 0 may stay so, as the speed of what stands.
      margins[next++] = margin == 0.0 ? std::numeric_limits<double>::min() : margin;
    });
    const Event& event = events_[before + i + 1];
    const TimedTransition& tick = mode.timed[event.transition];
    for (const Quantizer& quantizer : tick.reset.quantizers) {
      margins[next++] = margin_of(quantizer, event.before);
    }
    add_margins_of(tick.alternatives, event.after, margins, next);
  }
  return (margins.array() > 0.0).all();
}

const Repeating::Level& Repeating::level(Round& round, std::size_t index) const {
  while (round.levels.size() <= index) {
    const Level& half = round.levels.back();
    round.levels.push_back({half.power * half.power, half.sum + half.power * half.sum,
                            half.sizes + half.power.cwiseAbs() * half.sizes});
  }
  return round.levels[index];
}

void Repeating::jump(const Level& by, std::size_t rounds, const Matrix& map) {
  before_ = now_.state.numbers;
  product_.noalias() = by.sum * change_;
  now_.state.numbers.noalias() += map * product_;
  const double time = now_.time + static_cast<double>(rounds) * ticks_.common_period();
  ticks_.pass_over(rounds);
  observer_.moved(now_.time, time, before_, now_.state.numbers);
  now_.time = time;
  now_.noise = sum_rounding * now_.state.numbers.cwiseAbs();
}

}  // namespace gearlash::hybrid
