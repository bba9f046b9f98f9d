// What small disturbances become along a motion, across events too (saltation).
#pragma once

#include <limits>

#include "hybrid/hybrid_trajectory.hpp"

namespace gearlash::hybrid {

Vector velocity(const AffineFlow& flow, const Vector& numbers);

/// ∂x/∂start along a motion, each event at its own disturbed time. Let f be the flow before an
/// event, f⁺ after it, g = c·x + d its guard and R its reset. A disturbance δ becomes
///   R δ + (f⁺ − R f)(c·δ)/(c·f)
/// (saltation), and at a tick of a clock R δ. An event that another one causes at its own instant
/// is as late as that one: R δ − (f⁺ − R f)τ, with τ = −(c·δ)/(c·f) of the first, 0 for a tick.
/// Source: Aizerman & Gantmakher 1958; Leine & Nijmeijer, Dynamics and Bifurcations of Non-Smooth
/// Mechanical Systems (2004), ch. 7.
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
  bool delay_at(const Event& event, const Vector& flow_before);

  const HybridSystem& system_;
  std::size_t mode_;
  double time_;
  double last_event_ = std::numeric_limits<double>::quiet_NaN();
  Matrix slope_;
  Eigen::RowVectorXd delay_;  ///< ∂/∂start of the last event's time
};

}  // namespace gearlash::hybrid
