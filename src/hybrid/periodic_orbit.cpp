#include "gearlash/hybrid/periodic_orbit.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <unsupported/Eigen/MatrixFunctions>

#include "passage.hpp"

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

bool is_same_event(const Event& a, const Event& b) {
  return a.kind == b.kind && a.mode == b.mode && a.transition == b.transition &&
         a.mode_after == b.mode_after;
}

double size_of(const Vector& vector) { return vector.cwiseAbs().maxCoeff(); }

/// Newton's method on all phases at once.
class Shooting {
 public:
  Shooting(const HybridSystem& system, const ShootingOptions& options)
      : system_(system), options_(options), is_exogenous_(exogenous_numbers(system)) {
    const AffineFlow& flow = system.modes.front().flow;
    exogenous_flow_ = Matrix::Zero(system.size(), system.size());
    for (Index i = 0; i < system.size(); ++i) {
      if (is_exogenous_[static_cast<std::size_t>(i)]) exogenous_flow_.row(i) = flow.matrix.row(i);
    }
  }

  /// `counts` events in each phase; the first guess by passing through them.
  std::optional<PeriodicOrbit> run(const State& start, double start_time, double period,
                                   const std::vector<std::size_t>& counts) {
    counts_ = counts;
    start_time_ = start_time;
    anchor_ = start.numbers;
    period_ = refined_period(start.numbers, period);
    starts_ = {start};
    std::vector<Passage> passages;
    for (std::size_t i = 0; i + 1 < counts.size(); ++i) {
      const auto passage = pass_from(i, starts_.back(), time_of(passages));
      if (!passage) return std::nullopt;
      starts_.push_back(passage->end);
      passages.push_back(*passage);
    }
    double last = infinity;
    for (int step = 0; step < options_.most_steps; ++step) {
      const auto all = pass_all();
      if (!all) return std::nullopt;
      const Vector residual = residual_of(*all);
      const double size = size_of(residual) / scale();
      constexpr double good = 1e-13;
      constexpr double acceptable = 1e-10;
      const bool is_stuck = size > 0.25 * last;
      if (size < good || (is_stuck && size < acceptable)) return orbit_of(*all, size);
      if (!std::isfinite(size) || (is_stuck && step > 8 && size > 1e-3)) return std::nullopt;
      last = size;
      if (!improve(*all, residual)) return std::nullopt;
    }
    return std::nullopt;
  }

 private:
  bool moves_by_itself() const {
    const Vector& offset = system_.modes.front().flow.offset;
    for (Index i = 0; i < system_.size(); ++i) {
      if (!is_exogenous_[static_cast<std::size_t>(i)]) continue;
      if (exogenous_flow_.row(i).dot(anchor_) + offset[i] != 0.0) return true;
    }
    return false;
  }

  bool has_clocks() const {
    return std::any_of(system_.clocks.begin(), system_.clocks.end(),
                       [](const Clock& clock) { return clock.period > 0.0; });
  }

  /// A period with which what moves by itself comes back, near the given one: Newton's method on
  /// the distance from where it was.
  double refined_period(const Vector& numbers, double period) const {
    if (!moves_by_itself()) return period;
    for (int i = 0; i < 20; ++i) {
      const Vector there = (exogenous_flow_ * period).exp() * numbers;
      const Vector velocity = exogenous_flow_ * there;
      Vector off = there - numbers;
      for (Index n = 0; n < off.size(); ++n) {
        if (!is_exogenous_[static_cast<std::size_t>(n)]) off[n] = 0.0;
      }
      period -= velocity.dot(off) / velocity.squaredNorm();
    }
    return period;
  }

  static double time_of(const std::vector<Passage>& passages) {
    double time = 0.0;
    for (const Passage& passage : passages) time += passage.duration;
    return time;
  }

  std::optional<Passage> pass_from(std::size_t phase, const State& start, double after) const {
    const double from = has_clocks() ? std::nextafter(start_time_ + after, infinity) : 0.0;
    constexpr double patience = 4.0;  // periods
    return pass(system_, start, from, from + patience * period_, counts_[phase]);
  }

  std::optional<std::vector<Passage>> pass_all() const {
    std::vector<Passage> all;
    for (std::size_t i = 0; i < counts_.size(); ++i) {
      auto passage = pass_from(i, starts_[i], time_of(all));
      if (!passage || passage->end.mode != starts_[(i + 1) % counts_.size()].mode) {
        return std::nullopt;
      }
      all.push_back(std::move(*passage));
    }
    return all;
  }

  double scale() const {
    double scale = 0.0;
    for (const State& start : starts_) scale = std::max(scale, size_of(start.numbers));
    return scale;
  }

  // Unknown are the starts of all phases and, where something moves by itself, how long after the
  // anchor the first one is. Of the last phase's end, what moves by itself is left out; instead it
  // is said where it starts, and how long all takes.

  bool has_shift() const { return moves_by_itself() && !has_clocks(); }

  Vector residual_of(const std::vector<Passage>& all) const {
    const Index size = system_.size();
    const auto phases = static_cast<Index>(all.size());
    Vector residual = Vector::Zero(phases * size + (has_shift() ? 1 : 0));
    for (Index i = 0; i < phases; ++i) {
      const Vector& next = starts_[static_cast<std::size_t>((i + 1) % phases)].numbers;
      residual.segment(i * size, size) = all[static_cast<std::size_t>(i)].end.numbers - next;
    }
    const Vector fixed = (exogenous_flow_ * shift_).exp() * anchor_;
    for (Index n = 0; n < size; ++n) {
      if (!is_exogenous_[static_cast<std::size_t>(n)]) continue;
      residual[(phases - 1) * size + n] = starts_[0].numbers[n] - fixed[n];
    }
    if (has_shift()) residual[phases * size] = time_of(all) - period_;
    return residual;
  }

  Matrix slope_of(const std::vector<Passage>& all) const {
    const Index size = system_.size();
    const auto phases = static_cast<Index>(all.size());
    const Index count = phases * size + (has_shift() ? 1 : 0);
    Matrix slope = Matrix::Zero(count, count);
    for (Index i = 0; i < phases; ++i) {
      const Index next = (i + 1) % phases;
      slope.block(i * size, i * size, size, size) += all[static_cast<std::size_t>(i)].slope;
      slope.block(i * size, next * size, size, size) -= Matrix::Identity(size, size);
    }
    const Vector drift = exogenous_flow_ * ((exogenous_flow_ * shift_).exp() * anchor_);
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

  bool improve(const std::vector<Passage>& all, const Vector& residual) {
    const Vector step = slope_of(all).fullPivLu().solve(-residual);
    if (!step.allFinite()) return false;
    const Index size = system_.size();
    for (std::size_t i = 0; i < starts_.size(); ++i) {
      starts_[i].numbers += step.segment(static_cast<Index>(i) * size, size);
    }
    if (has_shift()) shift_ += step[step.size() - 1];
    return true;
  }

  PeriodicOrbit orbit_of(const std::vector<Passage>& all, double residual) const {
    PeriodicOrbit orbit;
    orbit.start = starts_[0];
    orbit.start_time = start_time_;
    orbit.residual = residual;
    const bool is_forced = moves_by_itself() || has_clocks();
    Matrix product = Matrix::Identity(system_.size(), system_.size());
    for (std::size_t i = 0; i < all.size(); ++i) {
      for (Event event : all[i].events) {
        event.time += orbit.period - (has_clocks() ? start_time_ + orbit.period : 0.0);
        orbit.events.push_back(std::move(event));
      }
      orbit.period += all[i].duration;
      product = (is_forced ? all[i].slope_at_time : all[i].slope) * product;
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

  const HybridSystem& system_;
  const ShootingOptions& options_;
  std::vector<bool> is_exogenous_;
  Matrix exogenous_flow_;
  std::vector<std::size_t> counts_;
  double start_time_ = 0.0;
  double period_ = 0.0;
  double shift_ = 0.0;
  Vector anchor_;
  std::vector<State> starts_;
};

/// So many events, shared out over at most so many phases; a phase ends at a tick where
/// `ticks_alone`, and never between a firing and its settling.
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

bool has_periodic_clocks(const HybridSystem& system) {
  return std::any_of(system.clocks.begin(), system.clocks.end(),
                     [](const Clock& clock) { return clock.period > 0.0; });
}

}  // namespace

bool PeriodicOrbit::is_stable() const {
  return std::all_of(multipliers.begin(), multipliers.end(),
                     [](const auto& multiplier) { return std::abs(multiplier) < 1.0; });
}

std::optional<PeriodicOrbit> closing_orbit(const HybridSystem& system, const Trajectory& motion,
                                           const ShootingOptions& options) {
  const std::vector<Event>& events = motion.events();
  const bool ticks_alone = has_periodic_clocks(system);
  std::size_t last = events.size();
  while (last > 0 && ticks_alone && events[last - 1].kind != EventKind::timed) --last;
  if (last == 0) return std::nullopt;
  --last;
  const Event& end = events[last];
  double scale = 0.0;
  const std::size_t first = last > options.most_events ? last - options.most_events : 0;
  for (std::size_t i = first; i <= last; ++i) scale = std::max(scale, size_of(events[i].after));
  for (std::size_t back = 1; back <= std::min(last, options.most_events); ++back) {
    const Event& begin = events[last - back];
    if (!is_same_event(begin, end) || !(begin.time < end.time)) continue;
    if (size_of(begin.after - end.after) > options.nearness * scale) continue;
    const std::vector<Event> between(events.begin() + static_cast<std::ptrdiff_t>(last - back + 1),
                                     events.begin() + static_cast<std::ptrdiff_t>(last + 1));
    const State start{begin.mode_after, begin.after};
    Shooting shooting(system, options);
    auto orbit = shooting.run(start, begin.time, end.time - begin.time,
                              shared_out(between, options.phases, ticks_alone));
    if (orbit) return orbit;
  }
  return std::nullopt;
}

std::optional<PeriodicOrbit> neighbouring_orbit(const HybridSystem& system,
                                                const PeriodicOrbit& near,
                                                const ShootingOptions& options) {
  Shooting shooting(system, options);
  return shooting.run(near.start, near.start_time, near.period,
                      shared_out(near.events, options.phases, has_periodic_clocks(system)));
}

}  // namespace gearlash::hybrid
