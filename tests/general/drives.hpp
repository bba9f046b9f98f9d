// Drives, and ways to move them, for several tests.
#pragma once

#include <array>
#include <cstddef>

#include "controllers.hpp"
#include "general/assemble/drive_system.hpp"

namespace gearlash::drive {

/// The servo of 1960: ω_n = 1, total inertia 1, a gap of 0.3, the sensor on the load.
inline ReducedDrive servo_drive(double damping, double inertia_ratio, double friction_ratio,
                                double restitution = 0.0) {
  ReducedDrive drive;
  drive.motor = {1.0 / (1.0 + inertia_ratio), {.viscous = 2.0 * damping * (1.0 - friction_ratio)}};
  drive.load = {inertia_ratio / (1.0 + inertia_ratio), {.viscous = 2.0 * damping * friction_ratio}};
  drive.backlash = 0.3;
  drive.contact = RigidContact{restitution};
  drive.controller = at_load(PID{.proportional = 1.0});
  return drive;
}

/// A motor by itself, far from both faces.
inline ReducedDrive lone_motor(const Shaft& motor) {
  ReducedDrive drive;
  drive.motor = motor;
  drive.load.inertia = 1.0;
  drive.backlash = 1e6;
  drive.sensing.load_share_of_position = 0.0;
  return drive;
}

inline hybrid::Trajectory moved(const ReducedDrive& drive, const ShaftStates& start, double until) {
  const DriveSystem built = drive_system(drive);
  return simulate(built.system, drive_start(drive, built, start), {.until = until});
}

/// Runge and Kutta's method of order 4.
template <std::size_t count, class Slope>
std::array<double, count> integrated(std::array<double, count> now, double until, int steps,
                                     const Slope& slope) {
  const double step = until / steps;
  const auto along = [&](const std::array<double, count>& direction, double share) {
    std::array<double, count> there = now;
    for (std::size_t i = 0; i < count; ++i) there[i] += share * step * direction[i];
    return there;
  };
  for (int i = 0; i < steps; ++i) {
    const std::array<double, count> a = slope(now);
    const std::array<double, count> b = slope(along(a, 0.5));
    const std::array<double, count> c = slope(along(b, 0.5));
    const std::array<double, count> d = slope(along(c, 1.0));
    for (std::size_t k = 0; k < count; ++k) {
      now[k] += step / 6.0 * (a[k] + 2.0 * b[k] + 2.0 * c[k] + d[k]);
    }
  }
  return now;
}

}  // namespace gearlash::drive
