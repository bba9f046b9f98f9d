#include "hybrid/standing.hpp"

#include <algorithm>
#include <cmath>

namespace gearlash::hybrid {

std::size_t Standing::stand() {
  std::size_t repeated = 0;
  if (ticks_.count() == 0 || !ticks_.are_regular()) return repeated;
  const double period = ticks_.common_period();
  Rounds rounds;
  double round_ends = now_.time;
  std::size_t unchanged = 0;
  rounding_ = earlier_rounding_ = Vector::Zero(now_.state.numbers.size());
  constexpr std::size_t most_at_a_time = 4096;
  while (repeated < most_at_a_time && ticks_.next() < until_ && stands_clear()) {
    before_ = now_.state.numbers;
    if (!repeat_ticks(ticks_.next())) {
      now_.state.numbers = before_;
      return repeated;
    }
    ++repeated;
    unchanged = now_.state.numbers == before_ ? unchanged + 1 : 0;
    // Each clock has ticked at least once in this many instants.
    if (unchanged > 2 * ticks_.count() * ticks_.ticks_of_round()) ticks_.pass_before(until_);
    if (period == 0.0 || now_.time < round_ends) continue;
    round_ends = now_.time + (1.0 - 1e-6) * period;
    rounds.add(now_.state.numbers, rounding_);
    earlier_rounding_.swap(rounding_);
    rounding_.setZero();
    constexpr std::size_t enough = 16;
    if (rounds.alike <= enough) continue;
    const double most = rounds.most_to_pass(earlier_rounding_);
    if (most > 0.0) {
      pass_over(rounds, period, most);
    } else {
      rounds.begin_again();
    }
  }
  return repeated;
}

void Standing::Rounds::add(const Vector& numbers, const Vector& rounding) {
  if (last.size() == 0) {
    begin = last = numbers;
    change = Vector::Zero(numbers.size());
    return;
  }
  bool is_alike = true;
  for (Eigen::Index i = 0; i < numbers.size(); ++i) {
    const double step = numbers[i] - last[i];
    is_alike = is_alike && std::abs(step - change[i]) <= rounding[i];
    change[i] = step;
  }
  if (!is_alike) begin = last;
  alike = is_alike ? alike + 1 : 1;
  last = numbers;
}

double Standing::Rounds::most_to_pass(const Vector& rounding) const {
  constexpr double clearly = 8.0;
  const Vector mean = mean_change(rounding);
  double most = infinity;
  for (Eigen::Index i = 0; i < mean.size(); ++i) {
    if (mean[i] == 0.0) continue;
    // A decay changes ever less.
    const bool is_steady = std::abs(change[i] - mean[i]) <= 2.0 * rounding[i];
    if (!is_steady || !(std::abs(mean[i]) > clearly * rounding[i])) return 0.0;
    most = std::min(most, static_cast<double>(alike) * std::abs(mean[i]) / rounding[i]);
  }
  return most;
}

/// Until a guard or an alternative comes to 0, or the motion ends.
double Standing::rounds_before_a_change(const Vector& change, double period) const {
  const Vector next = now_.state.numbers + change;
  double most = (until_ - now_.time) / period;
  const auto keep = [&](const SparseForm& form) {
    const double value = form.at(now_.state.numbers.data());
    const double rate = form.at(next.data()) - value;
    if (rate * value < 0.0) most = std::min(most, -value / rate);
  };
  for (const SparseForm& guard : now_.mode->guards) keep(guard);
  for (const PreparedJump& jump : now_.mode->timed) {
    for (const PreparedAlternative& alternative : jump.alternatives) {
      for (const SparseForm& form : alternative.positive) keep(form);
    }
  }
  return most;
}

/// Passes over rounds that change the numbers alike, up to some before a guard or an alternative
/// comes near 0. The ticks are affine and nothing that is read moves, so a change that has repeated
/// goes on repeating.
void Standing::pass_over(Rounds& rounds, double period, double at_most) {
  // In rounds. Between the ticks of one the numbers differ from those at its end.
  constexpr double margin = 8.0;
  const Vector change = rounds.mean_change(earlier_rounding_);
  const double most = std::min(at_most, rounds_before_a_change(change, period));
  if (!(most > 2.0 * margin)) return;
  const double passed = std::floor(most - margin);
  before_ = now_.state.numbers;
  now_.state.numbers += passed * change;
  const double time = now_.time + passed * period;
  ticks_.pass_over(static_cast<std::size_t>(passed));
  observer_.moved(now_.time, time, before_, now_.state.numbers);
  now_.time = time;
  now_.noise = sum_rounding * now_.state.numbers.cwiseAbs();
  rounds = {};
}

bool Standing::stands_clear() {
  now_.flow->flow.velocity_at(now_.state.numbers.data(), now_.velocity);
  if (quiet_mode_ != now_.state.mode) quiet_.resize(0);
  return now_.is_standing() &&
         guards_.are_clear(*now_.mode, now_.state.numbers.data(), now_.noise.data(), quiet_);
}

/// The sizes of a reset's terms, which may be larger than their sums. A delayed number has those of
/// the one that it copies.
void Standing::note_rounding(const AffineReset& reset, const PreparedReset& prepared) {
  for (const Quantizer& quantizer : reset.quantizers) {
    const double reading = std::abs(quantizer.reading(ticked_));
    rounding_ += sum_rounding * reading * quantizer.gain.cwiseAbs();
  }
  for (const auto& [number, form] : prepared.rows) {
    if (form.terms.size() != 1 || form.terms.front().number == number) continue;
    const auto& [from, factor] = form.terms.front();
    rounding_[number] = std::max(rounding_[number], std::abs(factor) * earlier_rounding_[from]);
  }
}

/// Applies the ticks at an instant. False, with the state spoilt, if they do not lead back to the
/// mode or to a guard's side.
bool Standing::repeat_ticks(double time) {
  const std::vector<TimedTransition>& timed = now_.mode->mode().timed;
  for (std::size_t i = 0; i < ticks_.count(); ++i) {
    if (!ticks_.is_due(i, time)) continue;
    for (std::size_t k = 0; k < timed.size(); ++k) {
      if (timed[k].clock != i) continue;
      const PreparedJump& jump = now_.mode->timed[k];
      ticked_ = now_.state.numbers;
      jump.reset.apply(timed[k].reset, ticked_, now_.state.numbers, now_.noise, scratch_);
      note_rounding(timed[k].reset, jump.reset);
      if (now_.target_among(jump.alternatives, timed[k].target) != now_.state.mode) return false;
      break;
    }
  }
  rounding_ = rounding_.cwiseMax(now_.noise);
  now_.noise = sum_rounding * now_.state.numbers.cwiseAbs();
  if (!stands_clear()) return false;
  for (std::size_t i = 0; i < ticks_.count(); ++i) {
    if (ticks_.is_due(i, time)) ticks_.pass(i);
  }
  observer_.moved(now_.time, time, before_, now_.state.numbers);
  now_.time = time;
  return true;
}

}  // namespace gearlash::hybrid
