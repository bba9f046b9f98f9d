// The servo's motion, exact between events: what happened, when, and all positions.
#pragma once

#include <cstddef>
#include <vector>

#include "closed_form/phase.hpp"
#include "closed_form/servo_dynamics.hpp"
#include "model/normalized_servo.hpp"

namespace gearlash {

/// Positions (rad) and speeds (rad per unit of normalised time, 1/ω_n) of both shafts at the load.
/// motor_position − load_position is the gap coordinate u ∈ [−b/2, +b/2], known to the rounding of
/// the two positions. Its rate u̇ is known separately.
struct ServoState {
  double motor_position = 0.0;
  double motor_speed = 0.0;
  double load_position = 0.0;
  double load_speed = 0.0;
  /// The rounding error of motor_speed, a sum v_L + u̇: up to half a unit of its last place, which
  /// may be large compared with u̇. States of a trajectory have it; 0 if the two speeds are given.
  double motor_speed_remainder = 0.0;

  /// u̇, with all its digits.
  double gap_speed() const { return (motor_speed - load_speed) + motor_speed_remainder; }
  /// Sets the motor's speed to load_speed + gap_speed, so that gap_speed() is the one given.
  void set_gap_speed(double gap_speed) {
    motor_speed = load_speed + gap_speed;
    motor_speed_remainder = gap_speed - (motor_speed - load_speed);
  }

  bool operator==(const ServoState&) const = default;
};

struct Event {
  double time = 0.0;  ///< normalised, from the start of the simulation
  EventKind kind = EventKind::separation;
  Face face = Face::forward;
  ServoState before;
  ServoState after;
  Mode mode_after = Mode::separated;
  double energy_lost = 0.0;  ///< at an impact or a settling, in units of K rad²
};

/// The gap turned so near a face that rounding decides whether the faces meet there. events() has
/// one of the two answers (first_contact.hpp gives the band and its consequences).
struct Touch {
  double time = 0.0;
  Face face = Face::forward;
};

enum class StopReason {
  reached_end,  ///< the requested time
  event_limit   ///< options.event_limit events were recorded; end_time() has the time reached
};

/// Energies in units of K rad² (multiply by the stiffness K for joules), accumulated from the
/// start. Balance: stored(start) + supplied = stored + motor_friction + load_friction + impacts.
struct EnergyAccount {
  double kinetic = 0.0;         ///< ½ J_M v_M² + ½ J_L v_L²
  double elastic = 0.0;         ///< ½ (θ_L − θ_ref)², the loop's virtual spring
  double motor_friction = 0.0;  ///< ∫ F_M v_M² dt, includes the back-EMF's share
  double load_friction = 0.0;   ///< ∫ F_L v_L² dt
  double impacts = 0.0;         ///< Σ energy_lost
  double supplied = 0.0;  ///< −∫ (θ_L − θ_ref)(v_M − v_L) dt: what the loop feeds in, in the gap

  double stored() const { return kinetic + elastic; }
};

/// The longest normalised time.
inline constexpr double longest_simulation = 1e9;

struct SimulationOptions {
  double until = 0.0;      ///< normalised time to stop at, 0 … longest_simulation
  double reference = 1.0;  ///< position reference applied at time 0, rad
  std::size_t event_limit = 1'000'000;
};

/// A segment of motion between two events: `phase` holds its closed form, in time from `start`.
struct Segment {
  double start = 0.0;
  double end = 0.0;
  Phase phase;
};

struct Extremes;

class Trajectory {
 public:
  double start_time() const { return 0.0; }
  double end_time() const;
  StopReason stop_reason() const { return stop_reason_; }
  const std::vector<Event>& events() const { return events_; }
  const std::vector<Touch>& touches() const { return touches_; }
  const std::vector<Segment>& segments() const { return segments_; }

  /// State at any time within [start_time, end_time] (clamped to it). At an event: the state after
  /// it.
  ServoState at(double time) const;
  Mode mode_at(double time) const;

  /// The energy balance from the start to `time`. Every entry is computed from its own definition,
  /// so the balance is a check, not an identity.
  EnergyAccount energy_at(double time) const;

 private:
  const Segment& segment_at(double time) const;
  friend Trajectory simulate(const NormalizedServo&, const ServoState&, const SimulationOptions&);
  friend Extremes extremes(const Trajectory&, double, double);
  ServoDynamics dynamics_;
  double reference_ = 0.0;
  StopReason stop_reason_ = StopReason::reached_end;
  std::vector<Segment> segments_;
  std::vector<Event> events_;
  std::vector<Touch> touches_;
};

/// Both shafts at the given load position and speed, on the face towards which the motor pushes
/// for that reference (forward when reference ≥ position): the thesis's start.
ServoState engaged_start(const NormalizedServo& servo, double load_position, double load_speed,
                         double reference);

/// The exact motion from `initial` under a step reference. There is no step size: every mode has a
/// closed form. In exact arithmetic every event time is a first crossing and none is missed
/// (first_contact.hpp, engaged_flow.hpp). touches() lists where rounding decides. Permitted:
/// positions, speeds and reference from −1e100 to 1e100, the gap from −b/2 to b/2 (to rounding),
/// options.until from 0 to longest_simulation. Throws InvalidInput that lists every fault, those of
/// the servo included.
Trajectory simulate(const NormalizedServo& servo, const ServoState& initial,
                    const SimulationOptions& options);

}  // namespace gearlash
