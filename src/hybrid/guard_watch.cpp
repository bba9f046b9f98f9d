#include "hybrid/guard_watch.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace gearlash::hybrid {

void GuardWatch::enter(const AffineMode& mode) {
  signs_.resize(mode.transitions.size());
  zero_at_start_.clear();
  zero_at_end_.clear();
  for (std::size_t i = 0; i < mode.transitions.size(); ++i) {
    const Direction direction = mode.transitions[i].direction;
    signs_[i] = direction == Direction::either ? 0.0 : direction == Direction::rising ? -1.0 : 1.0;
  }
}

StepEnd GuardWatch::next_exit(const StepSeries& step) {
  zero_at_start_.swap(zero_at_end_);
  for (const bool roughly : {true, false}) {
    touches_.clear();
    zero_at_end_.clear();
    StepEnd next;
    std::size_t exits = 0;
    bool is_rough = false;
    for (std::size_t i = 0; i < step.mode.guards.size(); ++i) {
      const StepExit exit = exit_of(step, i, roughly);
      if (exit.touch || !zero_at_start_.empty()) note_touch(step, i, exit);
      if (!exit.at) continue;
      ++exits;
      is_rough = is_rough || exit.within > 0.0;
      if (*exit.at < next.share) next = {*exit.at, i, exit.within};
    }
    if (exits <= 1 || !is_rough) return next;
  }
  return {};
}

bool GuardWatch::are_clear(const PreparedMode& mode, const double* numbers, const double* noise,
                           const Vector& quiet) const {
  for (std::size_t i = 0; i < mode.guards.size(); ++i) {
    const double value = mode.guards[i].at(numbers);
    const double unknown = mode.guards[i].noise_at(numbers, noise);
    if (signs_[i] * value > unknown) continue;
    const bool is_quiet =
        quiet.size() > 0 && std::abs(value) <= unknown && value == mode.guards[i].at(quiet.data());
    if (!is_quiet) return false;
  }
  return true;
}

/// When a guard leaves its side within the step. If `roughly`, by its leading terms alone where
/// these decide.
inline GuardWatch::StepExit GuardWatch::exit_of(const StepSeries& step, std::size_t guard,
                                                bool roughly) {
  const SparseForm& form = step.mode.guards[guard];
  const GuardTable& table = step.flow.guards[guard];
  double& sign = signs_[guard];
  const double value = form.at(step.state.numbers.data());
  const double unknown = form.noise_at(step.state.numbers.data(), step.noise.data());
  const double farthest = table.reach(step.velocity, step.table_share) + unknown;
  if (sign * value > farthest) return {};
  if (sign == 0.0 && std::abs(value) > farthest) {  // its side is the one that it is on first
    sign = std::copysign(1.0, value);
    return {};
  }
  if (roughly && table.few_orders() < step.order) {
    const auto exit = exit_by(step, table, value, unknown, sign, table.few_orders());
    if (exit) return *exit;
  }
  return exit_by(step, table, value, unknown, sign, step.order).value_or(StepExit{});
}

/// When a guard leaves its side, by the terms up to order `last`. Empty if these do not decide, or
/// if none of them counts because the motion stays on the guard.
std::optional<GuardWatch::StepExit> GuardWatch::exit_by(const StepSeries& step,
                                                        const GuardTable& table, double value,
                                                        double unknown, double& sign, int last) {
  const double share = step.table_share;
  coefficients_.resize(static_cast<std::size_t>(step.order) + 4);
  table.coefficients(step.velocity, share, last, coefficients_.data());
  coefficients_[0] = value;
  const int first = first_that_counts(step, table, unknown, last);
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
  const bool is_whole = last == step.order;
  const int from = std::max(first, 1);
  const double uncertainty = (is_whole ? table.uncertainty(step.velocity, share, from, step.order)
                                       : table.bound_of_uncertainty(step.velocity, share, from)) +
                             table.beyond(step.velocity, share, last) +
                             (first == 0 ? unknown : 0.0);
  if (is_whole) {
    touch_within_ = (1.0 + negligible_share) * uncertainty;
    return StepExit{first_exit(series, uncertainty)};
  }
  const auto rough = rough_exit(series, uncertainty, step.order);
  if (!rough) return std::nullopt;
  // The time after which a motion that begins on the guard returns to it is known better from all
  // terms than from the state there.
  if (rough->at && first > 0) return std::nullopt;
  return StepExit{{rough->at, std::nullopt}, rough->within};
}

/// Order of the first derivative that is not 0 within rounding, or last + 1 if there is none.
/// Starting the series at this order divides out a zero at the start.
int GuardWatch::first_that_counts(const StepSeries& step, const GuardTable& table, double unknown,
                                  int last) const {
  if (std::abs(coefficients_[0]) > unknown) return 0;
  for (int order = 1; order <= last; ++order) {
    const double size = std::abs(coefficients_[static_cast<std::size_t>(order)]);
    if (size > table.uncertainty_of(step.velocity, step.table_share, order)) return order;
  }
  return last + 1;
}

/// If a guard comes down to 0 at the end of a step, the next step decides whether it touches or
/// leaves its side. Not inlined, because it is rare: the loop over guards stays small.
[[gnu::noinline]] void GuardWatch::note_touch(const StepSeries& step, std::size_t guard,
                                              const StepExit& exit) {
  if (exit.touch == 1.0) {
    zero_at_end_.push_back(guard);
  } else if (exit.touch) {
    touches_.push_back(
        {step.time + *exit.touch * step.length, step.state.mode, guard, touch_within_});
  }
  const double* numbers = step.state.numbers.data();
  const double value = std::abs(step.mode.guards[guard].at(numbers));
  const double unknown = step.mode.guards[guard].noise_at(numbers, step.noise.data());
  const auto came_down = std::count(zero_at_start_.begin(), zero_at_start_.end(), guard);
  if (came_down == 0 || exit.at == 0.0 || value > unknown) return;
  touches_.push_back({step.time, step.state.mode, guard, unknown});
}

}  // namespace gearlash::hybrid
