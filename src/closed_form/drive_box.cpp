#include "closed_form/drive_box.hpp"

#include <algorithm>
#include <limits>

#include "model/reduced_drive.hpp"

namespace gearlash {
namespace {

/// The sum of the absolute values of the terms of the motor's friction.
double friction_terms(const Drive& drive, double friction) {
  if (drive.servo) return friction;
  const double ratio = drive.gearbox.ratio;
  const double viscous =
      drive.motor.friction.viscous * (ratio * ratio) + refer_output(drive).friction;
  return std::max(friction, 2.0 * viscous - friction);
}

}  // namespace

DataError data_error_of(const Drive& drive, const Drivetrain& drivetrain) {
  DataError error;
  if (drive.servo && drive.servo->friction_ratio < 1.0) {
    // The error of 1 − φ for a decimal φ.
    error.motor_friction +=
        std::numeric_limits<double>::epsilon() / (1.0 - drive.servo->friction_ratio);
  }
  if (drive.is_rounded && drive.servo && drive.servo->friction_ratio == 1.0) {
    error.hidden_motor_friction = error.each * drivetrain.load_friction;
  }
  const double friction = drivetrain.motor_friction;
  const double terms = friction_terms(drive, friction);
  if (terms > friction) {
    error.motor_friction = std::max(error.motor_friction, error.each * (terms / friction));
  }
  return error;
}

bool has_resolved_friction(const Drive& drive, const Drivetrain& drivetrain) {
  constexpr double least_left = 0x1p-20;
  const double friction = drivetrain.motor_friction;
  const double terms = friction_terms(drive, friction);
  return friction == terms || friction > least_left * terms;
}

DriveBox box_of(const Drive& drive, const ProportionalServo& servo) {
  return box_between(servo.drivetrain, servo.drivetrain, data_error_of(drive, servo.drivetrain));
}

Reading reading_of(const Drive& drive) {
  return drive.servo && !drive.is_rounded ? Reading::decimal : Reading::converted;
}

}  // namespace gearlash
