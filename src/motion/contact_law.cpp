#include "gearlash/motion/contact_law.hpp"

#include <algorithm>
#include <cmath>

namespace gearlash {

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

SettlingBounces settling_bounces(const ServoDynamics& dynamics, FaceSign face, double load_position,
                                 double load_speed, double gap_speed) {
  constexpr double longest = 1e-5;
  const double reduced_inertia = dynamics.motor_inertia * dynamics.load_inertia;
  const double speed = load_speed + dynamics.motor_inertia * gap_speed;  // of the common momentum
  const double pressing = face * mesh_torque(dynamics, load_position, speed) / reduced_inertia;
  if (!(pressing > 0.0)) return {false, 0.0, 0.0};
  const double pressing_rate =
      face * mesh_torque_rate(dynamics, load_position, speed) / reduced_inertia;
  const double drag =
      dynamics.motor_rate * dynamics.load_inertia + dynamics.load_rate * dynamics.motor_inertia;
  const double relative_rate = pressing_rate / pressing;
  const double first_order = 2.0 * std::abs(gap_speed) / (pressing * (1.0 - dynamics.restitution));
  const double fastest = std::max({1.0, drag, std::abs(relative_rate)});
  return {.imminent = first_order * fastest < longest,
          .duration = first_order * (1.0 - first_order * (drag + 2.0 * relative_rate) / 6.0),
          .energy_lost = 0.5 * reduced_inertia * gap_speed * gap_speed};
}

}  // namespace gearlash
