// The servo of 1960 that a drive may be: proportional control of the load's position.
#pragma once

#include <optional>
#include <string_view>

#include "model/drive.hpp"
#include "model/drivetrain.hpp"
#include "model/sound_drive.hpp"

namespace gearlash {

/// The servo of 1960 that is physically equivalent to a drive: proportional control of the load's
/// position, continuous, exact and unlimited; rigid faces; no dry friction; a constant reference;
/// no load torque. Speed that is fed back from the motor is friction on it. Sides without inertia
/// and gaps of 0 are included.
struct ProportionalServo {
  NormalizedServo servo{};
  double natural_frequency = 1.0;  ///< ω_n, rad/s
  /// The normal form's own numbers; otherwise they are computed from data with units.
  bool is_as_given = false;
  Drivetrain drivetrain{};
  /// K, N m/rad; unknown for a normal form with a natural frequency, which has no inertia.
  std::optional<double> stiffness{};
};

/// A normal form, with the restitution of its contact.
NormalizedServo servo_with_restitution(const NormalForm& form, double restitution);

/// The conditions above, for faults.
inline constexpr char permitted_with_servo[] =
    "must have proportional control of the load's position, continuous, exact and unlimited, "
    "rigid faces and no dry friction";

/// Empty for any other drive. Precondition: every parameter is in its range.
std::optional<ProportionalServo> proportional_servo(const Drive& drive);
/// The same once the drive's signals have settled.
std::optional<ProportionalServo> settled_servo(const SoundDrive& drive);
/// The same for a drive that is known to be one and to have settled signals, without checks of its
/// numbers.
ProportionalServo servo_without_checks(const Drive& drive);

/// The same servo as a normal form with its natural frequency; empty for any other drive. Numbers
/// computed from data with units are rounded. Precondition as of proportional_servo().
std::optional<Drive> normal_form_of(const Drive& drive);

/// The drive without a reference that ends constant (hunting does not depend on it) and without a
/// load torque that ends at 0. Precondition: its signals are sound.
Drive without_ended_signals(Drive drive);

/// Whether the servo of a drive that has one depends on a number of the drive, and whether it has
/// one still as the number changes. Of a normal form also for the numbers of its physical_form().
/// False for an inertia of the gears that is 0 as by default, and for a path that is no number of
/// the drive.
bool enters_servo(const Drive& drive, std::string_view path);

namespace drive {

/// τ = K (r − θ_L). Precondition: sound, both inertias and the
/// backlash positive.
template <class Number>
ReducedDriveOf<Number> drive_of(const DrivetrainOf<Number>& drivetrain) {
  ReducedDriveOf<Number> drive;
  drive.motor = {drivetrain.motor_inertia, {.viscous = drivetrain.motor_friction}};
  drive.load = {drivetrain.load_inertia, {.viscous = drivetrain.load_friction}};
  drive.backlash = drivetrain.backlash;
  drive.contact = RigidContactOf<Number>{drivetrain.restitution};
  drive.controller.direct = {drivetrain.stiffness, -drivetrain.stiffness, -0.0};
  return drive;
}

/// The drivetrain of proportional_servo(). Its numbers may be beyond the ranges of a servo.
/// Precondition: the controller is sound.
std::optional<Drivetrain> proportional_drivetrain(const ReducedDrive& drive);

}  // namespace drive

}  // namespace gearlash
