#include "model/drivetrain.hpp"

#include <cmath>

#include "base/range_check.hpp"

namespace gearlash {
namespace {

std::vector<Fault> faults_of_masses_and_stiffness(const Drivetrain& drivetrain) {
  RangeCheck check;
  check.not_negative("motor_inertia", drivetrain.motor_inertia, "kg m2");
  check.not_negative("load_inertia", drivetrain.load_inertia, "kg m2");
  check.not_negative("motor_friction", drivetrain.motor_friction, "N m s/rad");
  check.not_negative("load_friction", drivetrain.load_friction, "N m s/rad");
  check.positive("stiffness", drivetrain.stiffness, "N m/rad");
  if (drivetrain.motor_inertia == 0.0 && drivetrain.load_inertia == 0.0) {
    check.refuse(
        "load_inertia", "0 kg m2",
        "must be positive where motor and gearbox have no inertia: one shaft must have some");
  }
  if (check.faults().empty() && std::isinf(drivetrain.motor_inertia + drivetrain.load_inertia)) {
    check.refuse("load_inertia", exact_text(drivetrain.load_inertia) + " kg m2",
                 "must leave motor_inertia + load_inertia finite");
  }
  return check.faults();
}

}  // namespace

std::vector<Fault> faults(const Drivetrain& drivetrain) {
  RangeCheck check;
  check.include(faults_of_masses_and_stiffness(drivetrain));
  // Ratios of unsound inertias mean nothing. The fields that are passed on are checked in any case.
  const bool sound = check.faults().empty();
  NormalizedServo servo = sound ? normalize_sound(drivetrain) : NormalizedServo{};
  servo.backlash = drivetrain.backlash;
  servo.restitution = drivetrain.restitution;
  check.include(faults(servo));
  return check.faults();
}

NormalizedServo normalize_sound(const Drivetrain& drivetrain) {
  const double inertia = drivetrain.motor_inertia + drivetrain.load_inertia;
  const double friction = drivetrain.motor_friction + drivetrain.load_friction;
  NormalizedServo servo;
  // One root each, so that neither K·J nor K/J can leave the range of a double.
  servo.damping = friction / (2.0 * std::sqrt(drivetrain.stiffness) * std::sqrt(inertia));
  servo.inertia_ratio = drivetrain.load_inertia / drivetrain.motor_inertia;
  servo.friction_ratio = friction > 0.0 ? drivetrain.load_friction / friction : 0.0;
  servo.backlash = drivetrain.backlash;
  servo.restitution = drivetrain.restitution;
  return servo;
}

double natural_frequency(const Drivetrain& drivetrain) {
  return std::sqrt(drivetrain.stiffness) /
         std::sqrt(drivetrain.motor_inertia + drivetrain.load_inertia);
}

NormalizedServo normalize(const Drivetrain& drivetrain) {
  require_none(faults(drivetrain));
  return normalize_sound(drivetrain);
}

}  // namespace gearlash
