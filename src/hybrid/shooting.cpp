#include "shooting.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <unsupported/Eigen/MatrixFunctions>

namespace gearlash::hybrid {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

using Index = Eigen::Index;

/// Numbers that follow their own flow alone, the same in every mode, and that no event changes.
std::vector<bool> exogenous_numbers(const HybridSystem& system) {
  const auto size = static_cast<std::size_t>(system.size());
  std::vector<bool> is(size, true);
  const auto is_untouched = [&](const Reset& reset, Index i) {
    const bool by_matrix = reset.matrix.size() != 0 &&
                           reset.matrix.row(i) != Vector::Unit(system.size(), i).transpose();
    const bool by_offset = reset.offset.size() != 0 && reset.offset[i] != 0.0;
    return !by_matrix && !by_offset &&
           std::all_of(reset.quantizers.begin(), reset.quantizers.end(),
                       [&](const Quantizer& q) { return q.gain[i] == 0.0; });
  };
  const AffineFlow& first = system.modes.front().flow;
  for (std::size_t n = 0; n < size; ++n) {
    const auto i = static_cast<Index>(n);
    for (const Mode& mode : system.modes) {
      bool same =
          mode.flow.matrix.row(i) == first.matrix.row(i) && mode.flow.offset[i] == first.offset[i];
      for (const Transition& transition : mode.transitions) {
        same = same && is_untouched(transition.reset, i) &&
               (!transition.settling || is_untouched(transition.settling->reset, i));
      }
      for (const TimedTransition& timed : mode.timed) same = same && is_untouched(timed.reset, i);
      if (!same) is[n] = false;
    }
  }
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t n = 0; n < size; ++n) {
      if (!is[n]) continue;
      for (std::size_t k = 0; k < size; ++k) {
        if (is[k] || first.matrix(static_cast<Index>(n), static_cast<Index>(k)) == 0.0) continue;
        is[n] = false;
        changed = true;
      }
    }
  }
  return is;
}

double size_of(const Vector& vector) {
  return vector.size() == 0 ? 0.0 : vector.cwiseAbs().maxCoeff();
}

/// A period with which what moves by itself comes back, near the given one: Newton's method on the
/// distance from where it was.
double refined_period(const Matrix& flow, const Vector& numbers, double period) {
  for (int i = 0; i < 20; ++i) {
    const Vector there = (flow * period).exp() * numbers;
    const Vector velocity = flow * there;
    period -= velocity.dot(there - numbers) / velocity.squaredNorm();
  }
  return period;
}

double duration_of(const std::vector<Passage>& passages) {
  double time = 0.0;
  for (const Passage& passage : passages) time += passage.duration;
  return time;
}

}  // namespace

bool has_periodic_clocks(const HybridSystem& system) {
  return std::any_of(system.clocks.begin(), system.clocks.end(),
                     [](const Clock& clock) { return clock.period > 0.0; });
}

Shooting::Shooting(const HybridSystem& system, const State& start, double start_time, double period,
                   std::vector<std::size_t> counts)
    : system_(system),
      counts_(std::move(counts)),
      modes_(counts_.size(), start.mode),
      is_exogenous_(exogenous_numbers(system)),
      exogenous_flow_(Matrix::Zero(system.size(), system.size())),
      has_clocks_(has_periodic_clocks(system)),
      start_time_(start_time),
      period_(period),
      anchor_(Vector::Zero(system.size())) {
  const AffineFlow& flow = system.modes.front().flow;
  for (Index n = 0; n < system.size(); ++n) {
    if (!is_exogenous_[static_cast<std::size_t>(n)]) continue;
    exogenous_flow_.row(n) = flow.matrix.row(n);
    anchor_[n] = start.numbers[n];
    if (flow.offset[n] != 0.0) moves_by_itself_ = true;
  }
  moves_by_itself_ = moves_by_itself_ || size_of(exogenous_flow_ * anchor_) > 0.0;
  if (moves_by_itself_) period_ = refined_period(exogenous_flow_, anchor_, period);
  const auto phases = static_cast<Index>(counts_.size());
  unknowns_ = Vector::Zero(phases * system.size() + (has_shift() ? 1 : 0));
  unknowns_.head(system.size()) = start.numbers;
}

bool Shooting::follow() {
  double after = 0.0;
  for (std::size_t i = 0; i + 1 < counts_.size(); ++i) {
    const auto passage = pass_from(i, after);
    if (!passage) return false;
    after += passage->duration;
    modes_[i + 1] = passage->end.mode;
    unknowns_.segment(static_cast<Index>(i + 1) * system_.size(), system_.size()) =
        passage->end.numbers;
  }
  return true;
}

State Shooting::start_of(std::size_t phase) const {
  const Index size = system_.size();
  return {modes_[phase], unknowns_.segment(static_cast<Index>(phase) * size, size)};
}

double Shooting::scale() const {
  return size_of(unknowns_.head(static_cast<Index>(counts_.size()) * system_.size()));
}

std::optional<Passage> Shooting::pass_from(std::size_t phase, double after) const {
  const double from = has_clocks_ ? std::nextafter(start_time_ + after, infinity) : 0.0;
  constexpr double patience = 4.0;  // periods
  return pass(system_, start_of(phase), from, from + patience * period_, counts_[phase]);
}

std::optional<Shooting::Equations> Shooting::evaluate() const {
  Equations equations;
  for (std::size_t i = 0; i < counts_.size(); ++i) {
    auto passage = pass_from(i, duration_of(equations.passages));
    if (!passage || passage->end.mode != modes_[(i + 1) % counts_.size()]) return std::nullopt;
    equations.passages.push_back(std::move(*passage));
  }
  equations.residual = residual_of(equations.passages);
  equations.slope = slope_of(equations.passages);
  return equations;
}

Vector Shooting::residual_of(const std::vector<Passage>& all) const {
  const Index size = system_.size();
  const auto phases = static_cast<Index>(all.size());
  Vector residual = Vector::Zero(unknowns_.size());
  for (Index i = 0; i < phases; ++i) {
    residual.segment(i * size, size) = all[static_cast<std::size_t>(i)].end.numbers -
                                       unknowns_.segment(((i + 1) % phases) * size, size);
  }
  const Vector fixed = (exogenous_flow_ * shift()).exp() * anchor_;
  for (Index n = 0; n < size; ++n) {
    if (!is_exogenous_[static_cast<std::size_t>(n)]) continue;
    residual[(phases - 1) * size + n] = unknowns_[n] - fixed[n];
  }
  if (has_shift()) residual[phases * size] = duration_of(all) - period_;
  return residual;
}

Matrix Shooting::slope_of(const std::vector<Passage>& all) const {
  const Index size = system_.size();
  const auto phases = static_cast<Index>(all.size());
  const Index count = unknowns_.size();
  Matrix slope = Matrix::Zero(count, count);
  for (Index i = 0; i < phases; ++i) {
    const Index next = (i + 1) % phases;
    slope.block(i * size, i * size, size, size) += all[static_cast<std::size_t>(i)].slope;
    slope.block(i * size, next * size, size, size) -= Matrix::Identity(size, size);
  }
  const Vector drift = exogenous_flow_ * ((exogenous_flow_ * shift()).exp() * anchor_);
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
  orbit.residual = size_of(solved.residual) / scale();
  const bool is_forced = moves_by_itself_ || has_clocks_;
  Matrix product = Matrix::Identity(system_.size(), system_.size());
  for (const Passage& passage : solved.passages) {
    for (Event event : passage.events) {
      event.time += has_clocks_ ? -start_time_ : orbit.period;
      orbit.events.push_back(std::move(event));
    }
    orbit.period += passage.duration;
    product = (is_forced ? passage.slope_at_time : passage.slope) * product;
  }
  std::vector<Index> own;
  for (Index n = 0; n < system_.size(); ++n) {
    if (!is_exogenous_[static_cast<std::size_t>(n)]) own.push_back(n);
  }
  const Matrix of_own = product(own, own);
  const Eigen::VectorXcd values = of_own.eigenvalues();
  orbit.multipliers.assign(values.begin(), values.end());
  std::sort(orbit.multipliers.begin(), orbit.multipliers.end(),
            [](const auto& a, const auto& b) { return std::abs(a) > std::abs(b); });
  return orbit;
}

std::optional<PeriodicOrbit> solved_by_newton(Shooting& shooting, int most_steps) {
  constexpr double good = 1e-13;
  constexpr double acceptable = 1e-10;
  double last = infinity;
  for (int step = 0; step < most_steps; ++step) {
    const auto equations = shooting.evaluate();
    if (!equations) return std::nullopt;
    const double size = size_of(equations->residual) / shooting.scale();
    const bool is_stuck = size > 0.25 * last;
    if (size < good || (is_stuck && size < acceptable)) return shooting.orbit(*equations);
    if (!std::isfinite(size)) return std::nullopt;
    last = size;
    const Vector change = equations->slope.fullPivLu().solve(-equations->residual);
    if (!change.allFinite()) return std::nullopt;
    shooting.assign(shooting.unknowns() + change);
  }
  return std::nullopt;
}

std::vector<std::size_t> shared_out(const std::vector<Event>& events, std::size_t phases,
                                    bool ticks_alone) {
  std::vector<std::size_t> counts;
  const std::size_t wanted = std::max<std::size_t>(1, (events.size() + phases - 1) / phases);
  std::size_t count = 0;
  for (std::size_t i = 0; i < events.size(); ++i) {
    ++count;
    const bool is_last = i + 1 == events.size();
    const bool may_end = (!ticks_alone || events[i].kind == EventKind::timed) &&
                         !(!is_last && events[i + 1].time == events[i].time);
    if (!is_last && (count < wanted || !may_end)) continue;
    counts.push_back(count);
    count = 0;
  }
  return counts;
}

}  // namespace gearlash::hybrid
