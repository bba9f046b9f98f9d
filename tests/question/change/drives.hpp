// Drives with a closed form for several tests.
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "base/special_numbers.hpp"
#include "closed_form/closed_answer.hpp"
#include "model/proportional_servo.hpp"
#include "model/reduced_drive.hpp"
#include "question/change/servo_line.hpp"

namespace gearlash {

/// What a design looks at in a normal form.
inline constexpr std::array<std::string_view, 9> all_parameters = {
    "servo.backlash", "gearbox.ratio",  "controller.proportional",
    "load.friction",  "motor.friction", "controller.motor_speed_feedback",
    "load.inertia",   "motor.inertia",  "contact.restitution"};

inline Drive drive_of(const NormalizedServo& servo, double natural_frequency = 1.0) {
  Drive drive = normal_form(servo.damping, servo.inertia_ratio, servo.friction_ratio,
                            servo.backlash, servo.restitution);
  if (natural_frequency != 1.0) drive.servo->natural_frequency = natural_frequency;
  return drive;
}

/// The drives with other values of a number, which must enter the closed form.
inline ServoLine line_of(const Drive& drive, std::string_view parameter) {
  return *ServoLine::along(drive, std::string(parameter));
}

inline Drivetrain drivetrain_of(const Drive& drive) { return settled_servo(drive)->drivetrain; }

/// What the closed form says.
inline Answer closed_answer(const Drivetrain& drive) {
  return answer_of(ProportionalServo{.servo = normalize(drive),
                                     .natural_frequency = natural_frequency(drive),
                                     .drivetrain = drive,
                                     .stiffness = drive.stiffness});
}
inline Answer closed_answer(const Drive& drive) { return closed_answer(drivetrain_of(drive)); }

/// NaN where it is not known.
inline double amplitude_in(const Answer& answer) {
  return answer.value(Quantity::amplitude).value_or(not_a_number);
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
