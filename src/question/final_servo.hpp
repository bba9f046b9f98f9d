// The normal-form servo equivalent to a drive.
#pragma once

#include <optional>

#include "closed_form/cycle_bounds.hpp"
#include "gearlash/answer.hpp"
#include "gearlash/drive.hpp"
#include "model/proportional_servo.hpp"
#include "model/reduced_drive.hpp"
#include "model/sound_drive.hpp"

namespace gearlash {

/// The closed form of a drive whose signals have settled.
struct FinalServo {
  ClosedFormServo closed_form{};
  Drivetrain drivetrain{};
  /// K, N m/rad; unknown for a normal form with a natural frequency.
  std::optional<double> stiffness{};
};
/// Empty where the general engine must answer.
std::optional<FinalServo> final_servo(const SoundDrive& drive);
/// The same for a drive that is known to have a closed form and settled signals, without checks of
/// its numbers.
FinalServo servo_without_checks(const Drive& drive);
/// What analyse_limit_cycles() gives. Throws InvalidInput.
Answer answer_of(const FinalServo& servo);

/// Bounds of the drivetrain's error relative to the drive's data. Precondition: the drive has a
/// closed form, and `drivetrain` is its drivetrain.
DataError data_error_of(const Drive& drive, const Drivetrain& drivetrain);
/// Whether the rounding of the motor's friction can be bounded closely: with negative feedback it
/// is a difference, of which more than a millionth must be left. Precondition as above.
bool has_resolved_friction(const Drive& drive, const Drivetrain& drivetrain);
/// All that the drive's data may stand for. Precondition: it has a closed form.
DriveBox box_of(const Drive& drive, const FinalServo& servo);

/// How proofs read the numbers of its closed form.
Reading reading_of(const Drive& drive);
/// The drive without a reference that ends constant (hunting does not depend on it) and without a
/// load torque that ends at 0. Precondition: its signals are sound.
Drive without_ended_signals(Drive drive);
/// without_ended_signals() if the closed form answers for the result; empty for any other drive.
/// Precondition: the drive is sound.
std::optional<Drive> closed_form_drive(Drive drive);

}  // namespace gearlash
