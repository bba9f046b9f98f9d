#include "hybrid/disturbances.hpp"

#include "numeric/linear_algebra.hpp"

namespace gearlash::hybrid {
namespace {

using Index = Eigen::Index;

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

Disturbances::Disturbances(const HybridSystem& system, const State& start, double time,
                           const SystemSlopes* slopes)
    : system_(system),
      slopes_(slopes),
      mode_(start.mode),
      numbers_(start.numbers),
      time_(time),
      slope_(Matrix::Identity(system.size(), system.size() + (slopes != nullptr ? 1 : 0))),
      delay_(Eigen::RowVectorXd::Zero(slope_.cols())) {}

bool Disturbances::flow_to(double time) {
  const double duration = time - time_;
  time_ = time;
  return duration <= 0.0 || carry_on(duration);
}

bool Disturbances::carry_on(double duration) {
  const AffineFlow& flow = system_.mode(mode_).flow;
  if (slopes_ == nullptr) {
    slope_ = exponential(flow.matrix * duration) * slope_;
    return true;
  }
  const ModeSlopes* slopes = slopes_->mode(mode_);
  if (slopes == nullptr) return false;
  // The motion's numbers, 1, and the disturbances move as one linear system.
  const Index size = system_.size();
  Matrix joint = Matrix::Zero(2 * size + 1, 2 * size + 1);
  joint.topLeftCorner(size, size) = flow.matrix;
  joint.col(size).head(size) = flow.offset;
  joint.bottomLeftCorner(size, size) = slopes->flow.matrix;
  joint.col(size).tail(size) = slopes->flow.offset;
  joint.bottomRightCorner(size, size) = flow.matrix;
  const Matrix moved = exponential(joint * duration);
  slope_ = moved.bottomRightCorner(size, size) * slope_;
  slope_.col(size) += moved.bottomLeftCorner(size, size) * numbers_ + moved.col(size).tail(size);
  numbers_ = moved.topLeftCorner(size, size) * numbers_ + moved.col(size).head(size);
  return true;
}

bool Disturbances::delay_at(const Event& event, const Vector& flow_before) {
  const AffineForm& guard = system_.mode(mode_).transitions[event.transition].guard;
  const double speed = guard.normal.dot(flow_before);
  if (speed == 0.0) return false;
  delay_ = guard.normal.transpose() * slope_;
  if (slopes_ != nullptr) {
    const ModeSlopes* slopes = slopes_->mode(mode_);
    if (slopes == nullptr) return false;
    delay_[system_.size()] += slopes->guards[event.transition].at(event.before);
  }
  delay_ /= -speed;
  return true;
}

bool Disturbances::meet(const Event& event) {
  const bool is_chained = event.time == last_event_;
  last_event_ = event.time;
  if (!flow_to(event.time)) return false;
  const Matrix reset = reset_of(system_.mode(event.mode), event).slope(system_.size());
  const Vector flow_before = velocity(system_.mode(mode_).flow, event.before);
  if (event.kind == EventKind::timed) {
    delay_.setZero();
  } else if (!is_chained && !delay_at(event, flow_before)) {
    // An event that another one causes at its own instant is delayed as that one is.
    return false;
  }
  mode_ = event.mode_after;
  numbers_ = event.after;
  const Vector jump = velocity(system_.mode(mode_).flow, event.after) - reset * flow_before;
  slope_ = reset * slope_ - jump * delay_;
  if (slopes_ == nullptr || event.kind == EventKind::timed) return true;
  const ModeSlopes* slopes = slopes_->mode(event.mode);
  if (slopes == nullptr) return false;
  const bool settles = event.kind == EventKind::settling;
  const auto& resets = settles ? slopes->settlings : slopes->resets;
  slope_.col(system_.size()) += velocity(resets[event.transition], event.before);
  return true;
}

}  // namespace gearlash::hybrid
