// A drive of which some numbers differ from piece to piece.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "analysis/design/distribution.hpp"
#include "model/datasheet.hpp"

namespace gearlash {

/// The numbers of a data sheet and of a normalised servo, by their names in the file.
enum class DriveNumber {
  motor_inertia,            ///< kg m²
  motor_friction,           ///< N m s/rad
  motor_torque_constant,    ///< N m/A; armature and field control
  motor_back_emf_constant,  ///< V s/rad; armature control
  motor_resistance,         ///< Ω; armature and field control
  motor_torque_per_volt,    ///< N m/V; two phases
  motor_torque_per_speed,   ///< N m s/rad; two phases
  gearbox_ratio,            ///< motor turns per load turn
  gearbox_backlash,         ///< rad
  load_inertia,             ///< kg m²
  load_friction,            ///< N m s/rad
  loop_error_gain,          ///< V/rad
  contact_restitution,
  servo_damping,
  servo_inertia_ratio,
  servo_friction_ratio,
  servo_backlash,  ///< rad
  servo_restitution
};
inline constexpr std::size_t drive_number_count = 18;
inline constexpr std::array<DriveNumber, drive_number_count> all_drive_numbers = {
    DriveNumber::motor_inertia,          DriveNumber::motor_friction,
    DriveNumber::motor_torque_constant,  DriveNumber::motor_back_emf_constant,
    DriveNumber::motor_resistance,       DriveNumber::motor_torque_per_volt,
    DriveNumber::motor_torque_per_speed, DriveNumber::gearbox_ratio,
    DriveNumber::gearbox_backlash,       DriveNumber::load_inertia,
    DriveNumber::load_friction,          DriveNumber::loop_error_gain,
    DriveNumber::contact_restitution,    DriveNumber::servo_damping,
    DriveNumber::servo_inertia_ratio,    DriveNumber::servo_friction_ratio,
    DriveNumber::servo_backlash,         DriveNumber::servo_restitution};

/// "motor.inertia", "servo.damping", …
const char* name_of(DriveNumber number);
std::optional<DriveNumber> drive_number_named(std::string_view name);
/// "kg m2", "rad", …; "1" where it is a mere number.
const char* unit_of(DriveNumber number);

struct VariedNumber {
  DriveNumber number = DriveNumber::gearbox_backlash;
  Distribution distribution;  ///< independent of those of the others

  bool operator==(const VariedNumber&) const = default;
};

/// A parameter of a drive, by its path, that differs from piece to piece.
struct ParameterTolerance {
  std::string path;
  Distribution distribution;  ///< independent of those of the others

  bool operator==(const ParameterTolerance&) const = default;
};

/// A servo and how fast it is: ω_n, rad/s.
struct TimedServo {
  NormalizedServo servo;
  double natural_frequency = 1.0;

  bool operator==(const TimedServo&) const = default;
};

struct TolerancedDrive {
  std::variant<Datasheet, NormalizedServo> nominal;  ///< of varied numbers without effect
  double natural_frequency = 1.0;                    ///< ω_n, rad/s, of a normalised servo; > 0
  std::vector<VariedNumber> varied;

  bool operator==(const TolerancedDrive&) const = default;
};

/// Every fault: numbers that the drive has not, or that are given twice; distributions that are
/// none, or of which a value is drawn (drawn_range_of()) that no such number can have; nominal
/// numbers. Where each number is possible by itself, all corners of the box of the values drawn,
/// and of the support (three_sigma_range_of()), have to be drives. A backlash between 0 and 1e-15
/// rad, which a drive must not have, may be drawn: sizes are worked out per backlash.
std::vector<Fault> validate(const TolerancedDrive& drive);

/// Which of the drive's varied numbers is its backlash, if any is.
std::optional<std::size_t> place_of_backlash(const TolerancedDrive& drive);
/// The nominal backlash, rad.
double nominal_backlash_of(const TolerancedDrive& drive);

/// The drive of which the varied numbers are `values`, in their order. Throws InvalidInput where it
/// is none, and std::invalid_argument where there are not as many values.
TimedServo drive_with(const TolerancedDrive& drive, std::span<const double> values);

}  // namespace gearlash
