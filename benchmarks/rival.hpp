// A limit cycle found the way it is found without Gearlash: by integrating from event to event
// until it repeats. The integrators differ (odeint_rival.hpp, cvode_rival.hpp), the rest is shared.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "model/normalized_servo.hpp"

namespace gearlash::benchmarks {

inline constexpr double rival_tolerance = 1e-10;  ///< relative and absolute, of an integrator
inline constexpr double cycle_tolerance = 1e-9;   ///< relative, between successive amplitudes
/// With bounces the integrators restart some forty times a half cycle; their amplitudes then
/// scatter by more than 1e-9 and would never agree.
inline constexpr double bouncing_cycle_tolerance = 1e-7;

/// The coefficients of the equations of motion (see NormalizedServo).
struct Coefficients {
  double motor_inertia;
  double load_inertia;
  double motor_friction;
  double load_friction;
  double backlash;
  double restitution;

  explicit Coefficients(const NormalizedServo& servo)
      : motor_inertia(1.0 / (1.0 + servo.inertia_ratio)),
        load_inertia(servo.inertia_ratio / (1.0 + servo.inertia_ratio)),
        motor_friction(2.0 * servo.damping * (1.0 - servo.friction_ratio)),
        load_friction(2.0 * servo.damping * servo.friction_ratio),
        backlash(servo.backlash),
        restitution(servo.restitution) {}

  double friction() const { return motor_friction + load_friction; }
  double motor_acceleration(double position, double motor_speed) const {
    return -(motor_friction * motor_speed + position) / motor_inertia;
  }
  double load_acceleration(double speed) const { return -load_friction * speed / load_inertia; }
  /// Mesh torque on the load while engaged.
  double torque(double position, double speed) const {
    return (load_friction - load_inertia * friction()) * speed - load_inertia * position;
  }
};

/// Position (from the reference) and speed of both shafts as one.
using EngagedState = std::array<double, 2>;
/// Motor's displacement from the face it left and its speed against the load; load's position (from
/// the reference) and speed. In these coordinates a bounce starts from an exact zero.
using GapState4 = std::array<double, 4>;

/// How far beyond the face just left a contact with it is looked for. After a separation the gap
/// opens as t³ and its sign is at first the integrator's error; after a rebound it is sound.
inline double near_face_margin(const GapState4& start) {
  return start[1] == 0.0 ? 10.0 * rival_tolerance : 0.0;
}

/// What an integrator does: it carries the state on to the end of its mode and returns
///   engaged  the largest |position| at a turning point on the way (0: none),
///   gap      the face met, +1 forward or −1 backward, or 0 when none is met for a long time.
/// `face` is the face in contact, or left, +1 or −1.
template <class Integrator>
concept EventIntegrator =
    requires(Integrator integrator, double time, EngagedState engaged, GapState4 gap, double face) {
      { integrator.follow_engagement(time, engaged, face) } -> std::same_as<double>;
      { integrator.follow_gap(time, gap, face) } -> std::same_as<double>;
    };

struct RivalCycle {
  double amplitude = 0.0;
  double period = 0.0;
  std::size_t half_cycles = 0;  ///< integrated until the amplitude repeated
  bool converged = false;
};

/// One half cycle: from a separation at `face` to the next separation. Bounces are followed one by
/// one until they are 1e-6 of the first, then the faces count as engaged: what is left of them
/// moves the load by a millionth squared of the first. Returns the largest |load position| met;
/// `face` becomes the other face (or the same after a rebound across).
template <EventIntegrator Integrator>
double follow_half_cycle(Integrator& integrator, const Coefficients& servo, double& time,
                         EngagedState& state, double& face) {
  constexpr double settled = 1e-6;
  double largest = std::abs(state[0]);
  double first_speed = 0.0;
  GapState4 gap = {0.0, 0.0, state[0], state[1]};
  while (true) {
    const double met = integrator.follow_gap(time, gap, face);
    if (met == 0.0) return std::nan("");
    largest = std::max(largest, std::abs(gap[2]));
    if (met != face) first_speed = 0.0;
    face = met;
    const double closing = gap[1];
    first_speed = std::max(first_speed, std::abs(closing));
    const double common = gap[3] + servo.motor_inertia * closing;  // of the momentum
    const double rebound = -servo.restitution * closing;
    if (std::abs(rebound) <= settled * first_speed) {
      state = {gap[2], common};
      break;
    }
    gap = {0.0, rebound, gap[2], common - servo.motor_inertia * rebound};
  }
  if (face * servo.torque(state[0], state[1]) < 0.0) return largest;
  return std::max(largest, integrator.follow_engagement(time, state, face));
}

/// From an engaged start on `face` (already separating when `parted`) until two successive half
/// cycles have the same amplitude.
template <EventIntegrator Integrator>
RivalCycle find_cycle(Integrator& integrator, const NormalizedServo& servo, EngagedState start,
                      double face, bool parted) {
  constexpr std::size_t most_half_cycles = 400;
  const Coefficients coefficients(servo);
  const double tolerance = servo.restitution > 0.0 ? bouncing_cycle_tolerance : cycle_tolerance;
  RivalCycle cycle;
  double time = 0.0;
  EngagedState state = start;
  if (!parted) integrator.follow_engagement(time, state, face);
  while (cycle.half_cycles < most_half_cycles && !cycle.converged) {
    const double begin = time;
    const double amplitude = follow_half_cycle(integrator, coefficients, time, state, face);
    if (!(amplitude > 0.0)) break;
    cycle.converged = std::abs(amplitude - cycle.amplitude) <= tolerance * amplitude;
    cycle.amplitude = amplitude;
    cycle.period = 2.0 * (time - begin);
    ++cycle.half_cycles;
  }
  return cycle;
}

}  // namespace gearlash::benchmarks
