// The normal-form servo equivalent to a drive.
#pragma once

#include <optional>

#include "closed_form/cycle_bounds.hpp"
#include "gearlash/drive.hpp"
#include "model/proportional_servo.hpp"
#include "model/reduced_drive.hpp"

namespace gearlash {

/// The closed form of a drive whose signals have settled.
struct FinalServo {
  ClosedFormServo closed_form{};
  Drivetrain drivetrain{};
  /// K, N m/rad; unknown for a normal form with a natural frequency.
  std::optional<double> stiffness{};
};
/// Empty where the general engine must answer. Precondition: the drive is sound.
std::optional<FinalServo> final_servo(const Drive& drive);
/// How proofs read the numbers of its closed form.
Reading reading_of(const Drive& drive);
/// The drive without a reference that ends constant (hunting does not depend on it) and without a
/// load torque that ends at 0. Precondition: its signals are sound.
Drive without_ended_signals(Drive drive);
/// without_ended_signals() if the closed form answers for the result; empty for any other drive.
/// Precondition: the drive is sound.
std::optional<Drive> closed_form_drive(Drive drive);

}  // namespace gearlash
