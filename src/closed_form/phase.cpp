#include "closed_form/phase.hpp"

#include <cmath>
#include <limits>

#include "base/special_numbers.hpp"

namespace gearlash {
namespace {

Face face_of(FaceSign sign) { return sign > 0.0 ? Face::forward : Face::backward; }

double gap_on(const ServoDynamics& dynamics, FaceSign face) {
  return face * 0.5 * dynamics.backlash;
}

Phase engaged_phase(const ServoDynamics& dynamics, FaceSign face, double position, double speed) {
  Phase phase;
  phase.mode = dynamics.backlash == 0.0 ? Mode::no_gap
               : face > 0.0             ? Mode::engaged_forward
                                        : Mode::engaged_backward;
  phase.face = face;
  phase.engaged = {dynamics.damping, position, speed};
  return phase;
}

GapState state_in_flight(const GapFlight& flight, double time) {
  return state_after(flight, time, decays_at(flight, time));
}

PhaseEnd no_event(const GapTouch& touch = {}) { return {.duration = infinity, .touch = touch}; }

/// The sum of the bounces to come; `imminent` if they need not be followed one by one.
SettlingBounces bounces_summed_up(const ServoDynamics& dynamics, FaceSign face,
                                  const GapState& after, std::size_t bounces) {
  constexpr std::size_t always_followed = 100;
  const SettlingBounces settling =
      settling_bounces(dynamics, face, after.load_position, after.load_speed, after.gap_speed);
  if (settling.imminent || bounces < always_followed) return settling;
  return fading_rattle(dynamics, face, after.load_position, after.load_speed, after.gap_speed);
}

/// The phase after an impact, the `bounces`-th in a row, that left the shafts in the state `after`.
Phase phase_after_impact(const ServoDynamics& dynamics, FaceSign face, const GapState& after,
                         std::size_t bounces) {
  if (after.gap_speed == 0.0) {
    if (stays_engaged(dynamics, face, after.load_position, after.load_speed)) {
      return engaged_phase(dynamics, face, after.load_position, after.load_speed);
    }
    return {.mode = Mode::separated,
            .face = face,
            .flight = flight_from_pull(dynamics, after.load_position, after.load_speed, after.gap)};
  }
  Phase phase = {.mode = Mode::separated,
                 .face = face,
                 .flight = flight_from(dynamics, after),
                 .impacts_in_a_row = bounces};
  const SettlingBounces summed_up = bounces_summed_up(dynamics, face, after, bounces);
  if (summed_up.imminent) {
    phase.mode = Mode::settling;
    phase.bounces = summed_up;
    phase.engaged = {dynamics.damping, after.load_position,
                     after.load_speed + dynamics.motor_inertia * after.gap_speed};
  }
  return phase;
}

/// Applies the impact law to faces that meet at relative speed `state.gap_speed`, and decides what
/// follows.
PhaseEnd meet(const ServoDynamics& dynamics, FaceSign face, double duration, GapState state,
              std::size_t impacts_before, const GapTouch& touch) {
  // Rounding may leave a grazing approach on the wrong side of zero.
  if (state.gap_speed * face < 0.0) state.gap_speed = 0.0;
  const ImpactOutcome outcome = impact(dynamics, state.load_speed, state.gap_speed);
  const GapState after = {state.load_position, outcome.load_speed, state.gap, outcome.gap_speed};
  return {.duration = duration,
          .has_event = true,
          .kind = EventKind::impact,
          .face = face_of(face),
          .before = state,
          .after = after,
          .energy_lost = outcome.energy_lost,
          .next = phase_after_impact(dynamics, face, after, impacts_before + 1),
          .touch = touch};
}

/// Whether a flight that starts on a face moves off it: the first of its derivatives that is not
/// zero decides.
bool leaves(const GapFlight& flight, FaceSign face) {
  if (flight.gap_speed != 0.0) return flight.gap_speed * face < 0.0;
  if (flight.gap_acceleration != 0.0) return flight.gap_acceleration * face < 0.0;
  return flight.gap_drive * face < 0.0;
}

PhaseEnd end_of_engagement(const ServoDynamics& dynamics, const Phase& phase, double horizon) {
  const EngagedFlow& flow = phase.engaged;
  const double duration =
      first_zero(dynamics.damping, mesh_torque(dynamics, flow.position, flow.speed),
                 mesh_torque_rate(dynamics, flow.position, flow.speed));
  if (!(duration <= horizon) || std::isinf(duration)) return no_event();
  const EngagedFlow::State state = flow.at(duration);
  PhaseEnd end{.duration = duration,
               .has_event = true,
               .kind = EventKind::separation,
               .face = face_of(phase.face),
               .next = parted_phase(dynamics, phase.face, state.position, state.speed)};
  const GapFlight& flight = end.next.flight;
  // N touches zero without crossing it only if it vanishes for good, within rounding.
  if (!leaves(flight, phase.face)) return no_event();
  end.before = {flight.load_position, state.speed, flight.gap, 0.0};
  end.after = {flight.load_position, flight.load_speed, flight.gap, flight.gap_speed};
  return end;
}

PhaseEnd end_of_settling(const ServoDynamics& dynamics, const Phase& phase, double horizon) {
  const double duration = phase.bounces.duration;
  if (duration > horizon) return no_event();
  const EngagedFlow::State state = phase.engaged.at(duration);
  const GapState touching = {state.position, state.speed, gap_on(dynamics, phase.face), 0.0};
  return {.duration = duration,
          .has_event = true,
          .kind = EventKind::settling,
          .face = face_of(phase.face),
          .before = touching,
          .after = touching,
          .energy_lost = phase.bounces.energy_lost,
          .next = engaged_phase(dynamics, phase.face, state.position, state.speed)};
}

Bounce bounce_from(const ServoDynamics& dynamics, const GapFlight& flight, double start) {
  return {flight, start, first_contact(flight, dynamics.backlash, infinity).time};
}

/// Follows the bounces of a settling phase one by one until `time`, or until the rest of them is
/// shorter than a double resolves there.
GapState state_while_settling(const ServoDynamics& dynamics, const Phase& phase, double time) {
  const double resolution = std::numeric_limits<double>::epsilon() * time;
  for (Bounce bounce = first_bounce(dynamics, phase);
       phase.bounces.duration - bounce.start > resolution;
       bounce = bounce_after(dynamics, bounce)) {
    if (bounce.start + bounce.duration > time) {
      return state_in_flight(bounce.flight, time - bounce.start);
    }
    if (!(bounce.duration > resolution)) break;
  }
  const EngagedFlow::State common = phase.engaged.at(time);
  return {common.position, common.speed, gap_on(dynamics, phase.face), 0.0};
}

}  // namespace

Phase parted_phase(const ServoDynamics& dynamics, FaceSign face, double load_position,
                   double load_speed) {
  return {.mode = Mode::separated,
          .face = face,
          .flight =
              flight_from_separation(dynamics, load_position, load_speed, gap_on(dynamics, face))};
}

PhaseStart begin_phase(const ServoDynamics& dynamics, const GapState& state) {
  PhaseStart start;
  if (dynamics.backlash == 0.0) {
    start.phase = engaged_phase(dynamics, 1.0, state.load_position,
                                state.load_speed + dynamics.motor_inertia * state.gap_speed);
    return start;
  }
  const bool on_face = std::abs(state.gap) >= 0.5 * dynamics.backlash;
  const FaceSign face = state.gap >= 0.0 ? 1.0 : -1.0;
  GapState clamped = state;
  if (on_face) clamped.gap = gap_on(dynamics, face);
  // A massless shaft in the gap has the speed of its own law, whatever speed is given.
  const GapFlight flight = flight_from(dynamics, clamped);
  const bool touching = on_face && (state.gap_speed == 0.0 || flight.gap_speed == 0.0);
  if (touching && stays_engaged(dynamics, face, state.load_position, state.load_speed)) {
    start.phase = engaged_phase(dynamics, face, state.load_position, state.load_speed);
    return start;
  }
  if (touching) {
    start.phase.mode = Mode::separated;
    start.phase.face = face;
    start.phase.flight =
        flight_from_pull(dynamics, state.load_position, state.load_speed, clamped.gap);
    return start;
  }
  if (on_face && flight.gap_speed * face > 0.0) {
    start.impact_at_start = true;
    start.impact = meet(dynamics, face, 0.0, clamped, 0, {});
    start.phase = start.impact.next;
    return start;
  }
  start.phase.mode = Mode::separated;
  start.phase.face = face;
  start.phase.flight = flight;
  return start;
}

PhaseEnd end_of_phase(const ServoDynamics& dynamics, const Phase& phase, double horizon) {
  switch (phase.mode) {
    case Mode::no_gap:
      return no_event();
    case Mode::engaged_forward:
    case Mode::engaged_backward:
      return end_of_engagement(dynamics, phase, horizon);
    case Mode::settling:
      return end_of_settling(dynamics, phase, horizon);
    case Mode::separated:
      break;
  }
  const FirstContact contact = first_contact(phase.flight, dynamics.backlash, horizon);
  if (contact.toward == 0.0) return no_event(contact.touch);
  const FlightMotion motion = motion_in_flight(phase.flight, contact.time);
  return meet(
      dynamics, contact.toward, contact.time,
      {motion.load_position, motion.load_speed, gap_on(dynamics, contact.toward), motion.gap_speed},
      contact.toward == phase.face ? phase.impacts_in_a_row : 0, contact.touch);
}

GapState state_in_phase(const ServoDynamics& dynamics, const Phase& phase, double time) {
  if (phase.mode == Mode::separated) return state_in_flight(phase.flight, time);
  if (phase.mode == Mode::settling) return state_while_settling(dynamics, phase, time);
  const EngagedFlow::State state = phase.engaged.at(time);
  return {state.position, state.speed, gap_on(dynamics, phase.face), 0.0};
}

Bounce first_bounce(const ServoDynamics& dynamics, const Phase& phase) {
  return bounce_from(dynamics, phase.flight, 0.0);
}

Bounce bounce_after(const ServoDynamics& dynamics, const Bounce& bounce) {
  const GapState state = state_in_flight(bounce.flight, bounce.duration);
  const ImpactOutcome outcome = impact(dynamics, state.load_speed, state.gap_speed);
  const GapState after = {state.load_position, outcome.load_speed, bounce.flight.gap,
                          outcome.gap_speed};
  return bounce_from(dynamics, flight_from(dynamics, after), bounce.start + bounce.duration);
}

}  // namespace gearlash
