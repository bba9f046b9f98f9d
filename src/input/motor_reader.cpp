#include "input/motor_reader.hpp"

#include "input/units.hpp"

namespace gearlash {
namespace {

/// The motor of a kind that could not be read: that which its keys tell, so that they are
/// checked.
Motor read_unknown_kind(SectionReader& section, double inertia, double friction) {
  const auto si = [&](const char* key, const Dimension& dimension) {
    const std::optional<Quantity> quantity = section.optional_quantity(key, dimension);
    return quantity ? std::optional(quantity->si) : std::nullopt;
  };
  const auto torque_constant = si("torque_constant", dimensions::torque_per_current);
  const auto back_emf_constant = si("back_emf_constant", dimensions::voltage_per_speed);
  const auto resistance = si("resistance", dimensions::resistance);
  const auto torque_per_volt = si("torque_per_volt", dimensions::torque_per_voltage);
  const auto torque_per_speed = si("torque_per_speed", dimensions::torque_per_speed);
  if (torque_per_volt || torque_per_speed) {
    return TwoPhaseMotor{.inertia = inertia,
                         .friction = friction,
                         .torque_per_volt = torque_per_volt.value_or(1.0),
                         .torque_per_speed = torque_per_speed.value_or(1.0)};
  }
  return ArmatureControlledMotor{.inertia = inertia,
                                 .friction = friction,
                                 .torque_constant = torque_constant.value_or(1.0),
                                 .back_emf_constant = back_emf_constant.value_or(1.0),
                                 .resistance = resistance.value_or(1.0)};
}

}  // namespace

const std::vector<std::string> motor_kinds = {"armature-controlled", "field-controlled",
                                              "two-phase"};

Motor read_motor_constants(SectionReader& section, const std::string& kind, double inertia,
                           double friction) {
  const auto si = [&](const char* key, const Dimension& dimension) {
    return section.quantity(key, dimension).si;
  };
  // Members are initialised in the order of their declaration, which is that of the keys.
  if (kind == "armature-controlled") {
    return ArmatureControlledMotor{
        .inertia = inertia,
        .friction = friction,
        .torque_constant = si("torque_constant", dimensions::torque_per_current),
        .back_emf_constant = si("back_emf_constant", dimensions::voltage_per_speed),
        .resistance = si("resistance", dimensions::resistance)};
  }
  if (kind == "field-controlled") {
    return FieldControlledMotor{
        .inertia = inertia,
        .friction = friction,
        .torque_constant = si("torque_constant", dimensions::torque_per_current),
        .resistance = si("resistance", dimensions::resistance)};
  }
  if (kind == "two-phase") {
    return TwoPhaseMotor{.inertia = inertia,
                         .friction = friction,
                         .torque_per_volt = si("torque_per_volt", dimensions::torque_per_voltage),
                         .torque_per_speed = si("torque_per_speed", dimensions::torque_per_speed)};
  }
  return read_unknown_kind(section, inertia, friction);
}

}  // namespace gearlash
