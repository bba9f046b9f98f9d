#include "analysis/drive_notes.hpp"

#include <array>
#include <charconv>
#include <numbers>
#include <string>

#include "model/reduced_drive.hpp"

namespace gearlash {
namespace {

/// With four digits.
std::string text_of(double value) {
  std::array<char, 32> text{};
  const auto end =
      std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::general, 4);
  return {text.data(), end.ptr};
}

}  // namespace

std::vector<Note> notes_on(const Drive& drive) {
  std::vector<Note> notes;
  if (drive.servo) return notes;
  const Motor& motor = drive.motor;
  if (motor.no_load_current && takes_no_load_current(motor)) {
    notes.push_back({"no-load-current", "The motor's dry friction is " +
                                            text_of(coulomb_torque(motor)) +
                                            " N m: torque constant times no-load current, an upper "
                                            "bound."});
  }
  if (drive.gearbox.efficiency) {
    notes.push_back(
        {"efficiency", "gearbox.efficiency = " + text_of(*drive.gearbox.efficiency) +
                           " is not modelled: losses in proportion to the transmitted torque are "
                           "left out. Give friction that does not depend on it as motor.coulomb or "
                           "load.coulomb."});
  }
  if (drive.load.gravity != 0.0) {
    const drive::Gravity gravity = reduce(drive).gravity;
    constexpr double degrees = 180.0 / std::numbers::pi;
    notes.push_back({"gravity", "Gravity is linearised about " +
                                    text_of((drive.load.gravity_angle + gravity.angle) * degrees) +
                                    "° above the horizontal, where the reference ends: torque " +
                                    text_of(gravity.torque) + " N m, stiffness " +
                                    text_of(gravity.stiffness) + " N m/rad."});
  }
  return notes;
}

}  // namespace gearlash
