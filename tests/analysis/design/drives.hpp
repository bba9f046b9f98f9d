// Drives with a closed form for several tests.
#pragma once

#include <array>
#include <string_view>

#include "analysis/design/changeable_drive.hpp"
#include "model/reduced_drive.hpp"

namespace gearlash {

/// What a design looks at, by the names of 0.1, which every drive understands.
inline constexpr std::array<std::string_view, 9> all_parameters = {
    "backlash",   "gear_ratio",   "error_gain",    "load_friction", "motor_friction",
    "tachometer", "load_inertia", "motor_inertia", "restitution"};

inline Drive drive_of(const NormalizedServo& servo, double natural_frequency = 1.0) {
  Drive drive = normal_form(servo.damping, servo.inertia_ratio, servo.friction_ratio,
                            servo.backlash, servo.restitution);
  if (natural_frequency != 1.0) drive.servo->natural_frequency = natural_frequency;
  return drive;
}

inline ChangeableDrive changeable(const NormalizedServo& servo, double natural_frequency = 1.0) {
  return ChangeableDrive(drive_of(servo, natural_frequency));
}

/// What a data sheet says besides its motor.
struct Sheet {
  double motor_inertia = 0.0, motor_friction = 0.0;
  double ratio = 1.0, backlash = 0.0;
  double load_inertia = 0.0, load_friction = 0.0;
  double error_gain = 1.0, restitution = 0.0;
};

inline Drive drive_of(const MotorKind& kind, const Sheet& sheet) {
  Drive drive;
  drive.motor = {
      .kind = kind, .inertia = sheet.motor_inertia, .friction = {.viscous = sheet.motor_friction}};
  drive.gearbox = {.ratio = sheet.ratio, .backlash = sheet.backlash};
  drive.load = {.inertia = sheet.load_inertia, .friction = {.viscous = sheet.load_friction}};
  drive.contact = RigidContact{sheet.restitution};
  drive.controller.law = PID{.proportional = sheet.error_gain};
  return drive;
}

}  // namespace gearlash
