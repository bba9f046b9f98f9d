#include "hybrid/shooting.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/lists.hpp"
#include "base/special_numbers.hpp"
#include "numeric/linear_algebra.hpp"

namespace gearlash::hybrid {
namespace {

using Index = Eigen::Index;

/// Whether a flow moves numbers by more than rounding.
bool is_moved(const AffineFlow& flow, const Vector& numbers) {
  constexpr double rounding = 16.0 * std::numeric_limits<double>::epsilon();
  const Vector terms = flow.matrix.cwiseAbs() * numbers.cwiseAbs() + flow.offset.cwiseAbs();
  return (flow.velocity(numbers).array().abs() > rounding * terms.array()).any();
}

/// The period of what moves by itself, near the given one, by Newton's method on its distance from
/// its start. The given one if it does not return.
double refined_period(const AffineFlow& flow, const Vector& numbers, double period) {
  double refined = period;
  for (int i = 0; i < 20; ++i) {
    const Vector there = flown(flow, numbers, refined);
    const Vector speed = flow.velocity(there);
    refined -= speed.dot(there - numbers) / speed.squaredNorm();
  }
  return refined > 0.5 * period && refined < 2.0 * period ? refined : period;
}

double duration_of(const std::vector<Passage>& passages) {
  double time = 0.0;
  for (const Passage& passage : passages) time += passage.duration;
  return time;
}

/// Whether clocks that tick at some ticks of others alone are after a time as they were.
bool has_whole_rounds(const HybridSystem& system, double time) {
  constexpr double rounding = 1e-6;
  return all_of(system.clocks, [&](const Clock& clock) {
    if (clock.every == 1) return true;
    const double rounds = time / (clock.period * static_cast<double>(clock.every));
    return std::abs(rounds - std::round(rounds)) <= rounding;
  });
}

}  // namespace

bool has_periodic_clocks(const HybridSystem& system) {
  return any_of(system.clocks, [](const Clock& clock) { return clock.period > 0.0; });
}

Shooting::Shooting(const PreparedSystem& system, const State& start, double start_time,
                   double period)
    : system_(system),
      first_mode_(start.mode),
      has_clocks_(has_periodic_clocks(system.system())),
      start_time_(start_time),
      period_(period),
      anchor_(start.numbers) {
  find_exogenous();
}

void Shooting::find_exogenous() {
  const AffineFlow& flow = system_.system().mode(first_mode_).flow;
  is_exogenous_ = system_.exogenous();
  exogenous_flow_ = {Matrix::Zero(size(), size()), Vector::Zero(size())};
  for (Index n = 0; n < size(); ++n) {
    if (is_exogenous_[static_cast<std::size_t>(n)]) {
      exogenous_flow_.matrix.row(n) = flow.matrix.row(n);
      exogenous_flow_.offset[n] = flow.offset[n];
    } else {
      anchor_[n] = 0.0;
    }
  }
  moves_by_itself_ = is_moved(exogenous_flow_, anchor_);
  if (!moves_by_itself_) return;
  period_ = refined_period(exogenous_flow_, anchor_, period_);
  constexpr double rounding = 1e-9;
  returns_by_itself_ = largest_entry(flown(exogenous_flow_, anchor_, period_) - anchor_) <=
                       rounding * largest_entry(anchor_);
}

Shooting Shooting::of(const PreparedSystem& system) const {
  Shooting other = *this;
  other.system_ = system;
  other.find_exogenous();
  return other;
}

std::optional<Shooting> Shooting::about(const PreparedSystem& system, const State& start,
                                        double start_time, double period, std::size_t events,
                                        std::size_t phases) {
  Shooting shooting(system, start, start_time, period);
  if (!shooting.returns_by_itself_ || !has_whole_rounds(system.system(), period)) {
    return std::nullopt;
  }
  const auto over_a_period = [&](const State& first) {
    const double from = shooting.has_clocks_ ? shooting.start_time_ : 0.0;
    return simulate(system, first,
                    {.from = from,
                     .until = from + shooting.period_,
                     .event_limit = events + 1,
                     .step_limit = most_steps_of_a_shot});
  };
  Trajectory motion = over_a_period(start);
  const auto is_as_expected = [&] {
    return motion.stop_reason() == StopReason::reached_end && motion.events().size() == events;
  };
  if (!is_as_expected()) return std::nullopt;
  // Moves the start to about midway between the last event and the first one.
  const double first = motion.events().front().time - motion.start_time();
  const double last = motion.events().back().time - motion.start_time() - shooting.period_;
  const double aside = 0.5 * (first + last);
  constexpr double far = 0.1;
  if (std::abs(aside) <= far * (first - last)) {
    shooting.divide(motion, phases);
    return shooting;
  }
  const double later = aside < 0.0 ? aside + shooting.period_ : aside;
  const State middle = motion.at(motion.start_time() + later);
  shooting.start_time_ += later;
  shooting.anchor_ = middle.numbers;
  shooting.find_exogenous();
  motion = over_a_period(middle);
  if (!is_as_expected()) return std::nullopt;
  shooting.divide(motion, phases);
  return shooting;
}

void Shooting::divide(const Trajectory& motion, std::size_t phases) {
  const std::vector<Event>& events = motion.events();
  // Phases start midway in the longest intervals between events; `order` holds the events before.
  std::vector<std::size_t> order = indices(events.empty() ? 0 : events.size() - 1);
  const auto interval = [&](std::size_t i) { return events[i + 1].time - events[i].time; };
  sort_by(order, [&](std::size_t i) { return -interval(i); });
  constexpr double least_share = 0.05;  // of the period
  while (!order.empty() &&
         (order.size() + 1 > phases || interval(order.back()) < least_share * period_)) {
    order.pop_back();
  }
  std::sort(order.begin(), order.end());
  std::vector<double> times = {motion.start_time()};
  std::vector<std::size_t> passed = {0};
  for (const std::size_t i : order) {
    times.push_back(0.5 * (events[i].time + events[i + 1].time));
    passed.push_back(i + 1);
  }
  passed.push_back(events.size());
  constexpr double least = 1e-100;  // for numbers that stay 0; its square is not 0
  Vector sizes = Vector::Constant(size(), least);
  constexpr int samples = 32;  // to estimate each number's largest magnitude
  for (int i = 0; i < samples; ++i) {
    const double time = motion.start_time() + period_ * i / samples;
    sizes = sizes.cwiseMax(motion.at(time).numbers.cwiseAbs());
  }
  const Index size = this->size();
  unknowns_ = Vector::Zero(static_cast<Index>(times.size()) * size + (has_shift() ? 1 : 0));
  for (std::size_t i = 0; i < times.size(); ++i) {
    const State here = motion.at(times[i]);
    const AffineFlow& flow = system_.system().mode(here.mode).flow;
    const Vector normal = (flow.velocity(here.numbers).array() / sizes.array().square()).matrix();
    phases_.push_back({times[i] - motion.start_time(),
                       here.mode,
                       {normal, -normal.dot(here.numbers)},
                       passed[i + 1] - passed[i]});
    unknowns_.segment(static_cast<Index>(i) * size, size) = here.numbers;
  }
}

State Shooting::start_of(std::size_t phase) const {
  const Index size = this->size();
  return {phases_[phase].mode, unknowns_.segment(static_cast<Index>(phase) * size, size)};
}

double Shooting::mismatch(const Equations& equations) const {
  const Index numbers = static_cast<Index>(phases_.size()) * size();
  const double of_numbers = largest_entry(equations.residual.head(numbers)) / scale();
  return has_shift() ? std::max(of_numbers, std::abs(equations.residual[numbers]) / period_)
                     : of_numbers;
}

double Shooting::scale() const {
  return largest_entry(unknowns_.head(static_cast<Index>(phases_.size()) * size()));
}

std::optional<Passage> Shooting::pass_from(std::size_t phase) const {
  const bool is_last = phase + 1 == phases_.size();
  const Phase& here = phases_[phase];
  const Phase& next = phases_[is_last ? 0 : phase + 1];
  const double from = has_clocks_ ? start_time_ + here.time : 0.0;
  const double length = (is_last ? period_ : next.time) - here.time;
  Finish finish{std::nullopt, from + length};
  if (!has_clocks_) finish.plane = next.plane;
  auto passage = pass(system_, start_of(phase), from, here.events, finish);
  if (passage && passage->end.mode != next.mode) return std::nullopt;
  return passage;
}

std::optional<Shooting::Equations> Shooting::evaluate() const {
  Equations equations;
  for (std::size_t i = 0; i < phases_.size(); ++i) {
    auto passage = pass_from(i);
    if (!passage) return std::nullopt;
    equations.passages.push_back(std::move(*passage));
  }
  equations.residual = residual_of(equations.passages);
  equations.slope = slope_of(equations.passages);
  return equations;
}

Vector Shooting::residual_of(const std::vector<Passage>& all) const {
  const Index size = this->size();
  const auto phases = static_cast<Index>(all.size());
  Vector residual = Vector::Zero(unknowns_.size());
  for (Index i = 0; i < phases; ++i) {
    residual.segment(i * size, size) = all[static_cast<std::size_t>(i)].end.numbers -
                                       unknowns_.segment(((i + 1) % phases) * size, size);
  }
  const Vector fixed = flown(exogenous_flow_, anchor_, shift());
  for (Index n = 0; n < size; ++n) {
    if (!is_exogenous_[static_cast<std::size_t>(n)]) continue;
    residual[(phases - 1) * size + n] = unknowns_[n] - fixed[n];
  }
  if (has_shift()) residual[phases * size] = duration_of(all) - period_;
  return residual;
}

Matrix Shooting::slope_of(const std::vector<Passage>& all) const {
  const Index size = this->size();
  const auto phases = static_cast<Index>(all.size());
  const Index count = unknowns_.size();
  Matrix slope = Matrix::Zero(count, count);
  for (Index i = 0; i < phases; ++i) {
    const Index next = (i + 1) % phases;
    slope.block(i * size, i * size, size, size) += all[static_cast<std::size_t>(i)].slope;
    slope.block(i * size, next * size, size, size) -= Matrix::Identity(size, size);
  }
  const Vector drift = exogenous_flow_.velocity(flown(exogenous_flow_, anchor_, shift()));
  for (Index n = 0; n < size; ++n) {
    if (!is_exogenous_[static_cast<std::size_t>(n)]) continue;
    const Index row = (phases - 1) * size + n;
    slope.row(row).setZero();
    slope(row, n) = 1.0;
    if (has_shift()) slope(row, count - 1) = -drift[n];
  }
  if (!has_shift()) return slope;
  for (Index i = 0; i < phases; ++i) {
    slope.row(count - 1).segment(i * size, size) =
        all[static_cast<std::size_t>(i)].duration_slope.transpose();
  }
  return slope;
}

PeriodicOrbit Shooting::orbit(const Equations& solved) const {
  PeriodicOrbit orbit;
  orbit.start = start_of(0);
  orbit.start_time = start_time_;
  orbit.residual = mismatch(solved);
  const bool is_forced = moves_by_itself_ || has_clocks_;
  Matrix product = Matrix::Identity(size(), size());
  for (const Passage& passage : solved.passages) {
    for (Event event : passage.events) {
      event.time += has_clocks_ ? -start_time_ : orbit.period;
      orbit.events.push_back(std::move(event));
    }
    orbit.period += passage.duration;
    product = (is_forced ? passage.slope_at_time : passage.slope) * product;
  }
  std::vector<Index> own;
  for (Index n = 0; n < size(); ++n) {
    if (!is_exogenous_[static_cast<std::size_t>(n)]) own.push_back(n);
  }
  if (own.empty()) return orbit;
  const Matrix of_own = product(own, own);
  const Eigen::VectorXcd values = eigenvalues(of_own);
  orbit.multipliers.assign(values.begin(), values.end());
  sort_by(orbit.multipliers, [](const auto& one) { return -std::abs(one); });
  // From plane to plane the multiplier of a shift in time is 0.
  if (!is_forced && !orbit.multipliers.empty()) orbit.multipliers.pop_back();
  return orbit;
}

std::optional<PeriodicOrbit> solved_by_newton(Shooting& shooting, int most_steps) {
  constexpr double good = 1e-13;
  constexpr double acceptable = 1e-10;
  // Newton's method ends if its residual has not halved in this many steps.
  constexpr int patience = 6;
  double last = infinity;
  double least = infinity;
  int since_least = 0;
  for (int step = 0; step < most_steps; ++step) {
    const auto equations = shooting.evaluate();
    if (!equations) return std::nullopt;
    const double size = shooting.mismatch(*equations);
    const bool is_stuck = size > 0.25 * last;
    if (size < good || (is_stuck && size < acceptable)) return shooting.orbit(*equations);
    since_least = size < 0.5 * least ? 0 : since_least + 1;
    if (!std::isfinite(size) || since_least >= patience) return std::nullopt;
    least = std::min(least, size);
    last = size;
    const Vector change = solved_with_full_pivoting(equations->slope, -equations->residual);
    if (!change.allFinite()) return std::nullopt;
    shooting.assign(shooting.unknowns() + change);
  }
  return std::nullopt;
}

}  // namespace gearlash::hybrid
