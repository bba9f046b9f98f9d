// Toleranced drives for several tests.
#pragma once

#include <utility>
#include <vector>

#include "model/proportional_servo.hpp"
#include "question/change/drives.hpp"
#include "question/series/toleranced_drive.hpp"

namespace gearlash {

/// About the servo of the thesis's sample problem, ω_n = 1: damping 0.19, inertia ratio 2, friction
/// ratio 0.1.
inline Drive sample_data_sheet() {
  return drive_of(TwoPhase{.torque_per_volt = 1.0, .torque_per_speed = 0.2},
                  {.motor_inertia = 1.0 / 3.0,
                   .motor_friction = 0.142,
                   .backlash = 0.3,
                   .load_inertia = 2.0 / 3.0,
                   .load_friction = 0.038});
}

inline TolerancedDrive toleranced(std::vector<ParameterTolerance> varied) {
  return {sample_data_sheet(), std::move(varied)};
}

inline TolerancedDrive normalised_toleranced(std::vector<ParameterTolerance> varied) {
  return {normal_form(0.19, 2.0, 0.1, 0.3), std::move(varied)};
}

/// The servo of the drive with these values of its varied parameters.
inline ProportionalServo drive_with(const TolerancedDrive& drive,
                                    const std::vector<double>& values) {
  return proportional_servo(family_of(drive).drive_at(values)).value();
}

/// All numbers of the sample but restitution and ratio, some uniform, some normal, one in lots.
inline TolerancedDrive widely_toleranced() {
  return toleranced({{"motor.inertia", within_share(1.0 / 3.0, 0.1)},
                     {"motor.friction", Normal{0.142, 0.02, 0.05, {}}},
                     {"motor.torque_per_volt", Normal{1.0, 0.05}},
                     {"motor.torque_per_speed", UniformBetween{0.1, 0.5}},
                     {"gearbox.backlash", UniformBetween{0.0, 0.4}},
                     {"load.inertia", DiscreteLots{{{0.6, 1.0}, {0.7, 2.0}}}},
                     {"load.friction", UniformBetween{0.02, 0.9}},
                     {"controller.proportional", within_share(1.0, 0.2)}});
}

}  // namespace gearlash
