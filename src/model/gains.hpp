// Gains of a torque-controlled drive, at the joint and at the motor.
#pragma once

#include <string_view>
#include <vector>

#include "gearlash/drive.hpp"

namespace gearlash {

/// One gain as torque per angle of the same shaft; with n motor turns per load turn the one at the
/// joint is n² times the one at the motor.
struct PlacedGain {
  std::string_view path{};  ///< "controller.proportional"
  std::string_view unit{};  ///< "N m/rad"
  double at_joint = 0.0;
  double at_motor = 0.0;
};

/// In the order of files. Empty for a motor driven by a voltage, for a normal form, and for n = 1,
/// where both are the same.
std::vector<PlacedGain> placed_gains(const Drive& drive);

}  // namespace gearlash
