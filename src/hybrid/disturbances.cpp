#include "hybrid/disturbances.hpp"

#include <cmath>
#include <utility>

#include "numeric/linear_algebra.hpp"

namespace gearlash::hybrid {
namespace {

const AffineReset& reset_of(const AffineMode& mode, const Event& event) {
  switch (event.kind) {
    case EventKind::timed:
      return mode.timed[event.transition].reset;
    case EventKind::settling:
      return mode.transitions[event.transition].settling->reset;
    case EventKind::transition:
      break;
  }
  return mode.transitions[event.transition].reset;
}

}  // namespace

double speed_at_guard(const HybridSystem& system, const Event& event) {
  const AffineMode& mode = system.mode(event.mode);
  return std::abs(
      mode.transitions[event.transition].guard.normal.dot(mode.flow.velocity(event.before)));
}

bool carry_over(const HybridSystem& system, std::size_t mode, const Event& event, bool is_chained,
                Matrix& disturbances, Eigen::RowVectorXd& delay) {
  const AffineMode& left = system.mode(event.mode);
  const Matrix reset = reset_of(left, event).slope(system.size());
  const Vector before = system.mode(mode).flow.velocity(event.before);
  bool is_met = true;
  if (event.kind == EventKind::timed) {
    delay.setZero();
  } else if (!is_chained) {
    const Vector& normal = left.transitions[event.transition].guard.normal;
    const double speed = normal.dot(before);
    is_met = speed != 0.0;
    if (is_met) delay = normal.transpose() * disturbances / -speed;
  }
  const Vector jump = system.mode(event.mode_after).flow.velocity(event.after) - reset * before;
  disturbances = reset * disturbances - jump * delay;
  return is_met;
}

Disturbances::Disturbances(const HybridSystem& system, const State& start, double time)
    : system_(system),
      mode_(start.mode),
      time_(time),
      slope_(Matrix::Identity(system.size(), system.size())),
      delay_(Eigen::RowVectorXd::Zero(system.size())) {}

void Disturbances::flow_to(double time) {
  const double duration = time - time_;
  time_ = time;
  if (duration > 0.0) slope_ = exponential(system_.mode(mode_).flow.matrix * duration) * slope_;
}

bool Disturbances::meet(const Event& event) {
  const bool is_chained = event.time == last_event_;
  last_event_ = event.time;
  flow_to(event.time);
  const std::size_t mode = std::exchange(mode_, event.mode_after);
  return carry_over(system_, mode, event, is_chained, slope_, delay_);
}

}  // namespace gearlash::hybrid
