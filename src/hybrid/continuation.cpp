#include "hybrid/continuation.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>

#include "base/lists.hpp"
#include "base/range_check.hpp"
#include "base/special_numbers.hpp"
#include "hybrid/shooting.hpp"
#include "numeric/linear_algebra.hpp"

namespace gearlash::hybrid {
namespace {

using Index = Eigen::Index;

// ---- the end of a branch ------------------------------------------------------------------------

/// How near the orbit is to gaining or losing an event at a guard, or to another mode after one: 0
/// where that happens.
struct Clearance {
  double share = infinity;
  std::string name;

  void consider(double here, const std::string& mode, const std::string& transition) {
    if (!(here < share)) return;
    share = here;
    name = mode + ": " + transition;
  }
};

/// The least distance from a guard where it turns back between two events, or at one of them, over
/// the largest. A stretch that begins or ends on the guard comes from it or goes to it.
double least_share(const AffineForm& guard, const Trajectory& motion, double begin, double end) {
  constexpr int samples = 400;
  std::vector<double> distances;
  for (int i = 0; i <= samples; ++i) {
    const double time = begin + (end - begin) * std::min(i, samples - 1) / samples;
    distances.push_back(std::abs(guard.at(motion.at(time).numbers)));
  }
  const double most = *std::max_element(distances.begin(), distances.end());
  constexpr double on_guard = 1e-9;
  double least = infinity;
  for (std::size_t i = 0; i < distances.size(); ++i) {
    const bool falls = i == 0 || distances[i] <= distances[i - 1];
    const bool rises = i + 1 == distances.size() || distances[i] <= distances[i + 1];
    const bool is_end = i == 0 || i + 1 == distances.size();
    if (!falls || !rises || (is_end && distances[i] <= on_guard * most)) continue;
    least = std::min(least, distances[i] / most);
  }
  return least;
}

/// Of the guards that do not end a stretch of the orbit.
void consider_guards_passed_by(const HybridSystem& system, const Trajectory& motion,
                               const std::vector<Event>& events, Clearance& clearance) {
  double begin = motion.start_time();
  std::size_t mode = motion.at(begin).mode;
  for (const Event& event : events) {
    const AffineMode& here = system.mode(mode);
    for (std::size_t k = 0; k < here.transitions.size(); ++k) {
      if (event.kind == EventKind::transition && event.mode == mode && event.transition == k) {
        continue;
      }
      clearance.consider(least_share(here.transitions[k].guard, motion, begin, event.time),
                         here.name, here.transitions[k].name);
    }
    begin = event.time;
    mode = event.mode_after;
  }
}

/// For each event that may lead to several modes: how near what decides is to 0, as a share of its
/// terms.
void consider_alternatives(const HybridSystem& system, const std::vector<Event>& events,
                           Clearance& clearance) {
  for (const Event& event : events) {
    if (event.kind != EventKind::transition) continue;
    const AffineMode& mode = system.mode(event.mode);
    const Transition& transition = mode.transitions[event.transition];
    for (const Alternative& alternative : transition.alternatives) {
      for (const AffineForm& form : alternative.positive) {
        const double terms = form.size_at(event.after);
        if (terms > 0.0) {
          clearance.consider(std::abs(form.at(event.after)) / terms, mode.name, transition.name);
        }
      }
    }
  }
}

/// For each guard that is met: the speed at which it is met over the highest such speed.
void consider_guards_met(const HybridSystem& system, const std::vector<Event>& events,
                         Clearance& clearance) {
  double highest = 0.0;
  for (const Event& event : events) {
    if (event.kind == EventKind::transition) {
      highest = std::max(highest, speed_at_guard(system, event));
    }
  }
  for (const Event& event : events) {
    if (event.kind != EventKind::transition) continue;
    const AffineMode& mode = system.mode(event.mode);
    clearance.consider(speed_at_guard(system, event) / highest, mode.name,
                       mode.transitions[event.transition].name);
  }
}

Clearance clearance_of(const HybridSystem& system, const PeriodicOrbit& orbit) {
  Clearance clearance;
  const double from =
      has_periodic_clocks(system) ? std::nextafter(orbit.start_time, infinity) : 0.0;
  const Trajectory motion = simulate(
      system, orbit.start,
      {.from = from, .until = from + 2.0 * orbit.period, .event_limit = orbit.events.size()});
  consider_guards_passed_by(system, motion, motion.events(), clearance);
  consider_guards_met(system, motion.events(), clearance);
  consider_alternatives(system, motion.events(), clearance);
  return clearance;
}

// ---- the branch ---------------------------------------------------------------------------------

class Continuation {
 public:
  Continuation(const Family& family, double parameter, const PeriodicOrbit& orbit,
               const ContinuationOptions& options)
      : family_(family), options_(options) {
    parameter_scale_ = parameter == 0.0 ? 1.0 : std::abs(parameter);
    lay_planes({parameter, orbit});
  }

  Branch run() {
    Branch branch;
    if (shooting_) follow(branch);
    if (is_stopped_) branch.end = BranchEnd::stopped;
    return branch;
  }

 private:
  static constexpr std::size_t phases = 4;
  static constexpr double shortest = 1e-9;    // the branch ends at a failing step this short,
  static constexpr double slow_going = 1e-5;  // or at a converging one

  void follow(Branch& branch) {
    auto solved = corrected(point_, Vector::Unit(size_ + 1, size_));
    if (!solved) return;
    branch.points.push_back({parameter_of(solved->point), solved->orbit});
    tangent_ = Vector::Unit(size_ + 1, size_) * (options_.upwards ? 1.0 : -1.0);
    tangent_ = tangent_of(*solved);
    double step = options_.first_step;
    while (branch.points.size() < options_.most_points) {
      const auto next = corrected(point_ + step * tangent_, tangent_);
      constexpr double most_turn = 0.5;  // cos of 60°
      const Vector turned = next ? tangent_of(*next) : Vector();
      if (!next || turned.dot(tangent_) < most_turn) {
        step *= 0.5;
        if (step > shortest && !is_stopped_) continue;
        end_without_neighbour(branch);
        return;
      }
      find_bifurcations(branch, *next, turned, step);
      const double parameter = parameter_of(next->point);
      if (parameter < options_.low || parameter > options_.high) {
        end_at(branch, parameter < options_.low ? options_.low : options_.high);
        return;
      }
      branch.points.push_back({parameter, next->orbit});
      if (next->orbit.period > options_.longest_period * branch.points.front().orbit.period) {
        branch.end = BranchEnd::endless_period;
        return;
      }
      go_on_from(branch, *next, turned);
      if (step < slow_going) {
        end_without_neighbour(branch);
        return;
      }
      if (next->steps <= 4) step = std::min(2.0 * step, options_.longest_step);
    }
    branch.end = BranchEnd::point_limit;
  }

  /// A solution with its derivatives.
  struct Solved {
    Vector point;  ///< unknowns and parameter, scaled
    Matrix slope;  ///< ∂G/∂point, one row fewer than columns
    PeriodicOrbit orbit;
    int steps = 0;
  };

  bool is_stopped() const {
    if (!is_stopped_ && options_.progress != nullptr) is_stopped_ = !options_.progress->go_on(0.0);
    return is_stopped_;
  }

  double parameter_of(const Vector& point) const { return point[size_] * parameter_scale_; }

  /// G, scaled, and its slope. evaluate() gives none if a phase does not end as it should.
  struct Evaluated {
    Vector residual;
    Matrix slope;
    PeriodicOrbit orbit;
  };

  std::optional<Vector> residual_at(const Vector& unknowns, double parameter) const {
    const PreparedSystem system(family_(parameter));
    Shooting shooting = shooting_->of(system);
    shooting.assign(unknowns);
    auto equations = shooting.evaluate();
    if (!equations) return std::nullopt;
    return std::move(equations->residual);
  }

  /// Central differences. Near a grazing a large difference has other events: then smaller ones.
  std::optional<Vector> slope_by_parameter(const Vector& unknowns, double parameter) const {
    for (const double difference : {1e-6, 1e-8, 1e-10}) {
      const double step = difference * parameter_scale_;
      const auto above = residual_at(unknowns, parameter + step);
      const auto below = residual_at(unknowns, parameter - step);
      if (above && below) return Vector((*above - *below) / (2.0 * difference));
    }
    return std::nullopt;
  }

  std::optional<Evaluated> evaluate(const Vector& point) const {
    if (is_stopped()) return std::nullopt;
    const double parameter = parameter_of(point);
    const Vector unknowns = point.head(size_) * scale_;
    const PreparedSystem system(family_(parameter));
    Shooting shooting = shooting_->of(system);
    shooting.assign(unknowns);
    const auto equations = shooting.evaluate();
    if (!equations) return std::nullopt;
    const auto by_parameter = slope_by_parameter(unknowns, parameter);
    if (!by_parameter) return std::nullopt;
    Evaluated evaluated{equations->residual / scale_, Matrix(size_, size_ + 1),
                        shooting.orbit(*equations)};
    evaluated.slope << equations->slope, *by_parameter / scale_;
    return evaluated;
  }

  /// Newton's method from a guess, at right angles to a direction.
  std::optional<Solved> corrected(const Vector& guess, const Vector& direction) const {
    Vector point = guess;
    double last = infinity;
    constexpr int most_steps = 12;
    for (int i = 0; i < most_steps; ++i) {
      const auto here = evaluate(point);
      if (!here) return std::nullopt;
      const double size = here->residual.cwiseAbs().maxCoeff();
      constexpr double good = 1e-12;
      constexpr double acceptable = 1e-9;
      if (size < good || (size < acceptable && size > 0.25 * last)) {
        return Solved{point, here->slope, here->orbit, i};
      }
      if (!std::isfinite(size) || size > 10.0 * last) return std::nullopt;
      last = size;
      Matrix slope(size_ + 1, size_ + 1);
      slope << here->slope, direction.transpose();
      Vector residual(size_ + 1);
      residual << here->residual, direction.dot(point - guess);
      point -= solved_with_full_pivoting(slope, residual);
    }
    return std::nullopt;
  }

  /// The unit tangent in the direction of the last one.
  Vector tangent_of(const Solved& solved) const {
    Matrix slope(size_ + 1, size_ + 1);
    slope << solved.slope, tangent_.transpose();
    const Vector tangent = solved_with_full_pivoting(slope, Vector::Unit(size_ + 1, size_));
    return tangent.normalized();
  }

  /// Sets up the planes of an orbit and its point on the branch.
  bool lay_planes(const BranchPoint& at) {
    const PreparedSystem system(family_(at.parameter));
    auto shooting = Shooting::about(system, at.orbit.start, at.orbit.start_time, at.orbit.period,
                                    at.orbit.events.size(), phases);
    if (!shooting) return false;
    shooting_ = std::move(shooting);
    size_ = shooting_->unknowns().size();
    scale_ = shooting_->scale();
    point_ = Vector(size_ + 1);
    point_ << shooting_->unknowns() / scale_, at.parameter / parameter_scale_;
    return true;
  }

  /// Planes are set up anew at each point. The last point, in the new unknowns, gives the direction
  /// as far as both have alike planes; the parameter goes on rising, or falling, on any.
  void go_on_from(const Branch& branch, const Solved& next, const Vector& turned) {
    point_ = next.point;
    tangent_ = turned;
    const Continuation before = *this;
    const BranchPoint& last = branch.points[branch.points.size() - 2];
    if (lay_planes(last)) {
      const Vector from = point_;
      const double scale_there = scale_;
      if (lay_planes(branch.points.back()) && from.size() == point_.size()) {
        tangent_ = point_ - from;
        tangent_.head(size_) += from.head(size_) * (1.0 - scale_there / scale_);
        const auto solved = corrected(point_, tangent_.normalized());
        if (solved) {
          point_ = solved->point;
          tangent_ = tangent_of(*solved);
          if (tangent_[size_] * turned[turned.size() - 1] < 0.0) tangent_ = -tangent_;
          return;
        }
      }
    }
    restore(before);
  }

  void restore(const Continuation& before) {
    shooting_ = before.shooting_;
    size_ = before.size_;
    scale_ = before.scale_;
    point_ = before.point_;
    tangent_ = before.tangent_;
  }

  /// Halves the distance of the last point and the next one, between which a measure changes its
  /// sign, and then takes it as linear: where a multiplier is 1 Newton's method ends before.
  void find(Branch& branch, BifurcationKind kind, double step, double at_last, double at_next,
            const std::function<double(const Solved&)>& measure) const {
    struct Side {
      double along, measure;
    };
    Side before{0.0, at_last};
    Side after{step, at_next};
    std::optional<Solved> nearest;
    constexpr int halvings = 24;
    for (int i = 0; i < halvings; ++i) {
      const double middle = 0.5 * (before.along + after.along);
      const auto solved = corrected(point_ + middle * tangent_, tangent_);
      if (!solved) break;
      nearest = solved;
      const double here = measure(*solved);
      ((here < 0.0) == (before.measure < 0.0) ? before : after) = {middle, here};
    }
    if (!nearest || is_stopped_) return;
    const double share = before.measure / (before.measure - after.measure);
    const double along = before.along + share * (after.along - before.along);
    const auto solved = corrected(point_ + along * tangent_, tangent_);
    const double parameter = parameter_of(
        solved ? solved->point
               : Vector(nearest->point + (along - tangent_.dot(nearest->point - point_)) *
                                             tangent_of(*nearest) /
                                             tangent_of(*nearest).dot(tangent_)));
    branch.bifurcations.push_back({kind, parameter, (solved ? solved : nearest)->orbit});
  }

  void find_bifurcations(Branch& branch, const Solved& next, const Vector& turned,
                         double step) const {
    if (turned[size_] * tangent_[size_] < 0.0) {
      find(branch, BifurcationKind::fold, step, tangent_[size_], turned[size_],
           [&](const Solved& at) { return tangent_of(at)[size_]; });
      return;
    }
    const PeriodicOrbit& last = branch.points.back().orbit;
    const std::size_t before = unstable_count(last);
    const std::size_t after = unstable_count(next.orbit);
    if (before == after) return;
    // Moduli in falling order change continuously. Of those that pass 1, the largest.
    const std::size_t passing = std::min(before, after);
    const auto beyond = [passing](const PeriodicOrbit& orbit) {
      return std::abs(orbit.multipliers[passing]) - 1.0;
    };
    const PeriodicOrbit& unstable = before > after ? last : next.orbit;
    find(branch, kind_of(unstable.multipliers[passing]), step, beyond(last), beyond(next.orbit),
         [&](const Solved& at) { return beyond(at.orbit); });
  }

  static std::size_t unstable_count(const PeriodicOrbit& orbit) {
    return count_of(orbit.multipliers,
                    [](const std::complex<double>& one) { return std::abs(one) > 1.0; });
  }

  static BifurcationKind kind_of(const std::complex<double>& passing) {
    if (passing.imag() != 0.0) return BifurcationKind::neimark_sacker;
    return passing.real() < 0.0 ? BifurcationKind::flip : BifurcationKind::branching;
  }

  void end_at(Branch& branch, double parameter) {
    Vector guess = point_;
    guess[size_] = parameter / parameter_scale_;
    const auto solved = corrected(guess, Vector::Unit(size_ + 1, size_));
    if (solved) branch.points.push_back({parameter, solved->orbit});
    branch.end = BranchEnd::left_range;
  }

  void end_without_neighbour(Branch& branch) const {
    if (is_stopped_) return;
    const BranchPoint& last = branch.points.back();
    const Clearance clearance = clearance_of(family_(last.parameter), last.orbit);
    constexpr double near = 1e-2;
    branch.end = clearance.share < near ? BranchEnd::grazing : BranchEnd::lost;
    if (branch.end == BranchEnd::grazing) branch.culprit = clearance.name;
  }

  const Family& family_;
  const ContinuationOptions& options_;
  std::optional<Shooting> shooting_;
  Index size_ = 0;
  double scale_ = 1.0;
  double parameter_scale_ = 1.0;
  Vector point_;
  Vector tangent_;
  mutable bool is_stopped_ = false;
};

}  // namespace

Branch continue_orbit(const Family& family, double parameter, const PeriodicOrbit& orbit,
                      const ContinuationOptions& options) {
  if (!(options.low < options.high && parameter >= options.low && parameter <= options.high)) {
    RangeCheck check;
    check.refuse("parameter", exact_text(parameter),
                 "must be within options.low and options.high, which rise: " +
                     exact_text(options.low) + " … " + exact_text(options.high));
    require_none(check.faults());
  }
  return Continuation(family, parameter, orbit, options).run();
}

}  // namespace gearlash::hybrid
