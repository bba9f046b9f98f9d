#include "closed_form/return_orbits.hpp"

#include <algorithm>
#include <limits>

#include "base/lists.hpp"
#include "closed_form/trajectory.hpp"
#include "numeric/linear_algebra.hpp"

namespace gearlash {
namespace {

std::optional<Iterate> iterate(TraversalBudget& budget, const Arrival& start, int order) {
  Iterate result;
  result.visited.reserve(static_cast<std::size_t>(order));
  result.end = start;
  for (int step = 0; step < order; ++step) {
    if (!(result.end(2) > 0.0)) return std::nullopt;
    const Traversal traversal = budget.traverse(result.end, Derivative::wanted);
    if (!traversal.arrives()) return std::nullopt;
    result.visited.push_back(result.end);
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

double mismatch(const Iterate& map, const Arrival& start) {
  return (map.end - start).norm() / start.norm();
}

/// Whether a fixed point is isolated: the uncertainty of the map displaces it little. False if a
/// multiplier is 1 to rounding, where swings of any amplitude persist.
bool is_isolated(const ReturnOrbit& orbit) {
  constexpr double map_rounding = 1e-14;
  constexpr double displacement_allowed = 1e-5;
  const Eigen::Matrix3d mismatch_slope = orbit.map.slope - Eigen::Matrix3d::Identity();
  return std::max(orbit.residual, map_rounding) <
         displacement_allowed * least_pivot(mismatch_slope);
}

double spectral_radius(const Eigen::Matrix3d& slope) {
  return eigenvalues(slope).cwiseAbs().maxCoeff();
}

}  // namespace

Traversal TraversalBudget::traverse(const Arrival& arrival, Derivative derivative) {
  const Traversal traversal = gearlash::traverse(dynamics, arrival, derivative,
                                                 std::min(events_left, traversal_event_limit));
  // Newton's method may try starts that no motion comes to.
  const bool is_trial = derivative == Derivative::wanted;
  return booked(traversal, is_trial);
}

Traversal TraversalBudget::first_arrival(double amplitude) {
  return booked(gearlash::first_arrival(dynamics, amplitude), false);
}

Traversal TraversalBudget::booked(const Traversal& traversal, bool is_trial) {
  events_left -= std::min(events_left, traversal.events);
  const bool is_limited = traversal.outcome == Traversal::Outcome::event_limit;
  cut_short = cut_short || (is_limited && (!is_trial || events_left == 0));
  return traversal;
}

double ReturnOrbit::distance_to(const Arrival& other) const {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Arrival& visited : map.visited) {
    nearest = std::min(nearest, (other - visited).norm() / visited.norm());
  }
  return nearest;
}

/// Whether a step of Newton's method on `order` traversals leads so directly to a known cycle that
/// the following steps, with quadratic convergence, end in it. (Cycles a few 1e-6 apart occur;
/// nearer ones were not seen.)
bool KnownOrbits::leads_to_known(const Arrival& from, const Arrival& step, int order) const {
  constexpr double near = 1e-6;
  constexpr double straight = 0.01;
  const Arrival to = from + step;
  const double limit = std::min(near, straight * step.norm() / to.norm());
  return any_of(known_, [&](const KnownOrbit& known) {
    return order % known.orbit.order == 0 && known.orbit.distance_to(to) < limit;
  });
}

/// Newton's method. Steps are halved until the mismatch falls. Empty if it does not converge, or if
/// it leads to a known cycle.
std::optional<ReturnOrbit> KnownOrbits::newton(Arrival arrival, int order) const {
  constexpr int step_limit = 25;
  constexpr double converged = 1e-13;
  constexpr double acceptable = 1e-10;
  std::optional<Iterate> map = iterate(budget_, arrival, order);
  if (!map) return std::nullopt;
  for (int step = 0; step < step_limit && mismatch(*map, arrival) > converged; ++step) {
    const Arrival full = solved_with_full_pivoting(
        Eigen::Matrix3d(map->slope - Eigen::Matrix3d::Identity()), Arrival(arrival - map->end));
    if (leads_to_known(arrival, full, order)) return std::nullopt;
    std::optional<Iterate> better;
    double share = 1.0;
    for (; share > 0.1 && !better; share *= 0.5) {
      const Arrival trial = arrival + share * full;
      std::optional<Iterate> trial_map = iterate(budget_, trial, order);
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
  return ReturnOrbit{order, arrival, *map, residual};
}

/// After how many traversals it repeats: its order, or a divisor of it.
int KnownOrbits::least_order(const ReturnOrbit& orbit) {
  for (int divisor = 1; divisor < orbit.order; ++divisor) {
    const Arrival& again = orbit.map.visited[static_cast<std::size_t>(divisor)];
    const bool repeats = (again - orbit.arrival).norm() < 1e-7 * orbit.arrival.norm();
    if (orbit.order % divisor == 0 && repeats) return divisor;
  }
  return orbit.order;
}

bool KnownOrbits::try_from(const Arrival& start, int order, WantedOrbits wanted) {
  const std::optional<ReturnOrbit> orbit = newton(start, order);
  if (!orbit || distance_to_known(orbit->arrival) < 1e-7) return false;
  // On the boundary of hunting the motor creeps without end. Such a cycle cannot be distinguished
  // from rest.
  const bool is_endless = 2.0 * orbit->map.duration > longest_simulation;
  if (is_endless || !is_isolated(*orbit)) {
    any_neutral_ = true;
    return false;
  }
  const int least = least_order(*orbit);
  if (least < order) return try_from(orbit->arrival, least, wanted);
  const bool stable = spectral_radius(orbit->map.slope) < 1.0;
  if (wanted == WantedOrbits::stable && !stable) return false;
  known_.push_back({*orbit, stable});
  return true;
}

double KnownOrbits::distance_to_known(const Arrival& arrival) const {
  double nearest = std::numeric_limits<double>::infinity();
  for (const KnownOrbit& known : known_) {
    nearest = std::min(nearest, known.orbit.distance_to(arrival));
  }
  return nearest;
}

double KnownOrbits::distance_to_stable(const Arrival& arrival) const {
  double nearest = std::numeric_limits<double>::infinity();
  for (const KnownOrbit& known : known_) {
    if (known.stable) nearest = std::min(nearest, known.orbit.distance_to(arrival));
  }
  return nearest;
}

}  // namespace gearlash
