#include "closed_form/cycle_of_orbit.hpp"

#include <algorithm>
#include <cmath>

#include "closed_form/extremes.hpp"
#include "numeric/linear_algebra.hpp"

namespace gearlash {
namespace {

/// A full period is twice an odd number of mirrored traversals, or an even number of them.
int traversals_per_period(int order) { return order % 2 == 0 ? order : 2 * order; }

CycleKind kind_of(int order) {
  if (order == 1) return CycleKind::symmetric;
  return order == 2 ? CycleKind::asymmetric : CycleKind::subharmonic;
}

}  // namespace

LimitCycle cycle_of_orbit(const NormalizedServo& servo, const ServoDynamics& dynamics,
                          const ReturnOrbit& orbit) {
  const int repeats = traversals_per_period(orbit.order) / orbit.order;
  const Eigen::Vector3cd values = eigenvalues(orbit.map.slope);
  Eigen::Index largest = 0;
  values.cwiseAbs().maxCoeff(&largest);
  // Complex pairs have no sign: their modulus is given.
  const double multiplier =
      values(largest).imag() == 0.0 ? values(largest).real() : std::abs(values(largest));
  const GapState start = after_arrival(dynamics, orbit.arrival);

  LimitCycle cycle;
  cycle.kind = kind_of(orbit.order);
  cycle.multiplier = repeats == 2 ? multiplier * multiplier : multiplier;
  cycle.stable = std::abs(multiplier) < 1.0;
  cycle.period = repeats * orbit.map.duration;
  cycle.engaged_time = repeats * orbit.map.engaged_time;
  cycle.separated_time = cycle.period - cycle.engaged_time;
  cycle.impact_speed = orbit.map.hardest_impact;
  cycle.residual = orbit.residual;
  cycle.traversals = orbit.order;
  cycle.impacts_per_period = static_cast<std::size_t>(repeats) * orbit.map.impacts;
  cycle.settles = orbit.map.settled;
  cycle.start = {start.load_position + start.gap, start.load_speed + start.gap_speed,
                 start.load_position, start.load_speed};

  const Trajectory period = simulate(servo, cycle.start, {.until = cycle.period, .reference = 0.0});
  const Extremes range = extremes(period, 0.0, cycle.period);
  cycle.amplitude = range.load_amplitude();
  cycle.motor_amplitude = range.motor_amplitude();
  cycle.mesh_torque = 0.0;
  for (const Segment& segment : period.segments()) {
    const Phase& phase = segment.phase;
    if (phase.mode == Mode::separated || phase.mode == Mode::settling) continue;
    cycle.mesh_torque = std::max(
        cycle.mesh_torque, largest_mesh_torque(dynamics, phase.engaged.position,
                                               phase.engaged.speed, segment.end - segment.start));
  }
  const EnergyAccount books = period.energy_at(cycle.period);
  // The arrival that closes the period may fall just before or just after its end. So its impact is
  // not taken from the events but computed once, from the arrival itself.
  const double first_impact = impact(dynamics, orbit.arrival(1), orbit.arrival(2)).energy_lost;
  cycle.energy = {books.motor_friction, books.load_friction, first_impact};
  for (const Event& event : period.events()) {
    const bool closing = event.time > cycle.period * (1.0 - 1e-9);
    if (!closing) cycle.energy.impacts += event.energy_lost;
  }
  return cycle;
}

std::optional<LimitCycle> bouncing_cycle_beside(const NormalizedServo& servo,
                                                const LimitCycle& near,
                                                const NormalizedServo& servo_near) {
  const ServoDynamics dynamics = servo_dynamics(servo);
  const ServoDynamics dynamics_near = servo_dynamics(servo_near);
  if (dynamics.plastic_contact() || dynamics_near.plastic_contact()) return std::nullopt;
  const ServoState& start = near.start;
  const double gap_speed = start.motor_speed - start.load_speed;
  const Arrival arrival(start.load_position,
                        start.load_speed + dynamics_near.motor_inertia * gap_speed,
                        -gap_speed / dynamics_near.restitution);
  TraversalBudget budget{dynamics};
  KnownOrbits known(budget);
  if (!known.try_from(arrival, near.traversals)) return std::nullopt;
  const LimitCycle cycle = cycle_of_orbit(servo, dynamics, known.list().front().orbit);
  // Of bounces that settle any number may be counted one by one.
  const bool is_alike = cycle.traversals == near.traversals && cycle.settles == near.settles &&
                        (cycle.settles || cycle.impacts_per_period == near.impacts_per_period);
  return is_alike ? std::optional(cycle) : std::nullopt;
}

}  // namespace gearlash
