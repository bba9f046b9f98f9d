// Follows a periodic orbit through folds as one parameter of its system changes.
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "gearlash/progress.hpp"
#include "hybrid/periodic_orbit.hpp"

namespace gearlash::hybrid {

/// The system for a parameter's value. The state's numbers and the modes stay the same.
using Family = std::function<HybridSystem(double parameter)>;

struct BranchPoint {
  double parameter = std::numeric_limits<double>::quiet_NaN();
  PeriodicOrbit orbit;
};

/// What happens to an orbit as the parameter passes a value.
enum class BifurcationKind {
  fold,       ///< the branch turns back: a stable and an unstable orbit meet; a multiplier is 1
  branching,  ///< a multiplier passes 1 and the branch goes on: another one crosses it, as where
              ///< an orbit loses its symmetry
  flip,       ///< a multiplier passes −1: an orbit of twice the period begins
  neimark_sacker  ///< two conjugate multipliers leave the unit circle: motion on a torus begins
};

struct Bifurcation {
  BifurcationKind kind = BifurcationKind::fold;
  double parameter = std::numeric_limits<double>::quiet_NaN();
  PeriodicOrbit orbit;
};

enum class BranchEnd {
  left_range,  ///< the last point is at an end of the range
  grazing,     ///< a guard without an event is touched, a guard is met at no speed, or another mode
               ///< follows an event: `culprit`. Beyond, the orbit has other events
  endless_period,  ///< the period has grown by `longest_period`: the orbit nears one of infinite
                   ///< period, from a rest back to it, as where hunting ends
  point_limit,     ///< the requested number of points is reached
  stopped,         ///< by the progress
  lost             ///< Newton's method finds no neighbour, for an unknown reason
};

struct Branch {
  std::vector<BranchPoint> points;        ///< from the given orbit on, in the order of the branch
  std::vector<Bifurcation> bifurcations;  ///< in the order of the branch
  BranchEnd end = BranchEnd::lost;
  std::string culprit;  ///< "mode: transition" of a grazing
};

struct ContinuationOptions {
  double low = -std::numeric_limits<double>::infinity();  ///< of the parameter
  double high = std::numeric_limits<double>::infinity();
  bool upwards = true;            ///< direction of the parameter at first
  double first_step = 1e-2;       ///< arclength; the parameter at the start, and the
  double longest_step = 0.1;      ///< largest number of the orbit, count as 1
  double longest_period = 100.0;  ///< times that of the first orbit
  std::size_t most_points = 500;
  Progress* progress = nullptr;  ///< asked at each of Newton's steps; nullptr: nothing stops it
};

/// Pseudo-arclength continuation (Keller 1977). Let z be the starts of an orbit's phases and the
/// parameter, G(z) = 0 the equations of closing_orbit(), and t the unit tangent. Then
///   G(z) = 0,  t·(z − z_last) = step
/// has a neighbouring solution, beyond a fold too. Steps are doubled where Newton's method
/// converges quickly, and halved where it fails. Below 1e-5 the branch ends. (Towards the grazing
/// of its own impact they shrink as the square of its speed, which leaves about 1e-4 of the
/// parameter.) Folds are closed in on until the tangent has no component along the parameter, the
/// other bifurcations until the multiplier that passes has modulus 1. Two multipliers that pass
/// within one step in opposite directions are missed.
/// Central differences differentiate G by the parameter; that costs Newton's method steps, not
/// digits.
///
/// The last orbit reveals a grazing. Of all guards that do not end a stretch, the measure is the
/// least distance from the guard where it turns back, as a share of its largest. Of the orbit's own
/// guards, it is the least speed at which one is met, as a share of the highest. Of what decides
/// which mode follows an event, it is its size as a share of its terms. The smallest measure names
/// the grazing if that is below 1e-2.
///
/// Throws InvalidInput if the range is empty or `parameter` is not in it.
Branch continue_orbit(const Family& family, double parameter, const PeriodicOrbit& orbit,
                      const ContinuationOptions& options = {});

}  // namespace gearlash::hybrid
