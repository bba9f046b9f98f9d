#include "model/datasheet.hpp"

#include <array>
#include <string>
#include <string_view>

#include "base/overloaded.hpp"
#include "base/range_check.hpp"

namespace gearlash {
namespace {

std::vector<Fault> validate(const SheetMotor& motor) {
  RangeCheck check("motor.");
  std::visit(
      [&](const auto& any) {
        check.not_negative("inertia", any.inertia, "kg m2");
        check.not_negative("friction", any.friction, "N m s/rad");
      },
      motor);
  std::visit(
      Overloaded{[&](const ArmatureControlledMotor& armature) {
                   check.positive("torque_constant", armature.torque_constant, "N m/A");
                   check.not_negative("back_emf_constant", armature.back_emf_constant, "V s/rad");
                   check.positive("resistance", armature.resistance, "ohm");
                 },
                 [&](const FieldControlledMotor& field) {
                   check.positive("torque_constant", field.torque_constant, "N m/A");
                   check.positive("resistance", field.resistance, "ohm");
                 },
                 [&](const TwoPhaseMotor& two_phase) {
                   check.positive("torque_per_volt", two_phase.torque_per_volt, "N m/V");
                   check.not_negative("torque_per_speed", two_phase.torque_per_speed, "N m s/rad");
                 }},
      motor);
  return check.faults();
}

/// What the numbers at the load shaft are made of, for an author who has given none of them.
struct Origin {
  std::string_view field;
  std::string_view made_of;
};
constexpr std::array origins = {
    Origin{"motor_inertia", "motor.inertia * gearbox.ratio^2"},
    Origin{"motor_friction", "(motor.friction + the motor's electrical one) * gearbox.ratio^2"},
    Origin{"stiffness", "the motor's torque per volt * loop.error_gain * gearbox.ratio"},
    Origin{"damping", "friction/(2 sqrt(stiffness * inertia)), everything at the load"},
    Origin{"inertia_ratio", "load.inertia/(motor.inertia * gearbox.ratio^2)"}};

}  // namespace

std::vector<Fault> named_for_datasheet(std::vector<Fault> faults) {
  for (Fault& fault : faults) {
    for (const Origin& origin : origins) {
      if (fault.path != origin.field) continue;
      fault.permitted += "; it is " + std::string(origin.made_of);
    }
    if (fault.path == "backlash") fault.path = "gearbox.backlash";
    if (fault.path == "restitution") fault.path = "contact.restitution";
    if (fault.path == "sensor") fault.path = "loop.sensor";
  }
  return faults;
}

std::vector<Fault> validate(const Datasheet& datasheet) {
  RangeCheck check;
  check.include(validate(datasheet.motor));
  check.positive("gearbox.ratio", datasheet.gearbox.ratio, "");
  check.not_negative("gearbox.backlash", datasheet.gearbox.backlash, "rad");
  check.not_negative("load.inertia", datasheet.load.inertia, "kg m2");
  check.not_negative("load.friction", datasheet.load.friction, "N m s/rad");
  check.positive("loop.error_gain", datasheet.loop.error_gain, "V/rad");
  check.within("contact.restitution", datasheet.contact.restitution, 0.0, 1.0);
  if (datasheet.loop.sensor != ShaftName::load) {
    check.refuse("loop.sensor", "motor", "must be " + permitted_values("sensor"));
  }
  if (!check.faults().empty()) return check.faults();
  return named_for_datasheet(validate(to_drivetrain_sound(datasheet)));
}

ReferredMotor refer_to_load(const Datasheet& datasheet) {
  const double ratio = datasheet.gearbox.ratio;
  const double square = ratio * ratio;
  const double error_gain = datasheet.loop.error_gain;
  return std::visit(
      Overloaded{
          [&](const ArmatureControlledMotor& motor) {
            const double torque_per_volt = motor.torque_constant / motor.resistance;
            return ReferredMotor{torque_per_volt * error_gain * ratio, motor.inertia * square,
                                 motor.friction * square,
                                 torque_per_volt * motor.back_emf_constant * square};
          },
          [&](const FieldControlledMotor& motor) {
            return ReferredMotor{motor.torque_constant / motor.resistance * error_gain * ratio,
                                 motor.inertia * square, motor.friction * square, 0.0};
          },
          [&](const TwoPhaseMotor& motor) {
            return ReferredMotor{motor.torque_per_volt * error_gain * ratio, motor.inertia * square,
                                 motor.friction * square, motor.torque_per_speed * square};
          }},
      datasheet.motor);
}

Drivetrain to_drivetrain(const Datasheet& datasheet) {
  require_none(validate(datasheet));
  return to_drivetrain_sound(datasheet);
}

Drivetrain to_drivetrain_sound(const Datasheet& datasheet) {
  const ReferredMotor motor = refer_to_load(datasheet);
  return {.motor_inertia = motor.inertia,
          .load_inertia = datasheet.load.inertia,
          .motor_friction = motor.mechanical_friction + motor.electrical_friction,
          .load_friction = datasheet.load.friction,
          .stiffness = motor.stiffness,
          .backlash = datasheet.gearbox.backlash,
          .restitution = datasheet.contact.restitution,
          .sensor = datasheet.loop.sensor};
}

}  // namespace gearlash
