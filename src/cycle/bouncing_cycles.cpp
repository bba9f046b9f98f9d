#include "gearlash/cycle/bouncing_cycles.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "gearlash/cycle/return_map.hpp"
#include "gearlash/motion/extremes.hpp"

namespace gearlash {
namespace {

constexpr std::array<int, 6> orders = {1, 2, 3, 4, 6, 8};
constexpr int longest_order = 8;

bool arrives(const Traversal& traversal) {
  return traversal.outcome == Traversal::Outcome::arrived;
}

bool is_cut_short(const Traversal& traversal) {
  return traversal.outcome == Traversal::Outcome::event_limit;
}

/// `order` traversals in a row.
struct Iterate {
  Arrival end;
  Eigen::Matrix3d slope = Eigen::Matrix3d::Identity();
  double duration = 0.0;
  double engaged_time = 0.0;
  double hardest_impact = 0.0;
  std::size_t impacts = 0;
  bool settled = true;
};

std::optional<Iterate> iterate(const ServoDynamics& dynamics, const Arrival& start, int order) {
  Iterate result;
  result.end = start;
  for (int step = 0; step < order; ++step) {
    if (!(result.end(2) > 0.0)) return std::nullopt;
    const Traversal traversal = traverse(dynamics, result.end);
    if (!arrives(traversal)) return std::nullopt;
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

/// Newton's method with halved steps where the mismatch does not fall.
std::optional<FixedPoint> newton(const ServoDynamics& dynamics, Arrival arrival, int order) {
  constexpr int step_limit = 30;
  constexpr double converged = 1e-13;
  constexpr double acceptable = 1e-10;
  std::optional<Iterate> map = iterate(dynamics, arrival, order);
  if (!map) return std::nullopt;
  for (int step = 0; step < step_limit && mismatch(*map, arrival) > converged; ++step) {
    const Arrival full = (map->slope - Eigen::Matrix3d::Identity())
                             .fullPivLu()
                             .solve(arrival - map->end);
    std::optional<Iterate> better;
    double share = 1.0;
    for (; share > 1e-3 && !better; share *= 0.5) {
      const Arrival trial = arrival + share * full;
      std::optional<Iterate> trial_map = iterate(dynamics, trial, order);
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

/// The point belongs to a cycle of a lower order when it already repeats after a divisor of it.
bool repeats_earlier(const ServoDynamics& dynamics, const FixedPoint& point) {
  return std::any_of(orders.begin(), orders.end(), [&](int divisor) {
    if (divisor >= point.order || point.order % divisor != 0) return false;
    const std::optional<Iterate> map = iterate(dynamics, point.arrival, divisor);
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
  const Eigen::Vector3cd eigenvalues =
      Eigen::EigenSolver<Eigen::Matrix3d>(point.map.slope, false).eigenvalues();
  Eigen::Index largest = 0;
  eigenvalues.cwiseAbs().maxCoeff(&largest);
  // Complex pairs have no sign: their modulus is given.
  const double multiplier = eigenvalues(largest).imag() == 0.0 ? eigenvalues(largest).real()
                                                               : std::abs(eigenvalues(largest));
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

  const Trajectory period =
      simulate(servo, cycle.start, {.until = cycle.period, .reference = 0.0});
  const Extremes range = extremes(period, 0.0, cycle.period);
  cycle.size = range.load_size();
  cycle.motor_size = range.motor_size();
  const EnergyAccount books = period.energy_at(cycle.period);
  // The arrival that closes the period may fall just before or just after its end: its impact is
  // booked by count, from the state it happens in.
  const double first_impact = impact(dynamics, point.arrival(1), point.arrival(2)).energy_lost;
  cycle.energy = {books.motor_friction, books.load_friction, first_impact};
  for (const Event& event : period.events()) {
    const bool closing = event.time > cycle.period * (1.0 - 1e-9);
    if (!closing) cycle.energy.impacts += event.energy_lost;
  }
  return cycle;
}

class Search {
 public:
  Search(const NormalizedServo& servo, const ServoDynamics& dynamics)
      : servo_(servo), dynamics_(dynamics) {}

  /// Adds the cycle that Newton's method reaches, unless it is known.
  bool try_from(const Arrival& start, int order) {
    const std::optional<FixedPoint> point = newton(dynamics_, start, order);
    if (!point || known(point->arrival) || repeats_earlier(dynamics_, *point)) return false;
    found_.push_back(*point);
    return true;
  }

  void scan_amplitudes(BouncingCycles& result) {
    constexpr int count = 121;
    for (int i = 0; i < count && !result.cut_short; ++i) {
      const double amplitude = servo_.backlash * std::pow(10.0, -4.0 + 8.0 * i / (count - 1));
      const Traversal first = first_arrival(dynamics_, amplitude);
      result.cut_short = is_cut_short(first);
      if (!arrives(first)) continue;
      const Traversal second = traverse(dynamics_, first.next, Derivative::not_wanted);
      result.cut_short = is_cut_short(second);
      if (!arrives(second)) continue;
      if ((second.next - first.next).norm() < 0.5 * first.next.norm()) try_from(first.next, 1);
    }
  }

  void follow_starts(BouncingCycles& result) {
    constexpr int count = 8;
    for (int i = 0; i < count && !result.cut_short; ++i) {
      const double amplitude =
          servo_.backlash * std::pow(10.0, -1.3 + 3.0 * i / (count - 1));
      const Traversal first = first_arrival(dynamics_, amplitude);
      result.cut_short = is_cut_short(first);
      if (arrives(first)) follow(first.next, result);
    }
  }

  std::vector<LimitCycle> cycles() const {
    std::vector<LimitCycle> cycles;
    for (const FixedPoint& point : found_) cycles.push_back(describe(servo_, dynamics_, point));
    std::sort(cycles.begin(), cycles.end(),
              [](const LimitCycle& a, const LimitCycle& b) { return a.size > b.size; });
    return cycles;
  }

 private:
  /// Near a known cycle, at any of its arrivals or their mirror images.
  bool near_known(const Arrival& arrival, double tolerance, bool only_stable) const {
    for (const FixedPoint& point : found_) {
      Arrival visited = point.arrival;
      for (int step = 0; step < point.order; ++step) {
        const bool counts = !only_stable || spectral_radius(point.map.slope) < 1.0;
        if (counts && (arrival - visited).norm() < tolerance * visited.norm()) return true;
        const Traversal traversal = traverse(dynamics_, visited, Derivative::not_wanted);
        visited = traversal.next;
      }
    }
    return false;
  }

  bool known(const Arrival& arrival) const { return near_known(arrival, 1e-7, false); }

  static double spectral_radius(const Eigen::Matrix3d& slope) {
    return Eigen::EigenSolver<Eigen::Matrix3d>(slope, false).eigenvalues().cwiseAbs().maxCoeff();
  }

  /// Follows one motion until it rests, meets a stable cycle, or has gone on too long.
  void follow(Arrival arrival, BouncingCycles& result) {
    constexpr int traversal_limit = 1500;
    constexpr int between_attempts = 25;
    constexpr double negligible = 1e-9;  // of the backlash: growth at rest decides from here
    std::array<Arrival, longest_order> recent;
    recent.fill(Arrival::Zero());
    for (int count = 1; count <= traversal_limit; ++count) {
      const Traversal traversal = traverse(dynamics_, arrival, Derivative::not_wanted);
      result.cut_short = is_cut_short(traversal);
      if (!arrives(traversal) || traversal.next.norm() < negligible * servo_.backlash) return;
      recent[static_cast<std::size_t>(count % longest_order)] = arrival;
      arrival = traversal.next;
      if (count % between_attempts != 0) continue;
      if (near_known(arrival, 1e-3, true)) return;
      attempt(arrival, recent, count);
    }
    result.all_starts_settled = false;
    const double size = size_from(arrival);
    result.irregular_size = std::fmax(result.irregular_size, size);
  }

  void attempt(const Arrival& arrival, const std::array<Arrival, longest_order>& recent,
               int count) {
    for (const int order : orders) {
      const auto slot = static_cast<std::size_t>((count - order + 1 + longest_order) %
                                                 longest_order);
      if ((recent[slot] - arrival).norm() > 0.05 * arrival.norm()) continue;
      if (try_from(arrival, order)) return;
    }
  }

  /// Half peak-to-peak over a hundred further traversals' time.
  double size_from(const Arrival& arrival) const {
    constexpr double duration = 100.0 * 3.14159265358979;
    const GapState state = after_arrival(dynamics_, arrival);
    const ServoState start{state.load_position + state.gap, state.load_speed + state.gap_speed,
                           state.load_position, state.load_speed};
    const Trajectory motion = simulate(servo_, start, {.until = duration, .reference = 0.0});
    return extremes(motion, 0.0, motion.end_time()).load_size();
  }

  const NormalizedServo& servo_;
  const ServoDynamics& dynamics_;
  std::vector<FixedPoint> found_;
};

}  // namespace

BouncingCycles find_bouncing_cycles(const NormalizedServo& servo, const ServoDynamics& dynamics) {
  BouncingCycles result;
  Search search(servo, dynamics);
  search.scan_amplitudes(result);
  search.follow_starts(result);
  result.cycles = search.cycles();
  return result;
}

}  // namespace gearlash
