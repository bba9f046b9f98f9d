#include "hybrid/disturbances.hpp"

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

Vector velocity(const AffineFlow& flow, const Vector& numbers) {
  return flow.matrix * numbers + flow.offset;
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

bool Disturbances::delay_at(const Event& event, const Vector& flow_before) {
  const AffineForm& guard = system_.mode(mode_).transitions[event.transition].guard;
  const double speed = guard.normal.dot(flow_before);
  if (speed == 0.0) return false;
  delay_ = guard.normal.transpose() * slope_;
  delay_ /= -speed;
  return true;
}

bool Disturbances::meet(const Event& event) {
  const bool is_chained = event.time == last_event_;
  last_event_ = event.time;
  flow_to(event.time);
  const Matrix reset = reset_of(system_.mode(event.mode), event).slope(system_.size());
  const Vector flow_before = velocity(system_.mode(mode_).flow, event.before);
  if (event.kind == EventKind::timed) {
    delay_.setZero();
  } else if (!is_chained && !delay_at(event, flow_before)) {
    // An event that another one causes at its own instant is delayed as that one is.
    return false;
  }
  mode_ = event.mode_after;
  const Vector jump = velocity(system_.mode(mode_).flow, event.after) - reset * flow_before;
  slope_ = reset * slope_ - jump * delay_;
  return true;
}

}  // namespace gearlash::hybrid
