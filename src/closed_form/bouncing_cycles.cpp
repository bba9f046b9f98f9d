#include "closed_form/bouncing_cycles.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "base/lists.hpp"
#include "closed_form/cycle_of_orbit.hpp"
#include "closed_form/extremes.hpp"
#include "closed_form/growth_at_rest.hpp"
#include "closed_form/parting_scan.hpp"
#include "closed_form/return_orbits.hpp"
#include "closed_form/unit_half_cycle.hpp"
#include "numeric/linear_algebra.hpp"

namespace gearlash {
namespace {

/// Irregular motion passes near infinitely many unstable cycles. Once this many are known, no more
/// are sought along motions.
constexpr std::size_t most_cycles = 16;

/// Whether half cycles shrink from one of two neighbouring samples and do not from the other.
bool crosses(const PartingSample& above, const PartingSample& below) {
  return above.settles && below.settles && (above.growth() < 0.0) != (below.growth() < 0.0);
}

/// The direction in which disturbances of a cycle grow fastest, and their factor, by powers of its
/// derivative.
struct GrowingDirection {
  Arrival direction = Arrival::Ones().normalized();
  double factor = 0.0;
};

GrowingDirection growing_direction(const Eigen::Matrix3d& slope) {
  constexpr int powers = 30;
  GrowingDirection growing;
  for (int i = 0; i < powers; ++i) {
    const Arrival next = slope * growing.direction;
    growing.factor = next.dot(growing.direction);
    if (!(next.norm() > 0.0)) break;
    growing.direction = next.normalized();
  }
  return growing;
}

class Search {
 public:
  Search(const NormalizedServo& servo, const ServoDynamics& dynamics)
      : servo_(servo),
        dynamics_(dynamics),
        growth_at_rest_(growth_at_rest(dynamics)),
        budget_{dynamics},
        known_(budget_) {}

  BouncingCycles run() {
    scan_ = scan_partings(budget_, growth_at_rest_);
    try_crossings();
    try_recurrences();
    try_plastic_cycle();
    follow_starts();
    if (all_settle_from_ == infinity) search_from_cycles();
    for (const KnownOrbit& known : known_.list()) {
      result_.cycles.push_back(cycle_of_orbit(servo_, dynamics_, known.orbit));
    }
    sort_by(result_.cycles, [](const LimitCycle& cycle) { return -cycle.amplitude; });
    result_.cut_short = budget_.cut_short || still_growing_;
    result_.any_neutral = known_.any_neutral();
    return result_;
  }

 private:
  bool try_parting(double amplitude) {
    const Traversal first = budget_.first_arrival(amplitude);
    return first.arrives() && known_.try_from(first.next, 1);
  }

  /// Where the faces engage before they cross the gap again, the amplitude at which they part is
  /// the whole state, and a cycle is a zero of its growth. From the largest sample down: as long as
  /// they engage and the next amplitude falls with the amplitude, the map rises. Then all motions
  /// from above the last sample that grows end in one of the cycles found there.
  void try_crossings() {
    const std::vector<PartingSample>& samples = scan_.samples;
    bool rises = !samples.empty() && samples.front().settles && samples.front().growth() < 0.0;
    if (rises && samples.size() == 1 && scan_.reaches_rest) all_settle_from_ = 0.0;
    for (std::size_t i = 1; i < samples.size(); ++i) {
      const PartingSample& above = samples[i - 1];
      const PartingSample& below = samples[i];
      if (!above.settles || !below.settles) {
        rises = false;
        continue;
      }
      rises = rises && below.next_amplitude < above.next_amplitude;
      if (crosses(above, below)) rises = try_crossing(above, below) && rises;
      if (rises && below.growth() >= 0.0) all_settle_from_ = below.amplitude;
      if (rises && scan_.reaches_rest && i + 1 == samples.size()) all_settle_from_ = 0.0;
    }
  }

  /// False position, with the weight of an end that stays halved (Illinois), until Newton's method
  /// on the map itself is near enough.
  bool try_crossing(const PartingSample& above, const PartingSample& below) {
    constexpr double near = 1e-3;
    constexpr int step_limit = 60;
    double high = above.amplitude;
    double low = below.amplitude;
    double growth_high = std::log(above.next_amplitude / high);
    double growth_low = std::log(below.next_amplitude / low);
    int last_side = 0;
    for (int step = 0; step < step_limit; ++step) {
      const double middle = (low * growth_high - high * growth_low) / (growth_high - growth_low);
      if (!(middle > low && middle < high)) return false;
      const Traversal first = budget_.first_arrival(middle);
      if (!first.arrives()) return false;
      const Traversal second = budget_.traverse(first.next, Derivative::not_wanted);
      if (!second.arrives() || !second.settled) return false;
      const double growth = std::log(std::abs(second.parting_amplitude) / middle);
      if (std::abs(growth) < near || high - low < near * high)
        return known_.try_from(first.next, 1);
      const int side = (growth < 0.0) == (growth_high < 0.0) ? 1 : -1;
      (side > 0 ? high : low) = middle;
      (side > 0 ? growth_high : growth_low) = growth;
      if (side == last_side) (side > 0 ? growth_low : growth_high) *= 0.5;
      last_side = side;
    }
    return false;
  }

  /// From samples that nearly come back after one traversal or two: nearer than their neighbours
  /// do, or next to a grazing. Cycles that cross the line are known by now.
  void try_recurrences() {
    constexpr double near_once = 0.5;
    constexpr double near_twice = 0.3;
    for (std::size_t i = 0; i < scan_.samples.size() && !budget_.cut_short; ++i) {
      const PartingSample& sample = scan_.samples[i];
      if (sample.once < near_once && is_nearest(i, &PartingSample::once) && !crosses_beside(i)) {
        known_.try_from(sample.arrival, 1);
      }
      if (sample.twice < near_twice && is_nearest(i, &PartingSample::twice)) {
        known_.try_from(sample.arrival, 2);
      }
    }
  }

  bool is_nearest(std::size_t i, double PartingSample::*distance) const {
    const std::vector<PartingSample>& samples = scan_.samples;
    const double here = samples[i].*distance;
    return samples[i].by_grazing || ((i == 0 || here <= samples[i - 1].*distance) &&
                                     (i + 1 == samples.size() || here <= samples[i + 1].*distance));
  }

  bool crosses_beside(std::size_t i) const {
    const std::vector<PartingSample>& samples = scan_.samples;
    return (i > 0 && crosses(samples[i - 1], samples[i])) ||
           (i + 1 < samples.size() && crosses(samples[i], samples[i + 1]));
  }

  /// Starts from the plastic cycle: a few bounces change it little, and it may lie outside the
  /// scan.
  void try_plastic_cycle() {
    if (all_settle_from_ < infinity) return;
    ServoDynamics plastic = dynamics_;
    plastic.restitution = 0.0;
    const double growth = growth_at_rest(plastic);
    if (!(growth > 1.0)) return;
    const auto half = balanced_half_cycle(plastic, growth);
    if (half) try_parting(servo_.backlash / -half->gap_displacement);
  }

  void follow_starts() {
    constexpr int count = 8;
    for (int i = 0; i < count && !budget_.cut_short; ++i) {
      const double amplitude = servo_.backlash * std::pow(10.0, -1.3 + 3.0 * i / (count - 1));
      if (amplitude >= all_settle_from_) return;
      const Traversal first = budget_.first_arrival(amplitude);
      if (first.arrives()) watch(first.next);
    }
  }

  /// What lies beside the unstable cycles known, and beside those that are found on the way.
  void search_from_cycles() {
    constexpr std::size_t cycles_tried = 2 * most_cycles;
    for (std::size_t i = 0; i < std::min(known_.list().size(), cycles_tried); ++i) {
      if (known_.list()[i].stable) continue;
      const ReturnOrbit orbit = known_.list()[i].orbit;  // a copy: the list grows
      const GrowingDirection growing = growing_direction(orbit.map.slope);
      try_doubled(orbit, growing);
      follow_both_sides(orbit, growing.direction);
    }
  }

  /// A cycle that lost its stability at a multiplier of −1 has one of twice its length around it.
  void try_doubled(const ReturnOrbit& orbit, const GrowingDirection& growing) {
    constexpr double shortly_after = -2.0;
    if (!(growing.factor < -1.0 && growing.factor > shortly_after)) return;
    if (2 * orbit.order > longest_cycle_order) return;
    for (const double aside : {0.003, 0.01, 0.03}) {
      if (budget_.cut_short) return;
      const Arrival start = orbit.arrival + aside * orbit.arrival.norm() * growing.direction;
      if (known_.try_from(start, 2 * orbit.order)) return;
    }
  }

  /// An unstable cycle may lie on the border between two attractors: motions to either side of it
  /// lead to both.
  void follow_both_sides(const ReturnOrbit& orbit, const Arrival& direction) {
    constexpr double aside = 1e-3;
    constexpr int traversal_limit = 100;
    for (const double side : {-aside, aside}) {
      if (budget_.cut_short) return;
      Motion motion{.arrival = orbit.arrival + side * orbit.arrival.norm() * direction};
      follow(motion, traversal_limit);
    }
  }

  static constexpr std::size_t ring_size = 2 * longest_cycle_order + 1;

  struct Motion {
    Arrival arrival;
    std::array<Arrival, ring_size> recent{};  ///< the last arrivals, in a ring
    int count = 0;                            ///< traversals
    double farthest = 0.0;                    ///< largest arrival since this was last set to 0

    /// The arrival of some traversals ago. Infinitely far where there are not so many.
    Arrival before(int traversals) const {
      if (traversals > count) return Arrival::Constant(infinity);
      return recent[static_cast<std::size_t>(count - traversals) % ring_size];
    }
    double moved_since(int traversals) const { return (before(traversals) - arrival).norm(); }
    double moved_between(int late, int early) const {
      return (before(late) - before(early)).norm();
    }
  };

  enum class Ending { settled, moving };

  /// Until the motion rests, meets a stable cycle, or has made `limit` traversals in all.
  Ending follow(Motion& motion, int limit) {
    constexpr int between_attempts = 25;
    constexpr double negligible = 1e-9;  // of the backlash: growth at rest decides from here
    constexpr double captured = 1e-3;
    while (motion.count < limit) {
      const Traversal traversal = budget_.traverse(motion.arrival, Derivative::not_wanted);
      if (!traversal.arrives() || traversal.next.norm() < negligible * servo_.backlash) {
        return Ending::settled;
      }
      if (traversal.settled && std::abs(traversal.parting_amplitude) >= all_settle_from_) {
        return Ending::settled;
      }
      if (growth_at_rest_ < 1.0 &&
          grows_as_at_rest(dynamics_, growth_at_rest_, motion.arrival, traversal.next)) {
        return Ending::settled;
      }
      motion.recent[static_cast<std::size_t>(motion.count) % ring_size] = motion.arrival;
      ++motion.count;
      motion.arrival = traversal.next;
      motion.farthest = std::max(motion.farthest, motion.arrival.norm());
      if (motion.count % between_attempts != 0) continue;
      if (known_.distance_to_stable(motion.arrival) < captured) return Ending::settled;
      attempt(motion);
    }
    return Ending::moving;
  }

  /// Follows a motion until it has continued too long without coming nearer to a stable cycle (a
  /// lightly damped servo takes 1/ζ crossings).
  void watch(const Arrival& start) {
    constexpr int eighths = 8;
    constexpr int traversal_limit = 1500;
    Motion motion{.arrival = start};
    std::array<double, eighths> largest{};  // in each eighth of the way
    double distance_halfway = infinity;
    for (int i = 0; i < eighths; ++i) {
      motion.farthest = 0.0;
      if (follow(motion, traversal_limit * (i + 1) / eighths) == Ending::settled) return;
      largest[static_cast<std::size_t>(i)] = motion.farthest;
      if (2 * (i + 1) == eighths) distance_halfway = known_.distance_to_stable(motion.arrival);
    }
    if (known_.distance_to_stable(motion.arrival) < 0.9 * distance_halfway) return;
    // Motion that still decays does not last. Motion that still grows has not shown its final
    // amplitude.
    const auto never = largest.end();
    if (std::adjacent_find(largest.begin(), never, std::less_equal<>()) == never) return;
    if (std::adjacent_find(largest.begin(), never, std::greater_equal<>()) == never) {
      still_growing_ = true;
      return;
    }
    result_.all_starts_settled = false;
    result_.irregular_amplitude =
        std::fmax(result_.irregular_amplitude, amplitude_from(motion.arrival));
  }

  /// Newton's method where the motion comes back: roughly, after few traversals, or ever more
  /// closely, as motion that settles on a longer stable cycle does.
  void attempt(const Motion& motion) {
    constexpr int few = 8;
    constexpr double roughly = 0.05;
    constexpr double closely = 1e-3;
    constexpr double passing_by = 0.002;  // a known cycle, to which Newton's method would return
    if (known_.list().size() >= most_cycles) return;
    if (known_.distance_to_known(motion.arrival) < passing_by) return;
    const double size = motion.arrival.norm();
    for (int order = 1; order <= few; ++order) {
      if (motion.moved_since(order) > roughly * size || drifts(motion, order)) continue;
      if (known_.try_from(motion.arrival, order)) return;
    }
    for (int order = few + 1; order <= longest_cycle_order; ++order) {
      const double moved = motion.moved_since(order);
      if (moved > closely * size || moved > motion.moved_between(order, 2 * order)) continue;
      if (drifts(motion, order)) continue;
      if (known_.try_from(motion.arrival, order, WantedOrbits::stable)) return;
    }
  }

  /// Whether a motion is slow, and the ways of single traversals add up: it passes no cycle of
  /// several.
  static bool drifts(const Motion& motion, int order) {
    constexpr double slow = 1e-4;
    constexpr double nearly_all = 0.9;
    const double once = motion.moved_since(1);
    return order > 1 && once < slow * motion.arrival.norm() &&
           motion.moved_since(order) >= nearly_all * order * once;
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
  TraversalBudget budget_;
  KnownOrbits known_;
  PartingScan scan_;
  double all_settle_from_ = infinity;
  bool still_growing_ = false;
  BouncingCycles result_;
};

}  // namespace

BouncingCycles find_bouncing_cycles(const NormalizedServo& servo, const ServoDynamics& dynamics) {
  return Search(servo, dynamics).run();
}

}  // namespace gearlash
