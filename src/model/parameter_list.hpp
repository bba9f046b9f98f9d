// The parts of the list of parameters (model/parameters.hpp).
#pragma once

#include <vector>

#include "model/parameters.hpp"

namespace gearlash {

std::vector<Parameter> mechanical_parameters();  ///< servo, motor, gearbox, load, contact
std::vector<Parameter> control_parameters();     ///< sensor, controller, sampling
std::vector<Parameter> firmware_parameters();    ///< the controller's registers
std::vector<Parameter> nonlinear_parameters();   ///< of the controller, among the former
std::vector<Parameter> signal_parameters();      ///< reference, load_torque

/// Whether the controller is a law with keys of its own, and no firmware.
inline bool has_law(const Drive& drive) { return !drive.servo && !drive.controller.firmware; }

/// Gives the drive the firmware with that index of all_firmwares(), all registers at their
/// defaults, and its sampling where the manual states it and the drive has none.
void take_firmware(Drive& drive, std::size_t index);

/// The rule for a unit that is the same for every drive.
template <const Dimension& dimension>
const Dimension* always(const Drive&) {
  return &dimension;
}

/// A member of one alternative of a variant: its slot if the variant holds that alternative.
template <class Alternative, class Variant, class Member>
Slot slot_of(Variant& variant, Member Alternative::*member) {
  auto* held = std::get_if<Alternative>(&variant);
  return held == nullptr ? Slot{} : Slot{&(held->*member)};
}

/// A member of an optional part: its slot if that part exists.
template <class Part, class Member>
Slot slot_of(std::optional<Part>& part, Member Part::*member) {
  return part ? Slot{&((*part).*member)} : Slot{};
}

}  // namespace gearlash
