#include "closed_form/bouncing_cycles.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>

#include "closed_form/extremes.hpp"
#include "closed_form/growth_at_rest.hpp"
#include "closed_form/return_map.hpp"
#include "closed_form/unit_half_cycle.hpp"
#include "numeric/linear_algebra.hpp"

namespace gearlash {
namespace {

constexpr std::array<int, 6> orders = {1, 2, 3, 4, 6, 8};
constexpr int longest_order = 8;
/// Irregular motion passes near infinitely many unstable cycles. Once this many are known, no more
/// are sought along motions.
constexpr std::size_t most_cycles = 16;

bool arrives(const Traversal& traversal) {
  return traversal.outcome == Traversal::Outcome::arrived;
}

/// The servo, and how many events may still be followed.
struct Course {
  const ServoDynamics& dynamics;
  std::size_t events_left = 4'000'000;
  bool cut_short = false;

  Traversal traverse(const Arrival& arrival, Derivative derivative) {
    return booked(gearlash::traverse(dynamics, arrival, derivative,
                                     std::min(events_left, traversal_event_limit)));
  }

  Traversal first_arrival(double amplitude) {
    return booked(gearlash::first_arrival(dynamics, amplitude));
  }

 private:
  Traversal booked(const Traversal& traversal) {
    events_left -= std::min(events_left, traversal.events);
    cut_short = cut_short || traversal.outcome == Traversal::Outcome::event_limit;
    return traversal;
  }
};

/// `order` traversals in a row.
struct Iterate {
  std::array<Arrival, longest_order> visited{};  ///< the arrivals that they start from
  Arrival end;
  Eigen::Matrix3d slope = Eigen::Matrix3d::Identity();
  double duration = 0.0;
  double engaged_time = 0.0;
  double hardest_impact = 0.0;
  std::size_t impacts = 0;
  bool settled = true;
};

std::optional<Iterate> iterate(Course& course, const Arrival& start, int order) {
  Iterate result;
  result.end = start;
  for (int step = 0; step < order; ++step) {
    if (!(result.end(2) > 0.0)) return std::nullopt;
    const Traversal traversal = course.traverse(result.end, Derivative::wanted);
    if (!arrives(traversal)) return std::nullopt;
    result.visited[static_cast<std::size_t>(step)] = result.end;
    result.end = traversal.next;
    result.slope = traversal.slope * result.slope;
    result.duration += traversal.duration;
    result.engaged_time += traversal.engaged_time;
    result.hardest_impact = std::max(result.hardest_impact, traversal.hardest_impact);
    result.impacts += traversal.impacts;
    result.settled = result.settled && traversal.settled;
  }
  return result;
}

struct FixedPoint {
  int order;
  Arrival arrival;
  Iterate map;
  double residual;
};

double mismatch(const Iterate& map, const Arrival& start) {
  return (map.end - start).norm() / start.norm();
}

/// Whether a fixed point is isolated: the uncertainty of the map displaces it little. False if a
/// multiplier is 1 to rounding, where swings of any amplitude persist.
bool is_isolated(const FixedPoint& point) {
  constexpr double map_rounding = 1e-14;
  constexpr double displacement_allowed = 1e-5;
  const Eigen::Matrix3d mismatch_slope = point.map.slope - Eigen::Matrix3d::Identity();
  return std::max(point.residual, map_rounding) <
         displacement_allowed * least_pivot(mismatch_slope);
}

/// A cycle that was found before.
struct KnownCycle {
  FixedPoint point;
  bool stable;

  /// Relative distance to the nearest of its arrivals.
  double distance_to(const Arrival& arrival) const {
    double nearest = std::numeric_limits<double>::infinity();
    for (int step = 0; step < point.order; ++step) {
      const Arrival& visited = point.map.visited[static_cast<std::size_t>(step)];
      nearest = std::min(nearest, (arrival - visited).norm() / visited.norm());
    }
    return nearest;
  }
};

/// Whether a step of Newton's method on `order` traversals leads so directly to a known cycle that
/// the following steps, with quadratic convergence, end in it. (Cycles a few 1e-6 apart occur;
/// nearer ones were not seen.)
bool leads_to_known(const std::vector<KnownCycle>& known, const Arrival& from, const Arrival& step,
                    int order) {
  constexpr double near = 1e-6;
  constexpr double straight = 0.01;
  const Arrival to = from + step;
  const double limit = std::min(near, straight * step.norm() / to.norm());
  return std::any_of(known.begin(), known.end(), [&](const KnownCycle& cycle) {
    return order % cycle.point.order == 0 && cycle.distance_to(to) < limit;
  });
}

/// Newton's method. Steps are halved until the mismatch falls. Empty if it does not converge, or if
/// it leads to a known cycle.
std::optional<FixedPoint> newton(Course& course, const std::vector<KnownCycle>& known,
                                 Arrival arrival, int order) {
  constexpr int step_limit = 25;
  constexpr double converged = 1e-13;
  constexpr double acceptable = 1e-10;
  std::optional<Iterate> map = iterate(course, arrival, order);
  if (!map) return std::nullopt;
  for (int step = 0; step < step_limit && mismatch(*map, arrival) > converged; ++step) {
    const Arrival full = solved_with_full_pivoting(
        Eigen::Matrix3d(map->slope - Eigen::Matrix3d::Identity()), Arrival(arrival - map->end));
    if (leads_to_known(known, arrival, full, order)) return std::nullopt;
    std::optional<Iterate> better;
    double share = 1.0;
    for (; share > 1e-3 && !better; share *= 0.5) {
      const Arrival trial = arrival + share * full;
      std::optional<Iterate> trial_map = iterate(course, trial, order);
      if (trial_map && mismatch(*trial_map, trial) < mismatch(*map, arrival)) {
        better = trial_map;
        arrival = trial;
      }
    }
    if (!better) break;
    map = better;
  }
  const double residual = mismatch(*map, arrival);
  if (!(residual <= acceptable)) return std::nullopt;
  return FixedPoint{order, arrival, *map, residual};
}

/// Whether the point belongs to a cycle of lower order: it repeats after a divisor of its order.
bool repeats_earlier(Course& course, const FixedPoint& point) {
  return std::any_of(orders.begin(), orders.end(), [&](int divisor) {
    if (divisor >= point.order || point.order % divisor != 0) return false;
    const std::optional<Iterate> map = iterate(course, point.arrival, divisor);
    return map && mismatch(*map, point.arrival) < 1e-7;
  });
}

/// A full period is twice an odd number of mirrored traversals, or an even number of them.
int traversals_per_period(int order) { return order % 2 == 0 ? order : 2 * order; }

CycleKind kind_of(int order) {
  if (order == 1) return CycleKind::symmetric;
  return order == 2 ? CycleKind::asymmetric : CycleKind::subharmonic;
}

LimitCycle describe(const NormalizedServo& servo, const ServoDynamics& dynamics,
                    const FixedPoint& point) {
  const int repeats = traversals_per_period(point.order) / point.order;
  const Eigen::Vector3cd values = eigenvalues(point.map.slope);
  Eigen::Index largest = 0;
  values.cwiseAbs().maxCoeff(&largest);
  // Complex pairs have no sign: their modulus is given.
  const double multiplier =
      values(largest).imag() == 0.0 ? values(largest).real() : std::abs(values(largest));
  const GapState start = after_arrival(dynamics, point.arrival);

  LimitCycle cycle;
  cycle.kind = kind_of(point.order);
  cycle.multiplier = repeats == 2 ? multiplier * multiplier : multiplier;
  cycle.stable = std::abs(multiplier) < 1.0;
  cycle.period = repeats * point.map.duration;
  cycle.engaged_time = repeats * point.map.engaged_time;
  cycle.separated_time = cycle.period - cycle.engaged_time;
  cycle.impact_speed = point.map.hardest_impact;
  cycle.residual = point.residual;
  cycle.impacts_per_period = static_cast<std::size_t>(repeats) * point.map.impacts;
  cycle.settles = point.map.settled;
  cycle.start = {start.load_position + start.gap, start.load_speed + start.gap_speed,
                 start.load_position, start.load_speed};

  const Trajectory period = simulate(servo, cycle.start, {.until = cycle.period, .reference = 0.0});
  const Extremes range = extremes(period, 0.0, cycle.period);
  cycle.amplitude = range.load_amplitude();
  cycle.motor_amplitude = range.motor_amplitude();
  const EnergyAccount books = period.energy_at(cycle.period);
  // The arrival that closes the period may fall just before or just after its end. So its impact is
  // not taken from the events but computed once, from the arrival itself.
  const double first_impact = impact(dynamics, point.arrival(1), point.arrival(2)).energy_lost;
  cycle.energy = {books.motor_friction, books.load_friction, first_impact};
  for (const Event& event : period.events()) {
    const bool closing = event.time > cycle.period * (1.0 - 1e-9);
    if (!closing) cycle.energy.impacts += event.energy_lost;
  }
  return cycle;
}

double spectral_radius(const Eigen::Matrix3d& slope) {
  return eigenvalues(slope).cwiseAbs().maxCoeff();
}

class Search {
 public:
  Search(const NormalizedServo& servo, const ServoDynamics& dynamics)
      : servo_(servo),
        dynamics_(dynamics),
        growth_at_rest_(growth_at_rest(dynamics)),
        course_{dynamics} {}

  BouncingCycles run() {
    try_plastic_cycle();
    scan_amplitudes();
    follow_starts();
    for (const KnownCycle& known : known_) {
      result_.cycles.push_back(describe(servo_, dynamics_, known.point));
    }
    std::sort(result_.cycles.begin(), result_.cycles.end(),
              [](const LimitCycle& a, const LimitCycle& b) { return a.amplitude > b.amplitude; });
    result_.cut_short = course_.cut_short || still_growing_;
    return result_;
  }

 private:
  /// Adds the cycle that Newton's method reaches, unless it is known.
  bool try_from(const Arrival& start, int order) {
    const std::optional<FixedPoint> point = newton(course_, known_, start, order);
    if (!point || distance_to_known(point->arrival) < 1e-7) return false;
    // On the boundary of hunting the motor creeps without end. Such a cycle cannot be distinguished
    // from rest.
    const bool is_endless = 2.0 * point->map.duration > longest_simulation;
    if (is_endless || !is_isolated(*point)) {
      result_.any_neutral = true;
      return false;
    }
    if (repeats_earlier(course_, *point)) return false;
    known_.push_back({*point, spectral_radius(point->map.slope) < 1.0});
    return true;
  }

  /// Starts from the plastic cycle: a few bounces change it little, and it may lie outside the
  /// scan.
  void try_plastic_cycle() {
    ServoDynamics plastic = dynamics_;
    plastic.restitution = 0.0;
    const double growth = growth_at_rest(plastic);
    if (!(growth > 1.0)) return;
    const auto half = balanced_half_cycle(plastic, growth);
    if (!half) return;
    const Traversal first = course_.first_arrival(servo_.backlash / -half->gap_displacement);
    if (arrives(first)) try_from(first.next, 1);
  }

  /// Coarsely first, then finer, until half of the events are used.
  void scan_amplitudes() {
    constexpr int count = 121;
    const std::size_t reserve = course_.events_left / 2;
    for (const int offset : {0, 4, 2, 6, 1, 3, 5, 7}) {
      for (int i = offset; i < count; i += 8) {
        if (course_.cut_short || course_.events_left < reserve) return;
        try_amplitude(std::pow(10.0, -4.0 + 8.0 * i / (count - 1)));
      }
    }
  }

  /// Whether the load is at rest and the motor creeps at the speed at which the loop balances its
  /// friction.
  bool creeps(const Arrival& arrival) const {
    constexpr double rounding = 1e-13;
    const double creeping_speed = -arrival(0) / dynamics_.motor_friction;
    const double load_speed = arrival(1) - dynamics_.motor_inertia * arrival(2);
    return std::abs(arrival(2) - creeping_speed) <= rounding * creeping_speed &&
           std::abs(load_speed) <= rounding * std::abs(arrival(1));
  }

  /// Whether two successive arrivals differ by the factor μ₀ alone. Then no cycle is this small.
  /// False if μ₀ is 1 to nine digits, because growth at rest then decides nothing.
  bool grows_as_at_rest(const Arrival& arrival, const Arrival& next) const {
    constexpr double told_apart = 1e-9;
    const double growth = growth_at_rest_;
    return std::isfinite(growth) && std::abs(growth - 1.0) > told_apart && creeps(arrival) &&
           creeps(next) &&
           std::abs(next.norm() - growth * arrival.norm()) <= told_apart * next.norm();
  }

  void try_amplitude(double per_backlash) {
    const Traversal first = course_.first_arrival(servo_.backlash * per_backlash);
    if (!arrives(first)) return;
    const Traversal second = course_.traverse(first.next, Derivative::not_wanted);
    if (!arrives(second) || grows_as_at_rest(first.next, second.next)) return;
    if ((second.next - first.next).norm() < 0.5 * first.next.norm()) try_from(first.next, 1);
  }

  void follow_starts() {
    constexpr int count = 8;
    for (int i = 0; i < count && !course_.cut_short; ++i) {
      const Traversal first =
          course_.first_arrival(servo_.backlash * std::pow(10.0, -1.3 + 3.0 * i / (count - 1)));
      if (arrives(first)) follow(first.next);
    }
  }

  /// Relative distance to the nearest known cycle.
  double distance_to_known(const Arrival& arrival) const {
    double nearest = std::numeric_limits<double>::infinity();
    for (const KnownCycle& known : known_) {
      nearest = std::min(nearest, known.distance_to(arrival));
    }
    return nearest;
  }

  double distance_to_stable(const Arrival& arrival) const {
    double nearest = std::numeric_limits<double>::infinity();
    for (const KnownCycle& known : known_) {
      if (known.stable) nearest = std::min(nearest, known.distance_to(arrival));
    }
    return nearest;
  }

  /// Follows one motion until it rests, meets a stable cycle, or has continued too long without
  /// coming nearer to one (a lightly damped servo takes 1/ζ crossings).
  void follow(Arrival arrival) {
    constexpr int traversal_limit = 1500;
    constexpr int between_attempts = 25;
    constexpr double negligible = 1e-9;  // of the backlash: growth at rest decides from here
    constexpr double captured = 1e-3;
    std::array<Arrival, longest_order> recent;
    recent.fill(Arrival::Zero());
    double distance_halfway = std::numeric_limits<double>::infinity();
    std::array<double, 8> largest{};  // in each eighth of the way
    for (int count = 1; count <= traversal_limit; ++count) {
      const Traversal traversal = course_.traverse(arrival, Derivative::not_wanted);
      if (!arrives(traversal) || traversal.next.norm() < negligible * servo_.backlash) return;
      if (growth_at_rest_ < 1.0 && grows_as_at_rest(arrival, traversal.next)) return;
      recent[static_cast<std::size_t>(count % longest_order)] = arrival;
      arrival = traversal.next;
      double& so_far = largest[static_cast<std::size_t>(8 * (count - 1) / traversal_limit)];
      so_far = std::max(so_far, arrival.norm());
      if (count % between_attempts != 0) continue;
      const double distance = distance_to_stable(arrival);
      if (distance < captured) return;
      if (count <= traversal_limit / 2) distance_halfway = distance;
      attempt(arrival, recent, count);
    }
    if (distance_to_stable(arrival) < 0.9 * distance_halfway) return;
    // Motion that still decays does not last. Motion that still grows has not shown its final
    // amplitude.
    const auto never = largest.end();
    if (std::adjacent_find(largest.begin(), never, std::less_equal<>()) == never) return;
    if (std::adjacent_find(largest.begin(), never, std::greater_equal<>()) == never) {
      still_growing_ = true;
      return;
    }
    result_.all_starts_settled = false;
    result_.irregular_amplitude = std::fmax(result_.irregular_amplitude, amplitude_from(arrival));
  }

  void attempt(const Arrival& arrival, const std::array<Arrival, longest_order>& recent,
               int count) {
    if (known_.size() >= most_cycles) return;
    for (const int order : orders) {
      const auto slot =
          static_cast<std::size_t>((count - order + 1 + longest_order) % longest_order);
      if ((recent[slot] - arrival).norm() > 0.05 * arrival.norm()) continue;
      if (try_from(arrival, order)) return;
    }
  }

  /// Half peak-to-peak over about a hundred further traversals.
  double amplitude_from(const Arrival& arrival) const {
    constexpr double duration = 100.0 * std::numbers::pi;
    constexpr std::size_t event_limit = 100'000;
    const GapState state = after_arrival(dynamics_, arrival);
    ServoState start{.motor_position = state.load_position + state.gap,
                     .load_position = state.load_position,
                     .load_speed = state.load_speed};
    start.set_gap_speed(state.gap_speed);
    const Trajectory motion =
        simulate(servo_, start, {.until = duration, .reference = 0.0, .event_limit = event_limit});
    return extremes(motion, 0.0, motion.end_time()).load_amplitude();
  }

  const NormalizedServo& servo_;
  const ServoDynamics& dynamics_;
  double growth_at_rest_;
  Course course_;
  std::vector<KnownCycle> known_;
  bool still_growing_ = false;
  BouncingCycles result_;
};

}  // namespace

BouncingCycles find_bouncing_cycles(const NormalizedServo& servo, const ServoDynamics& dynamics) {
  return Search(servo, dynamics).run();
}

}  // namespace gearlash
