// A drive in which single parameters are changed, all others fixed.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "closed_form/cycle_bounds.hpp"
#include "gearlash/drive.hpp"
#include "model/drivetrain_slopes.hpp"
#include "model/parameters.hpp"

namespace gearlash {

/// A number that can be changed by itself: a parameter of the drive, by its path, or "tachometer",
/// additional feedback of the motor's speed. A normal form also has "load_inertia" and
/// "motor_inertia", as shares of the total inertia; "load_friction" and "motor_friction", as shares
/// of the critical friction 2ω_n(J_M + J_L); and "gear_ratio" and "error_gain", relative to their
/// present values.
struct ChangeableNumber {
  enum class Kind { parameter, share, feedback };

  std::string name{};         ///< "gearbox.ratio", "gear_ratio", "tachometer"
  std::string older_name{};   ///< its name in 0.1, also accepted
  std::string description{};  ///< "motor turns per load turn"
  std::string unit{};         ///< SI; "1" for a pure number
  double present = 0.0;
  Kind kind = Kind::parameter;
  const Parameter* parameter = nullptr;  ///< for a share: in physical_form()
  double scale = 1.0;  ///< value of the parameter, or of feedback, per unit of this number

  bool is_backlash() const { return older_name == "backlash"; }
  bool is_restitution() const { return older_name == "restitution"; }
};

/// A drive with a closed form and the effect of changing a number in it.
class ChangeableDrive {
 public:
  /// Throws InvalidInput with every fault, or if the drive has no closed form.
  explicit ChangeableDrive(const Drive& drive);

  /// The drive without its signals, which do not affect hunting.
  const Drive& drive() const { return drive_; }
  const Drivetrain& drivetrain() const { return drivetrain_; }

  /// All numbers, first those that a designer considers first.
  const std::vector<ChangeableNumber>& numbers() const { return numbers_; }
  /// The names of the numbers to consider by default.
  std::vector<std::string> usual_names() const;
  /// Finds a number by its name, an alias (model/parameters.hpp) or its name in 0.1; nullptr if
  /// there is none.
  const ChangeableNumber* find(std::string_view name) const;
  /// As find(). Throws InvalidInput if there is none.
  const ChangeableNumber& number(std::string_view name) const;

  double present_value(std::string_view name) const { return number(name).present; }
  /// The range to search: 0.001 to 1000 times the present value. Numbers that only add friction,
  /// which may be 0 at present: from 0 to the value that alone damps the servo at ten times
  /// critical. Shares: 0 to 1. Narrower where the drive permits less (validate(Drivetrain)).
  Bounds range(std::string_view name) const;

  /// The drive with another value of one number, or of two. The result may be unsound.
  Drivetrain with(std::string_view name, double value) const;
  Drivetrain with(std::string_view name, double value, std::string_view other,
                  double other_value) const;

  /// A box that contains all drives with a number within bounds, including the error of the data.
  /// Precondition: both ends are sound.
  DriveBox box(std::string_view name, const Bounds& values) const;
  /// The unchanged drive, including the error of the data.
  DriveBox box() const { return box_between(drivetrain_, drivetrain_, data_error_); }

  /// The derivatives of with() at the present value.
  DrivetrainSlopes slopes(std::string_view name) const;

 private:
  struct Change {
    const ChangeableNumber& number;
    double value;
  };
  /// A drivetrain, and the sum of the absolute values of the terms of its motor friction.
  struct Changed {
    Drivetrain drivetrain;
    double friction_terms = 0.0;
  };
  Changed changed(std::initializer_list<Change> changes) const;
  bool is_sound(const Changed& changed) const;
  void add_parameter(std::string_view path);
  void add_shares();
  void add_feedback(double scale);

  Drive drive_;
  Drivetrain drivetrain_;
  std::vector<ChangeableNumber> numbers_;
  std::size_t usual_ = 0;  ///< the first `usual_` numbers are considered by default
  DataError data_error_;
};

/// Bounds of the drivetrain's error relative to the drive's data. Precondition: the drive has a
/// closed form, and `drivetrain` is its drivetrain.
DataError data_error_of(const Drive& drive, const Drivetrain& drivetrain);

}  // namespace gearlash
