#include "gearlash/cycle/return_map.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "gearlash/motion/decay_integral.hpp"

namespace gearlash {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// State and disturbances in the gap, (y, v, u, u̇).
using GapVector = Eigen::Vector4d;
using Disturbance = Eigen::Matrix<double, 4, 3>;  // for each entry of the arrival

/// ẋ in the gap.
GapVector motion_rate(const ServoDynamics& dynamics, const GapState& state) {
  const double motor_speed = state.load_speed + state.gap_speed;
  const double load_acceleration = -dynamics.load_rate * state.load_speed;
  const double motor_acceleration =
      -dynamics.motor_rate * motor_speed - state.load_position / dynamics.motor_inertia;
  return {state.load_speed, load_acceleration, state.gap_speed,
          motor_acceleration - load_acceleration};
}

Arrival mirrored_arrival(const ServoDynamics& dynamics, const GapState& state, double face) {
  return face * Arrival{state.load_position,
                        state.load_speed + dynamics.motor_inertia * state.gap_speed,
                        state.gap_speed};
}

/// ∂(y, v, u, u̇)/∂(y, P, u̇) just before the arrival's impact.
Disturbance arrival_disturbance(const ServoDynamics& dynamics) {
  Disturbance disturbance = Disturbance::Zero();
  disturbance(0, 0) = 1.0;
  disturbance(1, 1) = 1.0;
  disturbance(1, 2) = -dynamics.motor_inertia;
  disturbance(3, 2) = 1.0;
  return disturbance;
}

/// Moves each disturbance from fixed time onto the impact surface u = const, or, with the impact
/// law and the flow after it, through the impact back to fixed time.
struct ImpactSlope {
  Eigen::Matrix4d onto_surface = Eigen::Matrix4d::Identity();
  Eigen::Matrix4d through = Eigen::Matrix4d::Identity();
};

ImpactSlope impact_slope(const ServoDynamics& dynamics, const GapState& before,
                         const GapState& after) {
  const GapVector rate_before = motion_rate(dynamics, before);
  const GapVector rate_after = motion_rate(dynamics, after);
  Eigen::Matrix4d law = Eigen::Matrix4d::Identity();
  law(1, 3) = dynamics.motor_inertia * (1.0 + dynamics.restitution);
  law(3, 3) = -dynamics.restitution;
  const Eigen::RowVector4d time_shift(0.0, 0.0, -1.0 / before.gap_speed, 0.0);
  ImpactSlope slope;
  slope.onto_surface = Eigen::Matrix4d::Identity() + rate_before * time_shift;
  slope.through = law * slope.onto_surface - rate_after * time_shift;
  return slope;
}

/// Every flow is linear, so it carries a disturbance as it carries a state. The closed form of
/// gap_flight.hpp, for all columns at once.
Disturbance carried_through_flight(const ServoDynamics& dynamics, double time,
                                   const Disturbance& start) {
  const Decay load = decay(dynamics.load_rate * time);
  const Decay motor = decay(dynamics.motor_rate * time);
  const Convolution coupled = convolution(load, motor);
  const Eigen::RowVector3d motor_acceleration =
      -dynamics.motor_rate * (start.row(1) + start.row(3)) - start.row(0) / dynamics.motor_inertia;
  const Eigen::RowVector3d load_deceleration = dynamics.load_rate * start.row(1);
  const Eigen::RowVector3d coupling = -start.row(1) / dynamics.motor_inertia;
  Disturbance end;
  end.row(0) = start.row(0) + start.row(1) * (time * load.integral);
  end.row(1) = start.row(1) * load.factor;
  end.row(2) =
      start.row(2) + time * (start.row(3) + time * (motor_acceleration * motor.double_integral +
                                                    load_deceleration * load.double_integral +
                                                    coupling * (time * coupled.double_integral)));
  end.row(3) = start.row(3) +
               time * (motor_acceleration * motor.integral + load_deceleration * load.integral +
                       coupling * (time * coupled.integral));
  return end;
}

/// Engaged or settling: centre of mass and common momentum move as the engaged flow.
Disturbance carried_together(const ServoDynamics& dynamics, double time, const Disturbance& start) {
  Disturbance end = Disturbance::Zero();
  for (Eigen::Index column = 0; column < start.cols(); ++column) {
    const EngagedFlow flow{dynamics.damping,
                           start(0, column) + dynamics.motor_inertia * start(2, column),
                           start(1, column) + dynamics.motor_inertia * start(3, column)};
    const EngagedFlow::State state = flow.at(time);
    end(0, column) = state.position;
    end(1, column) = state.speed;
  }
  return end;
}

/// The three rows (y, P, u̇) of a disturbance on the impact surface, mirrored.
Eigen::Matrix3d arrival_rows(const ServoDynamics& dynamics, const Disturbance& disturbance,
                             double face) {
  Eigen::Matrix3d rows;
  rows.row(0) = disturbance.row(0);
  rows.row(1) = disturbance.row(1) + dynamics.motor_inertia * disturbance.row(3);
  rows.row(2) = disturbance.row(3);
  return face * rows;
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
  Disturbance disturbance = arrival_disturbance(dynamics);
  if (with_slope) {
    disturbance = impact_slope(dynamics, before, start.impact.after).through * disturbance;
  }
  traversal.impacts = 1;
  traversal.hardest_impact = std::abs(arrival(2));
  Phase phase = start.phase;
  while (traversal.events < event_limit) {
    ++traversal.events;
    const PhaseEnd end = end_of_phase(dynamics, phase, infinity);
    if (!end.has_event) return traversal;  // came_to_rest
    if (with_slope) {
      disturbance = phase.mode == Mode::separated
                        ? carried_through_flight(dynamics, end.duration, disturbance)
                        : carried_together(dynamics, end.duration, disturbance);
    }
    book(traversal, phase, end);
    if (end.kind == EventKind::separation) {
      const TorqueFreeLine line = dynamics.torque_free_line;
      traversal.settled = true;
      traversal.parting_amplitude =
          end.after.load_position * line.position + end.after.load_speed * line.speed;
    }
    if (end.kind == EventKind::impact) {
      const ImpactSlope slope =
          with_slope ? impact_slope(dynamics, end.before, end.after) : ImpactSlope{};
      if (end.face == Face::backward) {
        traversal.outcome = Traversal::Outcome::arrived;
        traversal.next = mirrored_arrival(dynamics, end.before, -1.0);
        traversal.slope = arrival_rows(dynamics, slope.onto_surface * disturbance, -1.0);
        return traversal;
      }
      disturbance = slope.through * disturbance;
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
