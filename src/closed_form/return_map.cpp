#include "closed_form/return_map.hpp"

#include <algorithm>
#include <cmath>

#include "base/special_numbers.hpp"
#include "closed_form/disturbances.hpp"

namespace gearlash {
namespace {

Arrival mirrored_arrival(const ServoDynamics& dynamics, const GapState& state, double face) {
  return face * Arrival{state.load_position,
                        state.load_speed + dynamics.motor_inertia * state.gap_speed,
                        state.gap_speed};
}

void book(Traversal& traversal, const Phase& phase, const PhaseEnd& end) {
  traversal.duration += end.duration;
  if (phase.mode != Mode::separated) traversal.engaged_time += end.duration;
}

GapState before_arrival(const ServoDynamics& dynamics, const Arrival& arrival) {
  return {arrival(0), arrival(1) - dynamics.motor_inertia * arrival(2), 0.5 * dynamics.backlash,
          arrival(2)};
}

}  // namespace

GapState after_arrival(const ServoDynamics& dynamics, const Arrival& arrival) {
  return begin_phase(dynamics, before_arrival(dynamics, arrival)).impact.after;
}

Traversal traverse(const ServoDynamics& dynamics, const Arrival& arrival, Derivative derivative,
                   std::size_t event_limit) {
  const bool with_slope = derivative == Derivative::wanted;
  Traversal traversal;
  const GapState before = before_arrival(dynamics, arrival);
  const PhaseStart start = begin_phase(dynamics, before);
  GapState after = start.impact.after;
  Disturbances disturbances(dynamics);
  if (with_slope) disturbances.meet(before, after);
  traversal.impacts = 1;
  traversal.hardest_impact = std::abs(arrival(2));
  Phase phase = start.phase;
  while (traversal.events < event_limit) {
    ++traversal.events;
    const PhaseEnd end = end_of_phase(dynamics, phase, infinity);
    if (!end.has_event) return traversal;  // came_to_rest
    if (with_slope && phase.mode == Mode::separated) {
      disturbances.fly(end.duration, decays_at(phase.flight, end.duration));
    }
    book(traversal, phase, end);
    if (end.kind == EventKind::separation) {
      const TorqueFreeLine line = dynamics.torque_free_line;
      traversal.settled = true;
      traversal.parting_amplitude =
          end.after.load_position * line.position + end.after.load_speed * line.speed;
      if (with_slope) disturbances.part(after, end.after);
    }
    if (end.kind == EventKind::impact) {
      if (end.face == Face::backward) {
        traversal.outcome = Traversal::Outcome::arrived;
        traversal.next = mirrored_arrival(dynamics, end.before, -1.0);
        if (with_slope) traversal.slope = disturbances.arrive(end.before);
        return traversal;
      }
      after = end.after;
      if (with_slope) disturbances.meet(end.before, after);
      ++traversal.impacts;
      traversal.hardest_impact = std::max(traversal.hardest_impact, std::abs(end.before.gap_speed));
    }
    phase = end.next;
  }
  traversal.outcome = Traversal::Outcome::event_limit;
  return traversal;
}

Traversal first_arrival(const ServoDynamics& dynamics, double amplitude) {
  const TorqueFreeLine line = dynamics.torque_free_line;
  Traversal traversal;
  Phase phase = parted_phase(dynamics, 1.0, amplitude * line.position, amplitude * line.speed);
  if (phase.flight.gap_drive > 0.0) {
    phase = parted_phase(dynamics, 1.0, -amplitude * line.position, -amplitude * line.speed);
  }
  while (traversal.events < traversal_event_limit) {
    ++traversal.events;
    const PhaseEnd end = end_of_phase(dynamics, phase, infinity);
    if (!end.has_event) return traversal;
    if (end.kind == EventKind::impact && end.face == Face::backward) {
      traversal.outcome = Traversal::Outcome::arrived;
      traversal.next = mirrored_arrival(dynamics, end.before, -1.0);
      return traversal;
    }
    phase = end.next;
  }
  traversal.outcome = Traversal::Outcome::event_limit;
  return traversal;
}

}  // namespace gearlash
