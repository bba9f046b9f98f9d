#include "passage.hpp"

#include <cmath>
#include <unsupported/Eigen/MatrixFunctions>

namespace gearlash::hybrid {
namespace {

Vector velocity(const Mode& mode, const Vector& state) {
  return mode.flow.matrix * state + mode.flow.offset;
}

const Reset& reset_of(const Mode& mode, const Event& event) {
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

std::optional<Passage> pass(const HybridSystem& system, const State& start, double from,
                            double until, std::size_t events) {
  const Trajectory motion =
      simulate(system, start, {.from = from, .until = until, .event_limit = events});
  if (motion.events().size() < events) return std::nullopt;
  const Eigen::Index size = system.size();
  Passage passage{motion.end(), motion.end_time() - from, {}, Vector::Zero(size),
                  {},           motion.events()};
  Matrix at_time = Matrix::Identity(size, size);  // of what is reached, by the start
  double time = from;
  std::size_t mode = start.mode;
  for (const Event& event : motion.events()) {
    const Mode& before = system.modes[mode];
    if (event.time > time) {
      at_time = (before.flow.matrix * (event.time - time)).exp() * at_time;
      time = event.time;
    }
    const Matrix reset = reset_of(system.modes[event.mode], event).slope(size);
    mode = event.mode_after;
    if (event.kind == EventKind::timed) {
      passage.slope = reset * at_time;
      passage.duration_slope.setZero();
    } else if (event.kind == EventKind::settling) {
      passage.slope = reset * passage.slope;  // at the firing before it
    } else {
      const Vector& normal = before.transitions[event.transition].guard.normal;
      const Vector flow = velocity(before, event.before);
      const double speed = normal.dot(flow);
      if (speed == 0.0) return std::nullopt;
      passage.duration_slope = -(normal.transpose() * at_time).transpose() / speed;
      passage.slope = reset * (at_time + flow * passage.duration_slope.transpose());
    }
    at_time = passage.slope -
              velocity(system.modes[mode], event.after) * passage.duration_slope.transpose();
  }
  passage.slope_at_time = at_time;
  return passage;
}

}  // namespace gearlash::hybrid
