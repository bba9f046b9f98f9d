// Fixed points of the return map over several traversals: Newton's method, and which are known.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "closed_form/return_map.hpp"

namespace gearlash {

/// The most traversals after which a cycle is sought to repeat. (Each is half a period or so.)
inline constexpr int longest_cycle_order = 32;

/// Traversals of one servo, and how many events may still be followed.
struct TraversalBudget {
  const ServoDynamics& dynamics;
  std::size_t events_left = 4'000'000;
  bool cut_short = false;  ///< a traversal took more events than are followed

  Traversal traverse(const Arrival& arrival, Derivative derivative);
  Traversal first_arrival(double amplitude);

 private:
  Traversal booked(const Traversal& traversal, bool is_trial);
};

/// Several traversals in a row.
struct Iterate {
  std::vector<Arrival> visited;  ///< the arrivals that they start from
  Arrival end;
  Eigen::Matrix3d slope = Eigen::Matrix3d::Identity();
  double duration = 0.0;
  double engaged_time = 0.0;
  double hardest_impact = 0.0;
  std::size_t impacts = 0;
  bool settled = true;
};

/// A cycle, as the arrival that comes back after `order` traversals.
struct ReturnOrbit {
  int order;
  Arrival arrival;
  Iterate map;
  double residual;  ///< |end − arrival|/|arrival|

  /// Relative distance of an arrival to the nearest of the cycle's own.
  double distance_to(const Arrival& other) const;
};

struct KnownOrbit {
  ReturnOrbit orbit;
  bool stable;
};

/// Which cycles an attempt adds. Irregular motion passes near infinitely many unstable ones.
enum class WantedOrbits { any, stable };

/// The cycles of one servo that were found so far.
class KnownOrbits {
 public:
  explicit KnownOrbits(TraversalBudget& budget) : budget_(budget) {}

  /// Adds the cycle that Newton's method reaches on `order` traversals from `start`, unless it is
  /// known. (If it repeats after fewer traversals, it is added as a cycle of so many.) Steps are
  /// halved until the mismatch falls. The attempt ends as soon as a step leads straight to a known
  /// cycle. Returns whether a cycle was added.
  bool try_from(const Arrival& start, int order, WantedOrbits wanted = WantedOrbits::any);

  const std::vector<KnownOrbit>& list() const { return known_; }
  /// Whether a cycle was met whose multiplier is 1 to within rounding. It is not in the list.
  bool any_neutral() const { return any_neutral_; }
  double distance_to_known(const Arrival& arrival) const;
  double distance_to_stable(const Arrival& arrival) const;

 private:
  bool leads_to_known(const Arrival& from, const Arrival& step, int order) const;
  std::optional<ReturnOrbit> newton(Arrival arrival, int order) const;
  static int least_order(const ReturnOrbit& orbit);

  TraversalBudget& budget_;
  std::vector<KnownOrbit> known_;
  bool any_neutral_ = false;
};

}  // namespace gearlash
