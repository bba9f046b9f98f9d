#include "closed_form/extremes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/bracketed_root.hpp"
#include "closed_form/phase.hpp"

namespace gearlash {
namespace {

/// Extremes so far, of states about the reference.
struct Range {
  double reference;
  Extremes extremes;

  void include(const GapState& state) {
    const double load = reference + state.load_position;
    extremes.load.include(load);
    extremes.motor.include(load + state.gap);
  }
};

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
    // The position is stationary there, so a time from bisection is accurate enough.
    const auto speed = [&](double t) { return ValueAndSlope{motor_speed(t), 0.0}; };
    times.push_back(
        bracketed_root(speed, start, end, 0.5 * (start + end), end_speed > 0.0 ? 1.0 : -1.0));
  }
  return times;
}

/// Includes a motion of one closed form, but not its end, which is the next motion's start.
void include(Range& range, const ServoDynamics& dynamics, const Phase& phase, double from,
             double to) {
  if (!(from < to)) return;
  range.include(state_in_phase(dynamics, phase, from));
  for (const double time : phase.mode == Mode::separated
                               ? motor_turning_times(phase.flight, from, to)
                               : engaged_turning_times(phase.engaged, from, to)) {
    range.include(state_in_phase(dynamics, phase, time));
  }
}

/// Whether a bounce moves the shafts by more than rounding does.
bool matters(const Bounce& bounce) {
  const double height = 0.25 * std::abs(bounce.flight.gap_speed) * bounce.duration;
  return height > std::numeric_limits<double>::epsilon() *
                      (std::abs(bounce.flight.load_position) + std::abs(bounce.flight.gap));
}

void include_settling(Range& range, const ServoDynamics& dynamics, const Phase& phase, double from,
                      double to) {
  Bounce bounce = first_bounce(dynamics, phase);
  for (; bounce.start < to && matters(bounce); bounce = bounce_after(dynamics, bounce)) {
    include(range, dynamics, {.mode = Mode::separated, .flight = bounce.flight},
            std::max(from - bounce.start, 0.0), std::min(to - bounce.start, bounce.duration));
  }
  Phase together = phase;
  together.mode = phase.face > 0.0 ? Mode::engaged_forward : Mode::engaged_backward;
  include(range, dynamics, together, std::max(from, bounce.start), to);
}

}  // namespace

Extremes extremes(const Trajectory& trajectory, double from, double to) {
  const double first = std::clamp(from, trajectory.start_time(), trajectory.end_time());
  const double last = std::clamp(to, first, trajectory.end_time());
  const ServoDynamics& dynamics = trajectory.dynamics_;
  Range range{trajectory.reference_, {}};
  for (const double end : {first, last}) {
    const Segment& segment = trajectory.segment_at(end);
    range.include(state_in_phase(dynamics, segment.phase, end - segment.start));
  }
  for (const Segment& segment : trajectory.segments()) {
    const double low = std::max(first, segment.start) - segment.start;
    const double high = std::min(last, segment.end) - segment.start;
    const bool settling = segment.phase.mode == Mode::settling;
    (settling ? include_settling : include)(range, dynamics, segment.phase, low, high);
  }
  return range.extremes;
}

}  // namespace gearlash
