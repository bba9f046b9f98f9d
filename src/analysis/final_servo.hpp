// The servo that a drive is to the closed form.
#pragma once

#include <optional>

#include "gearlash/drive.hpp"
#include "model/proportional_servo.hpp"
#include "model/reduced_drive.hpp"

namespace gearlash {

/// What a drive is to the closed form once its signals stay where they end.
struct FinalServo {
  ClosedFormServo closed_form{};
  Drivetrain drivetrain{};
  /// K, N m/rad; not known of a normal form with a natural frequency.
  std::optional<double> stiffness{};
};
/// Nothing where the general engine must answer. Precondition: the drive is sound.
std::optional<FinalServo> final_servo(const Drive& drive);
/// The drive without a reference that stays somewhere in the end, on which hunting does not depend,
/// and without a load torque that ends at 0. Precondition: its signals are sound.
Drive without_ended_signals(Drive drive);
/// The same where the closed form then answers for it; nothing for any other drive. Precondition:
/// it is sound.
std::optional<Drive> closed_form_drive(Drive drive);

}  // namespace gearlash
