#include "closed_form/trajectory.hpp"

#include <algorithm>
#include <cmath>

#include "base/range_check.hpp"
#include "numeric/panel_quadrature.hpp"

namespace gearlash {
namespace {

ServoState to_servo_state(const GapState& state, double reference) {
  const double load_position = reference + state.load_position;
  ServoState result{.motor_position = load_position + state.gap,
                    .load_position = load_position,
                    .load_speed = state.load_speed};
  result.set_gap_speed(state.gap_speed);
  return result;
}

GapState to_gap_state(const ServoState& state, double reference) {
  return {state.load_position - reference, state.load_speed,
          state.motor_position - state.load_position, state.gap_speed()};
}

Event to_event(const PhaseEnd& end, double time, double reference) {
  return {.time = time,
          .kind = end.kind,
          .face = end.face,
          .before = to_servo_state(end.before, reference),
          .after = to_servo_state(end.after, reference),
          .mode_after = end.next.mode,
          .energy_lost = end.energy_lost};
}

/// The gap may exceed its faces by the rounding of the two positions it is the difference of.
double gap_allowance(const ServoState& state) {
  return 4.0 * std::numeric_limits<double>::epsilon() *
         std::max(std::abs(state.motor_position), std::abs(state.load_position));
}

std::vector<Fault> faults_of_start(const NormalizedServo& servo, const ServoState& initial,
                                   const SimulationOptions& options) {
  constexpr double largest = 1e100;  // squares and cubes stay finite
  RangeCheck check;
  check.include(faults(servo));
  check.within("initial.motor_position", initial.motor_position, -largest, largest);
  check.within("initial.motor_speed", initial.motor_speed, -largest, largest);
  check.within("initial.load_position", initial.load_position, -largest, largest);
  check.within("initial.load_speed", initial.load_speed, -largest, largest);
  check.within("initial.motor_speed_remainder", initial.motor_speed_remainder, -largest, largest);
  check.within("reference", options.reference, -largest, largest);
  check.within("until", options.until, 0.0, longest_simulation);
  const double gap = initial.motor_position - initial.load_position;
  if (std::abs(gap) > 0.5 * servo.backlash + gap_allowance(initial)) {
    const std::string half = exact_text(0.5 * servo.backlash);
    check.refuse("initial.motor_position - initial.load_position", exact_text(gap),
                 "must be from -" + half + " to " + half + " (half the backlash each way)");
  }
  return check.faults();
}

/// Moves a gap within rounding of a face onto it.
GapState snapped_to_faces(GapState state, const ServoState& initial, double backlash) {
  if (std::abs(std::abs(state.gap) - 0.5 * backlash) <= gap_allowance(initial)) {
    state.gap = std::copysign(0.5 * backlash, state.gap);
  }
  return state;
}

/// Adds the friction losses and the loop's supply over the first `duration` of a phase. For a
/// settling phase these are the losses of the common motion, and those of the bounces at once.
void accumulate(const ServoDynamics& dynamics, const Phase& phase, double duration,
                EnergyAccount& account) {
  if (phase.mode != Mode::separated) {
    const double speed_squared =
        panel_integral([&](double t) { return std::pow(phase.engaged.at(t).speed, 2); }, duration,
                       2.0 * dynamics.damping);
    account.motor_friction +=
        dynamics.motor_friction * speed_squared + phase.bounces.motor_friction_lost;
    account.load_friction +=
        dynamics.load_friction * speed_squared + phase.bounces.load_friction_lost;
    return;
  }
  const GapFlight& flight = phase.flight;
  const double fastest = std::max(flight.load_rate, flight.motor_rate);
  const auto motor_speed_squared = [&](double t) {
    const FlightMotion motion = motion_in_flight(flight, t);
    return std::pow(motion.load_speed + motion.gap_speed, 2);
  };
  const auto load_speed_squared = [&](double t) {
    return std::pow(motion_in_flight(flight, t).load_speed, 2);
  };
  const auto loop_power = [&](double t) {
    const FlightMotion motion = motion_in_flight(flight, t);
    return -motion.load_position * motion.gap_speed;
  };
  account.motor_friction +=
      dynamics.motor_friction * panel_integral(motor_speed_squared, duration, fastest);
  account.load_friction +=
      dynamics.load_friction * panel_integral(load_speed_squared, duration, fastest);
  account.supplied += panel_integral(loop_power, duration, fastest);
}

double kinetic_energy(const ServoDynamics& dynamics, const GapState& state) {
  const double motor_speed = state.load_speed + state.gap_speed;
  return 0.5 * (dynamics.motor_inertia * motor_speed * motor_speed +
                dynamics.load_inertia * state.load_speed * state.load_speed);
}

}  // namespace

double Trajectory::end_time() const { return segments_.empty() ? 0.0 : segments_.back().end; }

const Segment& Trajectory::segment_at(double time) const {
  const auto after =
      std::upper_bound(segments_.begin(), segments_.end(), time,
                       [](double value, const Segment& segment) { return value < segment.start; });
  return after == segments_.begin() ? segments_.front() : *(after - 1);
}

ServoState Trajectory::at(double time) const {
  const double clamped = std::clamp(time, 0.0, end_time());
  const Segment& segment = segment_at(clamped);
  return to_servo_state(state_in_phase(dynamics_, segment.phase, clamped - segment.start),
                        reference_);
}

Mode Trajectory::mode_at(double time) const { return segment_at(time).phase.mode; }

EnergyAccount Trajectory::energy_at(double time) const {
  const double clamped = std::clamp(time, 0.0, end_time());
  EnergyAccount account;
  for (const Segment& segment : segments_) {
    if (segment.start > clamped) break;
    accumulate(dynamics_, segment.phase, std::min(segment.end, clamped) - segment.start, account);
  }
  for (const Event& event : events_) {
    if (event.time > clamped) break;
    account.impacts += event.energy_lost;
  }
  const Segment& segment = segment_at(clamped);
  const GapState state = state_in_phase(dynamics_, segment.phase, clamped - segment.start);
  account.kinetic = kinetic_energy(dynamics_, state);
  account.elastic = 0.5 * state.load_position * state.load_position;
  return account;
}

ServoState engaged_start(const NormalizedServo& servo, double load_position, double load_speed,
                         double reference) {
  const double side = reference >= load_position ? 0.5 : -0.5;
  return {load_position + side * servo.backlash, load_speed, load_position, load_speed};
}

Trajectory simulate(const NormalizedServo& servo, const ServoState& initial,
                    const SimulationOptions& options) {
  require_none(faults_of_start(servo, initial, options));
  Trajectory trajectory;
  trajectory.dynamics_ = servo_dynamics(servo);
  trajectory.reference_ = options.reference;
  const ServoDynamics& dynamics = trajectory.dynamics_;

  const GapState state =
      snapped_to_faces(to_gap_state(initial, options.reference), initial, servo.backlash);
  constexpr std::size_t usual_size = 4;
  std::vector<Segment>& segments = trajectory.segments_;
  std::vector<Event>& events = trajectory.events_;
  segments.reserve(usual_size);
  events.reserve(usual_size);
  const PhaseStart start = begin_phase(dynamics, state);
  segments.push_back({0.0, 0.0, start.phase});
  trajectory.stop_reason_ = StopReason::event_limit;
  if (start.impact_at_start) {
    if (options.event_limit == 0) return trajectory;
    events.push_back(to_event(start.impact, 0.0, options.reference));
  }
  while (true) {
    Segment& segment = segments.back();
    const PhaseEnd end = end_of_phase(dynamics, segment.phase, options.until - segment.start);
    if (end.touch.toward != 0.0) {
      trajectory.touches_.push_back({segment.start + end.touch.time,
                                     end.touch.toward > 0.0 ? Face::forward : Face::backward});
    }
    if (!end.has_event) {
      segment.end = options.until;
      trajectory.stop_reason_ = StopReason::reached_end;
      return trajectory;
    }
    segment.end = segment.start + end.duration;
    if (events.size() >= options.event_limit) return trajectory;
    events.push_back(to_event(end, segment.end, options.reference));
    segments.push_back({segment.end, segment.end, end.next});
  }
}

}  // namespace gearlash
