#include "closed_form/return_map.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

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

/// Follows the motion from a phase to the arrival at the backward face. `after`: the state in which
/// the faces last met.
void follow(const ServoDynamics& dynamics, Phase phase, GapState after,
            std::optional<Disturbances>& disturbances, std::size_t event_limit,
            Traversal& traversal) {
  while (traversal.events < event_limit) {
    ++traversal.events;
    const PhaseEnd end = end_of_phase(dynamics, phase, infinity);
    if (!end.has_event) return;  // came_to_rest
    if (disturbances && phase.mode == Mode::separated) {
      disturbances->fly(end.duration, decays_at(phase.flight, end.duration));
    }
    book(traversal, phase, end);
    if (end.kind == EventKind::separation) {
      const TorqueFreeLine line = dynamics.torque_free_line;
      traversal.settled = true;
      traversal.parting_amplitude =
          end.after.load_position * line.position + end.after.load_speed * line.speed;
      if (disturbances) disturbances->part(after, end.after);
    }
    if (end.kind == EventKind::impact) {
      if (end.face == Face::backward) {
        traversal.outcome = Traversal::Outcome::arrived;
        traversal.next = mirrored_arrival(dynamics, end.before, -1.0);
        if (disturbances) traversal.slope = disturbances->arrive(end.before);
        return;
      }
      after = end.after;
      if (disturbances) disturbances->meet(end.before, after);
      ++traversal.impacts;
      traversal.hardest_impact = std::max(traversal.hardest_impact, std::abs(end.before.gap_speed));
    }
    phase = end.next;
  }
  traversal.outcome = Traversal::Outcome::event_limit;
}

}  // namespace

GapState after_arrival(const ServoDynamics& dynamics, const Arrival& arrival) {
  return begin_phase(dynamics, before_arrival(dynamics, arrival)).impact.after;
}

Traversal traverse(const ServoDynamics& dynamics, const Arrival& arrival, Derivative derivative,
                   std::size_t event_limit) {
  const GapState before = before_arrival(dynamics, arrival);
  const PhaseStart start = begin_phase(dynamics, before);
  std::optional<Disturbances> disturbances;
  if (derivative == Derivative::wanted) {
    disturbances.emplace(dynamics);
    disturbances->meet(before, start.impact.after);
  }
  Traversal traversal{.hardest_impact = std::abs(arrival(2)), .impacts = 1};
  follow(dynamics, start.phase, start.impact.after, disturbances, event_limit, traversal);
  return traversal;
}

Traversal first_arrival(const ServoDynamics& dynamics, double amplitude) {
  const TorqueFreeLine line = dynamics.torque_free_line;
  Phase phase = parted_phase(dynamics, 1.0, amplitude * line.position, amplitude * line.speed);
  if (phase.flight.gap_drive > 0.0) {
    phase = parted_phase(dynamics, 1.0, -amplitude * line.position, -amplitude * line.speed);
  }
  std::optional<Disturbances> none;
  Traversal traversal;
  follow(dynamics, phase, {}, none, traversal_event_limit, traversal);
  return traversal;
}

}  // namespace gearlash
