#include "gearlash/motion/extremes.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "gearlash/motion/bracketed_root.hpp"

namespace gearlash {
namespace {

void include(Extremes& so_far, const ServoState& state) {
  so_far.load_lowest = std::min(so_far.load_lowest, state.load_position);
  so_far.load_highest = std::max(so_far.load_highest, state.load_position);
  so_far.motor_lowest = std::min(so_far.motor_lowest, state.motor_position);
  so_far.motor_highest = std::max(so_far.motor_highest, state.motor_position);
}

std::vector<double> engaged_turning_times(const EngagedFlow& flow, double from, double to) {
  std::vector<double> times;
  double time = from;
  for (int turn = 0; turn < 2; ++turn) {
    const EngagedFlow::State state = flow.at(time);
    time +=
        first_zero(flow.damping, state.speed, -2.0 * flow.damping * state.speed - state.position);
    if (!(time < to)) break;
    times.push_back(time);
  }
  return times;
}

/// When the coasting load passes the reference: t φ(Dt) = −y₀/v₀; `otherwise` if it never does.
double reference_passing_time(const GapFlight& flight, double otherwise) {
  const double distance = -flight.load_position / flight.load_speed;
  if (!(distance > 0.0) || std::isinf(distance)) return otherwise;
  const double share = flight.load_rate * distance;
  if (share >= 1.0) return otherwise;
  return share == 0.0 ? distance : -std::log1p(-share) / flight.load_rate;
}

std::vector<double> motor_turning_times(const GapFlight& flight, double from, double to) {
  const auto motor_speed = [&](double t) {
    const FlightMotion motion = motion_in_flight(flight, t);
    return motion.load_speed + motion.gap_speed;
  };
  std::vector<double> times;
  const double passing = std::clamp(reference_passing_time(flight, to), from, to);
  times.push_back(passing);
  for (const auto& [start, end] : {std::pair{from, passing}, std::pair{passing, to}}) {
    const double start_speed = motor_speed(start);
    const double end_speed = motor_speed(end);
    if (!(start_speed * end_speed < 0.0)) continue;
    // The position is stationary there: a bisected time is more than it needs.
    const auto speed = [&](double t) { return ValueAndSlope{motor_speed(t), 0.0}; };
    times.push_back(
        bracketed_root(speed, start, end, 0.5 * (start + end), end_speed > 0.0 ? 1.0 : -1.0));
  }
  return times;
}

std::vector<double> turning_times(const Phase& phase, double from, double to) {
  if (phase.mode == Mode::settling) return {};
  if (phase.mode == Mode::separated) return motor_turning_times(phase.flight, from, to);
  return engaged_turning_times(phase.engaged, from, to);
}

}  // namespace

Extremes extremes(const Trajectory& trajectory, double from, double to) {
  const double first = std::clamp(from, trajectory.start_time(), trajectory.end_time());
  const double last = std::clamp(to, first, trajectory.end_time());
  const ServoState start = trajectory.at(first);
  Extremes result{start.load_position, start.load_position, start.motor_position,
                  start.motor_position};
  include(result, trajectory.at(last));
  for (const Segment& segment : trajectory.segments()) {
    const double low = std::max(first, segment.start);
    const double high = std::min(last, segment.end);
    if (!(low < high)) continue;
    include(result, trajectory.at(low));
    for (const double time :
         turning_times(segment.phase, low - segment.start, high - segment.start)) {
      include(result, trajectory.at(segment.start + time));
    }
  }
  return result;
}

}  // namespace gearlash
