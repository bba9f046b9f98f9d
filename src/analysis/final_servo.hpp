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
/// The drive without its signals, where the closed form then answers for it: hunting does not
/// depend on where a reference stays in the end. Nothing for any other drive. Precondition: it is
/// sound.
std::optional<Drive> closed_form_drive(Drive drive);

}  // namespace gearlash
