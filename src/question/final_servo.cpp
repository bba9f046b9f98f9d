#include "question/final_servo.hpp"

#include <algorithm>
#include <limits>
#include <utility>
#include <variant>

#include "closed_form/closed_answer.hpp"
#include "closed_form/limit_cycle.hpp"
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

/// A normal form with a natural frequency has no inertia and therefore no stiffness.
std::optional<double> stiffness_of(const Drive& drive, const Drivetrain& drivetrain) {
  const bool is_known = !drive.servo || !drive.servo->natural_frequency;
  return is_known ? std::optional(drivetrain.stiffness) : std::nullopt;
}

}  // namespace

Drive without_ended_signals(Drive drive) {
  if (drive.reference && std::holds_alternative<double>(drive::settled(*drive.reference))) {
    drive.reference.reset();
  }
  if (drive.load_torque && drive::settled(*drive.load_torque) == Signal{0.0}) {
    drive.load_torque.reset();
  }
  return drive;
}

std::optional<Drive> closed_form_drive(Drive drive) {
  drive = without_ended_signals(std::move(drive));
  return closed_form_servo(drive) ? std::optional(std::move(drive)) : std::nullopt;
}

std::optional<FinalServo> final_servo(const SoundDrive& drive) {
  const std::optional<Drivetrain> drivetrain = drive::proportional_drivetrain(drive.settled());
  if (!drivetrain) return std::nullopt;
  const std::optional<ClosedFormServo> servo = closed_form_servo(drive.given(), *drivetrain);
  if (!servo) return std::nullopt;
  return FinalServo{*servo, *drivetrain, stiffness_of(drive.given(), *drivetrain)};
}

FinalServo servo_without_checks(const Drive& drive) {
  const Drivetrain drivetrain = referred_drivetrain(drive);
  const std::optional<double> stiffness = stiffness_of(drive, drivetrain);
  if (drive.servo) return {normal_form_servo(drive), drivetrain, stiffness};
  return {
      {normalize_sound(drivetrain), natural_frequency(drivetrain), false}, drivetrain, stiffness};
}

Answer answer_of(const FinalServo& servo) {
  return answer_of(analyse_limit_cycles(servo.closed_form.servo), servo.closed_form,
                   servo.stiffness);
}

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

DriveBox box_of(const Drive& drive, const FinalServo& servo) {
  return box_between(servo.drivetrain, servo.drivetrain, data_error_of(drive, servo.drivetrain));
}

Reading reading_of(const Drive& drive) {
  return drive.servo && !drive.is_rounded ? Reading::decimal : Reading::converted;
}

}  // namespace gearlash
