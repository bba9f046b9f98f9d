// Toleranced drives for several tests.
#pragma once

#include "analysis/design/changeable_drive.hpp"
#include "analysis/design/toleranced_drive.hpp"

namespace gearlash {

/// About the servo of the thesis's sample problem, ω_n = 1: damping 0.19, inertia ratio 2, friction
/// ratio 0.1.
inline Datasheet sample_datasheet() {
  return {.motor = TwoPhaseMotor{.inertia = 1.0 / 3.0,
                                 .friction = 0.142,
                                 .torque_per_volt = 1.0,
                                 .torque_per_speed = 0.2},
          .gearbox = {.ratio = 1.0, .backlash = 0.3},
          .load = {.inertia = 2.0 / 3.0, .friction = 0.038},
          .loop = {.error_gain = 1.0},
          .contact = {}};
}

inline TolerancedDrive toleranced(std::vector<VariedNumber> varied) {
  TolerancedDrive drive;
  drive.nominal = sample_datasheet();
  drive.varied = std::move(varied);
  return drive;
}

inline TolerancedDrive normalised_toleranced(std::vector<VariedNumber> varied) {
  TolerancedDrive drive;
  drive.nominal = NormalizedServo{
      .damping = 0.19, .inertia_ratio = 2.0, .friction_ratio = 0.1, .backlash = 0.3};
  drive.varied = std::move(varied);
  return drive;
}

/// All numbers of the sample but restitution and ratio, some uniform, some normal, one in lots.
inline TolerancedDrive widely_toleranced() {
  return toleranced({{DriveNumber::motor_inertia, within_share(1.0 / 3.0, 0.1)},
                     {DriveNumber::motor_friction, Normal{0.142, 0.02, 0.05, {}}},
                     {DriveNumber::motor_torque_per_volt, Normal{1.0, 0.05}},
                     {DriveNumber::motor_torque_per_speed, UniformBetween{0.1, 0.5}},
                     {DriveNumber::gearbox_backlash, UniformBetween{0.0, 0.4}},
                     {DriveNumber::load_inertia, DiscreteLots{{{0.6, 1.0}, {0.7, 2.0}}}},
                     {DriveNumber::load_friction, UniformBetween{0.02, 0.9}},
                     {DriveNumber::loop_error_gain, within_share(1.0, 0.2)}});
}

}  // namespace gearlash
