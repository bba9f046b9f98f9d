#include "analysis/final_servo.hpp"

#include <utility>
#include <variant>

#include "model/reduced_drive.hpp"

namespace gearlash {

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

std::optional<FinalServo> final_servo(const Drive& drive) {
  const std::optional<Drive> at_rest = closed_form_drive(drive);
  if (!at_rest) return std::nullopt;
  FinalServo found{*closed_form_servo(*at_rest), *drive::proportional_drivetrain(reduce(*at_rest)),
                   std::nullopt};
  // A normal form with a natural frequency has no inertia and therefore no stiffness.
  const bool is_known = !drive.servo || !drive.servo->natural_frequency;
  if (is_known) found.stiffness = found.drivetrain.stiffness;
  return found;
}

Reading reading_of(const Drive& drive) {
  return drive.servo && !drive.is_rounded ? Reading::decimal : Reading::converted;
}

}  // namespace gearlash
