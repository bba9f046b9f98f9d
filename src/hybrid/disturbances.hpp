// What small disturbances become along a motion, across events too (saltation).
#pragma once

#include <limits>

#include "hybrid/hybrid_trajectory.hpp"

namespace gearlash::hybrid {

/// How fast the motion meets the guard of an event. Precondition: a transition.
double speed_at_guard(const HybridSystem& system, const Event& event);

/// Carries disturbances of a motion, columns, across an event at their own times. Let f be the flow
/// before it, in `mode`, f⁺ after it, g = c·x + d its guard and R its reset. A disturbance δ
/// becomes
///   R δ + (f⁺ − R f)(c·δ)/(c·f)
/// (saltation), and at a tick of a clock R δ. An event that another one causes at its own instant
/// (`is_chained`) is as late as that one: R δ − (f⁺ − R f)τ, with τ = −(c·δ)/(c·f) of the first, 0
/// for a tick. `delay` is τ of each column. False, with it unchanged, if the guard is met at no
/// speed: then there is no derivative.
/// Source: Aizerman & Gantmakher 1958; Leine & Nijmeijer, Dynamics and Bifurcations of Non-Smooth
/// Mechanical Systems (2004), ch. 7.
bool carry_over(const HybridSystem& system, std::size_t mode, const Event& event, bool is_chained,
                Matrix& disturbances, Eigen::RowVectorXd& delay);

/// ∂x/∂start along a motion, by carry_over().
class Disturbances {
 public:
  /// From a start at a time. The system must live as long.
  Disturbances(const HybridSystem& system, const State& start, double time);

  /// Along the flow of the present mode.
  void flow_to(double time);
  /// Up to an event and across it. False if its guard is met at no speed.
  bool meet(const Event& event);

  /// A column for each number of the start.
  const Matrix& slope() const { return slope_; }

 private:
  const HybridSystem& system_;
  std::size_t mode_;
  double time_;
  double last_event_ = std::numeric_limits<double>::quiet_NaN();
  Matrix slope_;
  Eigen::RowVectorXd delay_;  ///< ∂/∂start of the last event's time
};

}  // namespace gearlash::hybrid
