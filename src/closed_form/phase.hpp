// One mode of motion in closed form, and the event that ends it.
#pragma once

#include <cstddef>

#include "closed_form/contact_law.hpp"
#include "closed_form/engaged_flow.hpp"
#include "closed_form/first_contact.hpp"
#include "closed_form/gap_flight.hpp"
#include "closed_form/servo_dynamics.hpp"

namespace gearlash {

/// The gear face in contact: on `forward` (u = +b/2) the motor can push the load forward.
enum class Face { forward, backward };

enum class Mode {
  engaged_forward,   ///< both move as one, u = +b/2
  engaged_backward,  ///< both move as one, u = −b/2
  separated,         ///< the load coasts, the motor runs alone
  settling,          ///< the sum of the last bounces: infinitely many, or too many to follow
  no_gap             ///< backlash 0: both move as one, pushing and pulling
};

enum class EventKind {
  separation,  ///< engaged faces part: the mesh torque reached zero
  impact,      ///< faces meet; `after` differs from `before` by the law of restitution
  settling     ///< the end of the last bounces: relative speed 0, faces engage
};

/// Positions are from the reference (y = θ − θ_ref); times from the phase's own start.
struct Phase {
  Mode mode = Mode::no_gap;
  FaceSign face = 1.0;               ///< engaged on, or bouncing on; unused when separated
  EngagedFlow engaged{};             ///< engaged and no_gap; when settling, the common motion
  GapFlight flight{};                ///< separated; when settling, the first of the bounces
  SettlingBounces bounces{};         ///< settling only
  std::size_t impacts_in_a_row = 0;  ///< separated: on `face`, without parting or crossing between
};

/// How a phase ends.
struct PhaseEnd {
  double duration = 0.0;  ///< infinity (or beyond the horizon): no event within it
  bool has_event = false;
  EventKind kind = EventKind::separation;
  Face face = Face::forward;
  GapState before{};
  GapState after{};
  double energy_lost = 0.0;
  Phase next{};
  GapTouch touch{};  ///< of a flight, see first_contact()
};

/// The phase that a state begins. Contact is resolved at once if the state is on a face and moves
/// into it (an impact at time 0, reported by `event_at_start`) or touches it at rest.
struct PhaseStart {
  bool impact_at_start = false;
  PhaseEnd impact;  ///< meaningful when impact_at_start; duration 0
  Phase phase;
};
PhaseStart begin_phase(const ServoDynamics& dynamics, const GapState& state);

/// The event that ends the phase, if it comes within `horizon` (which may be infinite).
///
/// Rules, in order. Engaged: ends where s N falls through zero (first_zero, closed form).
/// Separated: ends at the first contact with either face (first_contact), where the impact law is
/// applied. If the relative speed after it is zero, stays_engaged() decides between engagement and
/// parting at once. Otherwise the settling phase begins if the remaining bounces are
/// settling_bounces().imminent or, after a hundred of them, fading_rattle().imminent. Otherwise the
/// next flight begins. Settling: ends after its closed-form duration, engaged. So an impact and a
/// separation at one instant come in that order.
PhaseEnd end_of_phase(const ServoDynamics& dynamics, const Phase& phase, double horizon);

/// State at `time` within the phase. Within a settling phase the bounces are followed one by one.
GapState state_in_phase(const ServoDynamics& dynamics, const Phase& phase, double time);

/// One of the bounces of a settling phase: a flight away from the face and back to it.
struct Bounce {
  GapFlight flight;
  double start = 0.0;  ///< from the phase's start
  double duration = 0.0;
};

/// The bounces of a settling phase, one by one; there is always a next one.
Bounce first_bounce(const ServoDynamics& dynamics, const Phase& phase);
Bounce bounce_after(const ServoDynamics& dynamics, const Bounce& bounce);

/// Phase that starts at the torque-free line with the faces parting cleanly from `face`.
Phase parted_phase(const ServoDynamics& dynamics, FaceSign face, double load_position,
                   double load_speed);

}  // namespace gearlash
