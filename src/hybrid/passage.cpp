#include "hybrid/passage.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "numeric/linear_algebra.hpp"

namespace gearlash::hybrid {
namespace {

Vector velocity(const AffineMode& mode, const Vector& state) {
  return mode.flow.matrix * state + mode.flow.offset;
}

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

/// ∂x/∂start across flows and events, each event at its own disturbed time.
class Disturbances {
 public:
  Disturbances(const HybridSystem& system, const State& start, double time)
      : system_(system),
        mode_(start.mode),
        time_(time),
        slope_(Matrix::Identity(system.size(), system.size())),
        delay_(Eigen::RowVectorXd::Zero(system.size())) {}

  void flow_to(double time) {
    if (time > time_) slope_ = exponential(flow().matrix * (time - time_)) * slope_;
    time_ = time;
  }

  /// False if the guard is met at no speed.
  bool meet(const Event& event) {
    const bool is_chained = event.time == last_event_;
    last_event_ = event.time;
    flow_to(event.time);
    const AffineMode& before = system_.mode(mode_);
    const Matrix reset = reset_of(system_.mode(event.mode), event).slope(system_.size());
    const Vector flow_before = velocity(before, event.before);
    mode_ = event.mode_after;
    if (event.kind == EventKind::timed) {
      delay_.setZero();
    } else if (!is_chained) {
      // An event that another one causes at its own instant is delayed as that one is.
      const Vector& normal = before.transitions[event.transition].guard.normal;
      const double speed = normal.dot(flow_before);
      if (speed == 0.0) return false;
      delay_ = -(normal.transpose() * slope_) / speed;
    }
    const Vector jump = velocity(system_.mode(mode_), event.after) - reset * flow_before;
    slope_ = reset * slope_ - jump * delay_;
    return true;
  }

  const Matrix& slope() const { return slope_; }

 private:
  const AffineFlow& flow() const { return system_.mode(mode_).flow; }

  const HybridSystem& system_;
  std::size_t mode_;
  double time_;
  double last_event_ = std::numeric_limits<double>::quiet_NaN();
  Matrix slope_;
  Eigen::RowVectorXd delay_;  ///< ∂/∂start of the last event's time
};

/// The time near a guess at which the motion crosses a plane. Empty if it does not.
std::optional<double> crossing_time(const AffineMode& mode, const State& start, double from,
                                    const AffineForm& plane, double guess) {
  const Eigen::Index size = start.numbers.size();
  Matrix augmented = Matrix::Zero(size + 1, size + 1);  // (x, 1)′
  augmented.topLeftCorner(size, size) = mode.flow.matrix;
  augmented.topRightCorner(size, 1) = mode.flow.offset;
  Vector extended(size + 1);
  extended << start.numbers, 1.0;
  double time = std::max(guess - from, 0.0);
  for (int i = 0; i < 40; ++i) {
    const Vector here = (exponential(augmented * time) * extended).head(size);
    const double step = -plane.at(here) / plane.normal.dot(velocity(mode, here));
    if (!std::isfinite(step)) return std::nullopt;
    time += step;
    if (!(time >= 0.0)) return std::nullopt;
    constexpr double short_step = 1e-15;
    if (std::abs(step) <= short_step * (from + time)) break;
  }
  return from + time;
}

}  // namespace

std::optional<Passage> pass(const PreparedSystem& prepared, const State& start, double from,
                            std::size_t events, const Finish& finish) {
  const HybridSystem& system = prepared.system();
  double end_time = finish.time;
  if (finish.plane) {
    constexpr double patience = 4.0;
    const Trajectory to_last = simulate(
        prepared, start,
        {.from = from, .until = from + patience * (finish.time - from), .event_limit = events});
    if (to_last.events().size() < events) return std::nullopt;
    const State& last = to_last.end();
    const auto crossing =
        crossing_time(system.mode(last.mode), last, to_last.end_time(), *finish.plane, finish.time);
    if (!crossing) return std::nullopt;
    end_time = *crossing;
  }
  const Trajectory motion = simulate(prepared, start, {.from = from, .until = end_time});
  if (motion.events().size() != events) return std::nullopt;
  Disturbances disturbances(system, start, from);
  for (const Event& event : motion.events()) {
    if (!disturbances.meet(event)) return std::nullopt;
  }
  disturbances.flow_to(end_time);
  Passage passage;
  passage.events = motion.events();
  passage.end = motion.end();
  passage.duration = end_time - from;
  passage.slope_at_time = disturbances.slope();
  passage.slope = passage.slope_at_time;
  passage.duration_slope = Vector::Zero(system.size());
  if (!finish.plane) return passage;
  const Vector flow = velocity(system.mode(passage.end.mode), passage.end.numbers);
  passage.duration_slope = -(finish.plane->normal.transpose() * passage.slope).transpose() /
                           finish.plane->normal.dot(flow);
  passage.slope += flow * passage.duration_slope.transpose();
  return passage;
}

}  // namespace gearlash::hybrid
