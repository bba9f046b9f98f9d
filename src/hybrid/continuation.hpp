// Periodic orbits followed as one parameter of their system changes, through folds.
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "hybrid/periodic_orbit.hpp"

namespace gearlash::hybrid {

/// The system with a parameter's value. The state's numbers and the modes stay the same.
using Family = std::function<HybridSystem(double parameter)>;

struct BranchPoint {
  double parameter = std::numeric_limits<double>::quiet_NaN();
  PeriodicOrbit orbit;
};

enum class BranchEnd {
  left_range,  ///< the last point is at an end of the range
  grazing,     ///< a guard that no event is of is touched, or one is met at no speed: `culprit`;
               ///< beyond, the orbit has other events
  endless_period,  ///< the period has grown by `longest_period`: the orbit nears one that takes for
                   ///< ever, from a rest back to it, as where hunting ends
  point_limit,     ///< as many points as were asked for
  lost             ///< Newton's method finds no neighbour, for no reason that is known
};

struct Branch {
  std::vector<BranchPoint> points;  ///< from the given orbit on, in the order in which they follow
  std::vector<BranchPoint> folds;   ///< where the parameter turns back: a multiplier is 1
  BranchEnd end = BranchEnd::lost;
  std::string culprit;  ///< "mode: transition" of a grazing
};

struct ContinuationOptions {
  double low = -std::numeric_limits<double>::infinity();  ///< of the parameter
  double high = std::numeric_limits<double>::infinity();
  bool upwards = true;            ///< which way the parameter goes at first
  double first_step = 1e-2;       ///< of arclength, in which the parameter at the start, and the
  double longest_step = 0.1;      ///< largest number of the orbit, count as 1
  double longest_period = 100.0;  ///< of the first one's
  std::size_t most_points = 500;
};

/// Pseudo-arclength continuation (Keller 1977): with z the starts of an orbit's phases and the
/// parameter, G(z) = 0 the equations of closing_orbit() and t the unit tangent,
///   G(z) = 0,  t·(z − z_last) = step
/// has a neighbour's solution, beyond a fold too. Steps are doubled where Newton's method takes no
/// time, and halved where it fails; where they come to be below 1e-5 the branch has an end.
/// (Towards the grazing of an impact of its own they shrink as the square of its speed, which
/// leaves some 1e-4 of the parameter.) Folds are closed in on until the tangent has no part along
/// the parameter. By the parameter G is differentiated by central differences; that costs Newton's
/// method steps, not digits.
///
/// A grazing is told from what the last orbit does there: of all guards that it does not end a
/// stretch with, the least distance that it keeps, as a share of how far it goes; of its own, the
/// least speed at which one is met, as a share of the highest. What is below 1e-2 of those is
/// named.
///
/// Throws InvalidInput where the range is empty or `parameter` is not in it.
Branch continue_orbit(const Family& family, double parameter, const PeriodicOrbit& orbit,
                      const ContinuationOptions& options = {});

}  // namespace gearlash::hybrid
