#include "closed_form/contact_law.hpp"

#include <algorithm>
#include <cmath>

#include "closed_form/engaged_flow.hpp"

namespace gearlash {
namespace {

/// κ = c J_L + D J_M, the rate at which friction slows the gap's motion.
double drag_on_gap(const ServoDynamics& dynamics) {
  return dynamics.motor_rate * dynamics.load_inertia + dynamics.load_rate * dynamics.motor_inertia;
}

double size_of(const EngagedFlow::State& state) {
  return std::abs(state.position) + std::abs(state.speed);
}

/// Whether nearly elastic bounces of speed `rebound` under the acceleration `pressing` are too many
/// to be followed and small enough to be summed up; see fading_rattle().
bool matters_no_more(const ServoDynamics& dynamics, const EngagedFlow& common, double pressing,
                     double rebound) {
  constexpr double many = 1e4;
  constexpr double height_allowed = 1e-8;
  constexpr double offset_allowed = 1e-9;
  constexpr double parting_speed_allowed = 1e-6;
  const double bounce_duration = 2.0 * rebound / pressing;
  const double height = 0.25 * rebound * bounce_duration;
  const double size = size_of({common.position, common.speed});
  if (height > height_allowed * std::min(1e4 * dynamics.backlash, dynamics.backlash + size)) {
    return false;
  }

  const double drag = drag_on_gap(dynamics);
  const double offset = 2.0 / 3.0 * height *
                        (dynamics.motor_inertia + std::abs(dynamics.torque_per_speed)) *
                        std::min(1.0, 1.5 / drag);
  const double engaged_time =
      first_zero(dynamics.damping, mesh_torque(dynamics, common.position, common.speed),
                 mesh_torque_rate(dynamics, common.position, common.speed));
  if (std::isinf(engaged_time)) return offset < offset_allowed * dynamics.backlash;

  if (height > height_allowed * size) return false;
  const double slowed = drag * engaged_time / 3.0;
  const double bounces_left =
      engaged_time / bounce_duration * (slowed > 0.0 ? std::expm1(slowed) / slowed : 1.0);
  if (!(bounces_left > many)) return false;
  const EngagedFlow::State parting = common.at(engaged_time);
  const double parting_size = std::min(dynamics.backlash, size_of(parting));
  // The engaged flow carries the offset as it carries the motion itself.
  if (!(offset * size_of(parting) < offset_allowed * parting_size * size)) return false;
  const double parting_rate = mesh_torque_rate(dynamics, parting.position, parting.speed) /
                              (dynamics.motor_inertia * dynamics.load_inertia);
  const double action = 2.0 / 3.0 * std::pow(rebound, 3) / pressing * std::exp(-3.0 * slowed);
  const double parting_speed = std::pow(action, 0.4) * std::pow(std::abs(parting_rate), 0.2);
  return parting_speed < parting_speed_allowed * std::min(bounces_left / many, 1e3) * parting_size;
}

}  // namespace

ImpactOutcome impact(const ServoDynamics& dynamics, double load_speed, double gap_speed) {
  const double restitution = dynamics.plastic_contact() ? 0.0 : dynamics.restitution;
  const double rebound = restitution == 0.0 ? 0.0 : -restitution * gap_speed;
  const double reduced_inertia = dynamics.motor_inertia * dynamics.load_inertia;
  return {.load_speed = load_speed + dynamics.motor_inertia * (gap_speed - rebound),
          .gap_speed = rebound,
          .energy_lost = 0.5 * reduced_inertia * (1.0 - restitution) * (1.0 + restitution) *
                         gap_speed * gap_speed};
}

bool stays_engaged(const ServoDynamics& dynamics, FaceSign face, double load_position,
                   double load_speed) {
  const double torque = face * mesh_torque(dynamics, load_position, load_speed);
  if (torque != 0.0) return torque > 0.0;
  return face * mesh_torque_rate(dynamics, load_position, load_speed) >= 0.0;
}

double largest_mesh_torque(const ServoDynamics& dynamics, double load_position, double load_speed,
                           double duration) {
  const EngagedFlow torque{dynamics.damping, mesh_torque(dynamics, load_position, load_speed),
                           mesh_torque_rate(dynamics, load_position, load_speed)};
  const double turn = first_zero(torque.damping, torque.speed,
                                 -2.0 * torque.damping * torque.speed - torque.position);
  return std::max(std::abs(torque.position),
                  std::abs(torque.at(std::min(turn, duration)).position));
}

SettlingBounces settling_bounces(const ServoDynamics& dynamics, FaceSign face, double load_position,
                                 double load_speed, double gap_speed) {
  constexpr double longest = 1e-5;
  const double reduced_inertia = dynamics.motor_inertia * dynamics.load_inertia;
  const double speed = load_speed + dynamics.motor_inertia * gap_speed;  // of the common momentum
  const double pressing = face * mesh_torque(dynamics, load_position, speed) / reduced_inertia;
  if (!(pressing > 0.0) || dynamics.restitution >= 1.0) return {};
  const double pressing_rate =
      face * mesh_torque_rate(dynamics, load_position, speed) / reduced_inertia;
  const double drag = drag_on_gap(dynamics);
  const double relative_rate = pressing_rate / pressing;
  const double first_order = 2.0 * std::abs(gap_speed) / (pressing * (1.0 - dynamics.restitution));
  const double fastest = std::max({1.0, drag, std::abs(relative_rate)});
  return {.imminent = first_order * fastest < longest,
          .duration = first_order * (1.0 - first_order * (drag + 2.0 * relative_rate) / 6.0),
          .energy_lost = 0.5 * reduced_inertia * gap_speed * gap_speed};
}

SettlingBounces fading_rattle(const ServoDynamics& dynamics, FaceSign face, double load_position,
                              double load_speed, double gap_speed) {
  constexpr double nearly_elastic = 1e-3;
  if (1.0 - dynamics.restitution > nearly_elastic) return {};
  const double reduced_inertia = dynamics.motor_inertia * dynamics.load_inertia;
  const double speed = load_speed + dynamics.motor_inertia * gap_speed;
  const double pressing = face * mesh_torque(dynamics, load_position, speed) / reduced_inertia;
  const double rebound = std::abs(gap_speed);
  if (!(pressing > 0.0)) return {};
  if (!matters_no_more(dynamics, {dynamics.damping, load_position, speed}, pressing, rebound)) {
    return {};
  }
  const double energy = 0.5 * reduced_inertia * rebound * rebound;
  const double drag = drag_on_gap(dynamics);
  // ṗ = −(1−e)a/2 − κp/3: friction's share of the loss of p² on the way to 0, where `ratio` is that
  // of the two terms now.
  const double by_impacts = 1.5 * (1.0 - dynamics.restitution) * pressing;
  const double ratio = drag * rebound / by_impacts;
  const double friction_share = by_impacts == 0.0 ? 1.0
                                : ratio < 1e-3
                                    ? 2.0 / 3.0 * ratio
                                    : 1.0 - 2.0 / ratio * (1.0 - std::log1p(ratio) / ratio);
  const double rubbed = energy * friction_share;
  const double motor_share = dynamics.motor_rate * dynamics.load_inertia / drag;
  return {.imminent = true,
          .duration = 0.0,
          .energy_lost = energy - rubbed,
          .motor_friction_lost = rubbed * motor_share,
          .load_friction_lost = rubbed * (1.0 - motor_share)};
}

}  // namespace gearlash
